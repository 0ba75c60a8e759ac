// What a sketch passes to a function: arrays, frames and decoders. Case 0 compiles; the others must not. Each line has
// the number of a case, and what the compiler says. 1 The array is too small: CH1..CH16, CH17 and CH18 are uint16_t
// channels.18. 2 The array is too small: CH1..CH24 are uint16_t channels.24. 3 The array is too small: CH1..CH16 are
// uint16_t channels.16. 4 The array is too small: CH1..CH16, CH17 and CH18 are uint16_t channels.18. 5 The array is too
// small: CH1..CH24 are uint16_t channels.24. 6 The array is too small: CH1..CH16 are uint16_t channels.16. 7 The array
// is too small: CH1..CH16, CH17 and CH18 are uint16_t channels.18. 8 nullptr_t 9 const uint16_t 10 SBusFrame24 11
// DecodeSBusTelemetryOf<.* is an inaccessible base of .*SBus2Sensor 12 DecodeSBusOf<.* is an inaccessible base of
// .*SBus2Sensor 13 no member named .*decodeExtraChannels 14 Write DecodeSBus dSBus(Serial1), without the &
#include <DecodeSBus32.h>
#include <EncodeSBus.h>
#include <SBus2Sensor.h>
#include <sbus/Calibrator.h>
#include <sbus/LinkQuality.h>

DecodeSBus dSBus(Serial1);
DecodeSBus24 dSBus24(Serial1);
DecodeSBus32 dSBus32(Serial1);
DecodeSBusTelemetry telemetry(Serial1);
SBus2Sensor sensor(Serial1);
sbus::LinkQuality quality;
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

void function(uint16_t channels[]) { dSBus.decodeSBusFrame(channels, failsafe, lostFrame); }

template <typename Events, typename Polling>
void openTelemetry(DecodeSBusTelemetryOf<Events, Polling> &decoder) {
  decoder.begin();
}

template <typename Format, typename Events, typename Polling>
void open(DecodeSBusOf<Format, Events, Polling> &decoder) {
  decoder.begin();
}

void arguments() {
#if CASE == 0
  dSBus.decodeSBusFrame(eighteen, failsafe, lostFrame);
  dSBus.decodeSBusFrame(&twentyFour[0], failsafe, lostFrame);
  dSBus.decodeSBusFrame(elsewhere, failsafe, lostFrame);
  dSBus.decodeSBusFrame(pointer, failsafe, lostFrame);
  dSBus.decodeSBusFrame(frame.channels, failsafe, lostFrame);
  dSBus32.decodeSBusFrame(eighteen, failsafe, lostFrame);
  dSBus32.decodeExtraChannels(sixteen);
  telemetry.decodeSBusFrame(twentyFour, failsafe, lostFrame);
  dSBus24.decodeSBusFrame(frame24.channels, failsafe, lostFrame);
  eSBus.write(constant, failsafe, lostFrame);
  eSBus.write(elsewhere, failsafe, lostFrame);
  eSBus24.write(constant, failsafe, lostFrame);
  calibrator.feed(frame.channels, failsafe, lostFrame);
  sbus::unpack(bytes, eighteen);
  openTelemetry(telemetry);
  open(dSBus);
  open(dSBus32);
  open(telemetry);
  quality.update(sensor);
  sensor.read(frame);
  sensor.setTimeout(50);
#elif CASE == 1
  dSBus.decodeSBusFrame(sixteen, failsafe, lostFrame);
#elif CASE == 2
  dSBus24.decodeSBusFrame(eighteen, failsafe, lostFrame);
#elif CASE == 3
  dSBus32.decodeExtraChannels(eight);
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
#elif CASE == 11
  openTelemetry(sensor);
#elif CASE == 12
  open(sensor);
#elif CASE == 13
  dSBus.decodeExtraChannels(sixteen);
#elif CASE == 14
  DecodeSBus pointed(&Serial1);
#endif
}
