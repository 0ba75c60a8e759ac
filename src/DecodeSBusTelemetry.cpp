#include "DecodeSBusTelemetry.h"

#include "DecodeSBus.tpp"
#include "sbus/FrameFinder.tpp"

SBUS_COMPILE_FINDER(sbus::Frame16, sbus::Telemetry)
SBUS_COMPILE_DECODER(sbus::Frame16, sbus::Telemetry)
