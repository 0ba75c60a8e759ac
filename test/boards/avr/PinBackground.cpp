// Pin.cpp with a decoder that listens in the background.
#define BACKGROUND
#include "Pin.cpp"
