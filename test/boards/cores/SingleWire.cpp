// This must not compile: a single wire on a port that cannot release it, or that may be of any class.
#include <SBus2Sensor.h>

#if defined(SBUS_TEENSY4)
SBus2Sensor dSBus(static_cast<HardwareSerial &>(Serial1), sbus::SingleWire);
#else
SBus2Sensor dSBus(Serial1, sbus::SingleWire);
#endif
