// The cost of sending, scaling and calibrating.
#include "Bench.h"

#include <cstdio>
#include <vector>

#include "sbus/Calibrator.h"
#include "support/FakeClock.h"
#include "support/KnownFrames.h"

#include "Cost.h"  // last: Arduino.h has a type named byte
#include <EncodeSBus.h>

namespace {

constexpr sbus::CalibratedChannel Channel = {sbus::FrSky, 8};

// Returns the cost of write(), with micros() but without the port's own instructions.
uint32_t costOfWriting(uint32_t us, bool sends) {
  fakeMicros = 0;
  MemorySerial port;
  EncodeSBus sender(port);
  sender.begin();
  const uint16_t *const channels = Neutral.channels.data();
  bool sent = sender.write(channels, false, false);
  fakeMicros = us;
  const uint32_t cost = instructions::of([&] { sent = sender.write(channels, false, false); });
  return sent == sends ? cost - (sends ? portsOwnOfSending() : 0) : 0;
}

// Returns the worst cost of all values, if the last result is `expected`.
template <typename Result, typename Convert>
uint32_t worst(int from, int last, Result expected, const Convert &convert) {
  uint32_t most = 0;
  Result result = 0;
  for (int value = from; value <= last; value++) {
    const uint32_t cost = instructions::of([&] { result = convert(value); });
    most = cost > most ? cost : most;
  }
  return result == expected ? most : 0;
}

// Calibrates to the end of the third step. Returns the worst call of feed().
uint32_t calibrate(sbus::Calibrator &calibrator) {
  uint32_t most = 0;
  const auto move = [&](uint16_t value) {
    Channels channels;
    channels.fill(value);
    for (uint8_t frames = 0; frames < sbus::Calibrator::HeldFrames; frames++) {
      const uint32_t cost = instructions::of([&] { calibrator.feed(channels.data(), false, false); });
      most = cost > most ? cost : most;
    }
  };
  move(1811);
  move(172);
  move(992);
  calibrator.centre();
  move(992);
  move(993);
  calibrator.high();
  move(1811);
  return most;
}

bool isGood(const sbus::Calibration &calibration) {
  return stateOf(calibration) == sbus::StoredState::Good && isCalibrated(calibration.channels[15]);
}

uint32_t costOfFeeding() {
  sbus::Calibrator calibrator;
  const uint32_t cost = calibrate(calibrator);
  sbus::CalibratedChannel found;
  return calibrator.result(15, found) == sbus::CalibrationError::None ? cost : 0;
}

uint32_t costOfFinishing() {
  sbus::Calibrator calibrator;
  calibrate(calibrator);
  sbus::Calibration calibration;
  uint8_t bad = 0;
  const uint32_t cost = instructions::of([&] { calibrator.finish(0xFFFF, calibration, bad); });
  return isGood(calibration) ? cost : 0;
}

uint32_t costOfStateOf() {
  sbus::Calibration calibration;
  for (sbus::CalibratedChannel &channel : calibration.channels) {
    channel = Channel;
  }
  seal(calibration);
  sbus::StoredState state = sbus::StoredState::Damaged;
  const uint32_t cost = instructions::of([&] { state = stateOf(calibration); });
  return state == sbus::StoredState::Good ? cost : 0;
}

struct Row {
  const char *what;
  uint32_t cost;
  uint32_t most;  // a tenth more than was measured with GCC 12.2
};

std::vector<Row> rows() {
  const auto raw = [](int value) { return static_cast<uint16_t>(value); };
  const auto thousandths = [](int value) { return static_cast<int16_t>(value); };
  return {
      {"`EncodeSBus::write()`: a frame is sent", costOfWriting(9000, true), 597},
      {"... too early for one", costOfWriting(8999, false), 35},
      {"`toMicroseconds()`",
       worst<int16_t>(0, 2047, 2160, [&](int value) { return sbus::toMicroseconds(raw(value), sbus::FrSky); }), 185},
      {"`toNormalised()`",
       worst<int16_t>(0, 2047, 1288, [&](int value) { return sbus::toNormalised(raw(value), sbus::FrSky); }), 185},
      {"... by a calibrated channel",
       worst<int16_t>(0, 1811, 1000, [&](int value) { return Channel.toNormalised(raw(value)); }), 252},
      {"`fromNormalised()`",
       worst<uint16_t>(-1000, 1000, 1811,
                       [&](int value) { return sbus::fromNormalised(thousandths(value), sbus::FrSky); }), 185},
      {"`toUnit()`, a float",
       worst<float>(0, 1811, 1, [&](int value) { return sbus::toUnit(raw(value), sbus::FrSky); }), 650},
      {"`Calibrator::feed()`, 16 channels", costOfFeeding(), 1230},
      {"`Calibrator::finish()`, 16 channels", costOfFinishing(), 19000},
      {"`stateOf()` a stored calibration", costOfStateOf(), 15000},
  };
}

}  // namespace

void printValues() {
  std::printf("\n| sending, scaling, calibrating: the worst call | instructions |\n| --- | --- |\n");
  for (const Row &row : rows()) {
    std::printf("| %s | %lu |\n", row.what, static_cast<unsigned long>(row.cost));
  }
}

void checkValues() {
  for (const Row &row : rows()) {
    atMost(row.what, row.cost, row.most);
  }
}
