#include "DecodeSBus.tpp"

SBUS_COMPILE_DECODER(sbus::Frame16)
