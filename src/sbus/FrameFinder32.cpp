#include "ExtraFrame.h"
#include "FrameFinder.tpp"

SBUS_COMPILE_FINDER(sbus::Frame16Extra, sbus::ExtraFrame)
