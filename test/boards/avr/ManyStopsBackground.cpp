// ManyStops.cpp, with a DecodeSBusBackground.
#define IN_BACKGROUND
#include "ManyStops.cpp"
