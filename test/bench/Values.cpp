#include "Values.h"

#include "sbus/Calibrator.h"
#include "support/FakeClock.h"
#include "support/KnownFrames.h"

// Last: their macros min and max break the standard headers after them.
#include <EncodeSBus.h>

#include "Cost.h"
#include "MemorySerial.h"

namespace {

constexpr uint16_t Raws = 2048;
constexpr sbus::CalibratedChannel Channel = {sbus::FrSky, 8};

uint32_t costOfWriting(uint32_t us, bool sends) {
  fakeMicros = 0;
  MemorySerial port;
  EncodeSBus sender(port);
  sender.begin();
  const uint16_t *const channels = Neutral.channels.data();
  bool sent = sender.write(channels, false, false);
  if (!sent) {
    return 0;
  }
  fakeMicros = us;
  const uint32_t cost = instructions::of([&] { sent = sender.write(channels, false, false); });
  return sent == sends ? cost - (sends ? costOfPortsOwn(port) : 0) : 0;
}

// The worst of all `values`, and 0 if the last one's result is not `expected`.
template <typename Result, typename Convert>
uint32_t worst(int from, int until, Result expected, const Convert &convert) {
  uint32_t most = 0;
  Result result = 0;
  for (int value = from; value < until; value++) {
    const uint32_t cost = instructions::of([&] { result = convert(value); });
    most = cost > most ? cost : most;
  }
  return result == expected ? most : 0;
}

void move(sbus::Calibrator &calibrator, uint16_t value, uint32_t &most) {
  Channels channels;
  channels.fill(value);
  const uint32_t cost = instructions::of([&] { calibrator.feed(channels.data(), false, false); });
  most = cost > most ? cost : most;
}

// To the third step's end; the worst call of feed().
uint32_t calibrated(sbus::Calibrator &calibrator) {
  uint32_t most = 0;
  move(calibrator, 1811, most);
  move(calibrator, 172, most);
  move(calibrator, 992, most);
  calibrator.centre();
  move(calibrator, 992, most);
  move(calibrator, 993, most);
  calibrator.high();
  move(calibrator, 1811, most);
  return most;
}

bool isGood(const sbus::Calibration &calibration) {
  return stateOf(calibration) == sbus::StoredState::Good && isCalibrated(calibration.channels[15]);
}

}  // namespace

uint32_t costOfSending() {
  return costOfWriting(9000, true);
}

uint32_t costOfNotDue() {
  return costOfWriting(8999, false);
}

uint32_t costOfMicroseconds() {
  return worst<int16_t>(0, Raws, 2160,
                        [](int raw) { return sbus::toMicroseconds(static_cast<uint16_t>(raw), sbus::FrSky); });
}

uint32_t costOfNormalised() {
  return worst<int16_t>(0, Raws, 1288,
                        [](int raw) { return sbus::toNormalised(static_cast<uint16_t>(raw), sbus::FrSky); });
}

uint32_t costOfFromNormalised() {
  return worst<uint16_t>(-1000, 1001, 1811, [](int thousandths) {
    return sbus::fromNormalised(static_cast<int16_t>(thousandths), sbus::FrSky);
  });
}

uint32_t costOfUnit() {
  return worst<float>(0, 1812, 1, [](int raw) { return sbus::toUnit(static_cast<uint16_t>(raw), sbus::FrSky); });
}

uint32_t costOfCalibrated() {
  return worst<int16_t>(0, 1812, 1000, [](int raw) { return Channel.toNormalised(static_cast<uint16_t>(raw)); });
}

uint32_t costOfFeeding() {
  sbus::Calibrator calibrator;
  const uint32_t cost = calibrated(calibrator);
  sbus::CalibratedChannel found;
  return calibrator.result(15, found) == sbus::Refusal::None ? cost : 0;
}

uint32_t costOfFinishing() {
  sbus::Calibrator calibrator;
  calibrated(calibrator);
  sbus::Calibration calibration;
  uint8_t bad = 0;
  sbus::Refusal refusal = sbus::Refusal::NeverSeen;
  const uint32_t cost = instructions::of([&] { refusal = calibrator.finish(0xFFFF, calibration, bad); });
  return refusal == sbus::Refusal::None && isGood(calibration) ? cost : 0;
}

uint32_t costOfStateOf() {
  sbus::Calibration calibration;
  for (sbus::CalibratedChannel &channel : calibration.channels) {
    channel = Channel;
  }
  seal(calibration);
  sbus::StoredState state = sbus::StoredState::Damaged;
  const uint32_t cost = instructions::of([&] { state = stateOf(calibration); });
  return state == sbus::StoredState::Good && isGood(calibration) ? cost : 0;
}
