// A sketch's arrays. Case 0 compiles; the others must not. Each line has the number of a case, and what the compiler says.
// 1 The array is too small: CH1..CH16, CH17 and CH18 are uint16_t channels.18.
// 2 The array is too small: CH1..CH24 are uint16_t channels.24.
// 3 The array is too small: CH1..CH16 are uint16_t channels.16.
// 4 The array is too small: CH1..CH16, CH17 and CH18 are uint16_t channels.18.
// 5 The array is too small: CH1..CH24 are uint16_t channels.24.
// 6 The array is too small: CH1..CH16 are uint16_t channels.16.
// 7 The array is too small: CH1..CH16, CH17 and CH18 are uint16_t channels.18.
// 8 nullptr_t
// 9 const uint16_t
// 10 SBusFrame24
#include <DecodeSBusTelemetry.h>
#include <EncodeSBus.h>
#include <sbus/Calibrator.h>

DecodeSBus dSBus(Serial1);
DecodeSBus24 dSBus24(Serial1);
DecodeSBusTelemetry telemetry(Serial1);
EncodeSBus eSBus(Serial1);
EncodeSBus24 eSBus24(Serial1);
sbus::Calibrator calibrator;
uint16_t eight[8], sixteen[16], eighteen[18], twentyFour[24];
const uint16_t constant[24] = {};
uint8_t bytes[25];
extern uint16_t elsewhere[];
uint16_t *volatile pointer;
bool failsafe, lostFrame;
SBusFrame frame;
SBusFrame24 frame24;

void function(uint16_t channels[]) {
  dSBus.decodeSBusFrame(channels, failsafe, lostFrame);
}

void arrays() {
#if CASE == 0
  dSBus.decodeSBusFrame(eighteen, failsafe, lostFrame);
  dSBus.decodeSBusFrame(&twentyFour[0], failsafe, lostFrame);
  dSBus.decodeSBusFrame(elsewhere, failsafe, lostFrame);
  dSBus.decodeSBusFrame(pointer, failsafe, lostFrame);
  dSBus.decodeSBusFrame(frame.channels, failsafe, lostFrame);
  dSBus.decodeExtraChannels(sixteen);
  telemetry.decodeSBusFrame(twentyFour, failsafe, lostFrame);
  dSBus24.decodeSBusFrame(frame24.channels, failsafe, lostFrame);
  eSBus.write(constant, failsafe, lostFrame);
  eSBus.write(elsewhere, failsafe, lostFrame);
  eSBus24.write(constant, failsafe, lostFrame);
  calibrator.feed(frame.channels, failsafe, lostFrame);
  sbus::unpack(bytes, eighteen);
#elif CASE == 1
  dSBus.decodeSBusFrame(sixteen, failsafe, lostFrame);
#elif CASE == 2
  dSBus24.decodeSBusFrame(eighteen, failsafe, lostFrame);
#elif CASE == 3
  dSBus.decodeExtraChannels(eight);
#elif CASE == 4
  eSBus.write(sixteen, failsafe, lostFrame);
#elif CASE == 5
  eSBus24.write(eighteen, failsafe, lostFrame);
#elif CASE == 6
  calibrator.feed(eight, failsafe, lostFrame);
#elif CASE == 7
  sbus::unpack(bytes, sixteen);
#elif CASE == 8
  dSBus.decodeSBusFrame(nullptr, failsafe, lostFrame);
#elif CASE == 9
  dSBus.decodeSBusFrame(constant, failsafe, lostFrame);
#elif CASE == 10
  dSBus.read(frame24);
#endif
}
