// These must not compile. Each line has the number of a case, and what the compiler says; on a core whose timers the
// library does not know the first line holds for all.
// 0 knows no timer of this core.*extras/docs/interrupts.md
// 1 An interrupt cannot read this port.*extras/docs/interrupts.md
// 2 would delay the answers of an SBus2Sensor.*extras/docs/interrupts.md
// 3 of type .DecodeSBus&.* from expression of type .DecodeSBusBackground
#include <DecodeSBusBackground.h>

#if CASE == 1
DecodeSBusBackground dSBus(static_cast<Stream &>(Serial1));
#elif CASE == 2
#include <SBus2Sensor.h>
#elif CASE == 3
DecodeSBusBackground dSBus(Serial1);
void open(DecodeSBus &decoder) { decoder.begin(); }
void setup() { open(dSBus); }
#endif
