// PinLoops.cpp with a hardware port.
#define PORT
#include "PinLoops.cpp"
