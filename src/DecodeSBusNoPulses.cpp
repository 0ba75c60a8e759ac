#include "DecodeSBus.tpp"
#include "sbus/FrameFinder.tpp"

SBUS_COMPILE_FINDER(sbus::Frame16NoPulses)
SBUS_COMPILE_DECODER(sbus::Frame16NoPulses)
