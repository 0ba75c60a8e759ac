// A stored calibration of whatever bytes, and a calibration by whatever frames: good only if it can be scaled by.
//
// The input: its first byte is the mode, the others are
//   even: a stored calibration, 132 bytes, what is missing 0; it is judged as it is, and again with its check value
//   right odd:  two bytes for `wanted`, then operations of one byte and what they need:
//     00xxxxxx   begin (x = 0), centre (x = 1), high (x = 2), set the dead zone to 4 * x (else)
//     01xxxxxx   a frame of one value, 32 * x, on all channels; behind it an offset for each channel follows, a byte
//     that
//                is 0..7 times the channel's number
//     10xxxxxx   a frame; two bytes for each of its channels follow
//     11xxxxxx   the last frame again, with failsafe (bit 0), lost frame (bit 1) and one channel (bits 2..5) at 0
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>

#include "sbus/Calibrator.h"

namespace {

using sbus::CalibratedChannel;
using sbus::Calibration;
using sbus::Refusal;
using sbus::StoredState;

void require(bool condition, const char *what) {
  if (!condition) {
    std::fprintf(stderr, "violated: %s\n", what);
    std::abort();
  }
}

class Input {
 public:
  Input(const uint8_t *data, size_t size) : _data(data), _left(size) {}

  bool empty() const { return _left == 0; }
  uint8_t byte() {
    if (_left == 0) {
      return 0;
    }
    _left--;
    return *_data++;
  }
  uint16_t word() {
    const uint8_t low = byte();
    return static_cast<uint16_t>(low | byte() << 8);
  }

 private:
  const uint8_t *_data;
  size_t _left;
};

// The rules once more, each by itself.
bool canBe(const CalibratedChannel &channel) {
  const int low = channel.range.low;
  const int centre = channel.range.centre;
  const int high = channel.range.high;
  const int dead = channel.deadZone;
  const bool empty = low == 0 && centre == 0 && high == 0 && dead == 0;
  const bool forwards = low < centre - dead && centre + dead < high && high <= 2047;
  const bool backwards = high < centre - dead && centre + dead < low && low <= 2047;
  return empty || forwards || backwards;
}

// The check value once more: the bits one after the other, through a register of 16.
uint16_t crcOf(const uint8_t *bytes, size_t count) {
  unsigned crc = 0xFFFF;
  for (size_t bit = 0; bit < 8 * count; bit++) {
    const unsigned next = bytes[bit / 8] >> (7 - bit % 8) & 1u;
    crc = (crc << 1 & 0xFFFF) ^ ((crc >> 15 ^ next) * 0x1021);
  }
  return static_cast<uint16_t>(crc);
}

void requireExact(const CalibratedChannel &channel) {
  const sbus::Range &range = channel.range;
  if (!sbus::isCalibrated(channel)) {
    for (const uint16_t raw : {uint16_t{0}, uint16_t{992}, uint16_t{65535}}) {
      require(channel.toNormalised(raw) == 0 && channel.toMicroseconds(raw) == 1500, "uncalibrated is centred");
    }
    return;
  }
  require(channel.toNormalised(range.low) == -1000 && channel.toMicroseconds(range.low) == 988, "low is exact");
  require(channel.toNormalised(range.centre) == 0 && channel.toMicroseconds(range.centre) == 1500, "centre is exact");
  require(channel.toNormalised(range.high) == 1000 && channel.toMicroseconds(range.high) == 2012, "high is exact");
  const int direction = range.low < range.high ? 1 : -1;
  int last = channel.toNormalised(0);
  for (unsigned raw = 1; raw < 2048; raw++) {
    const int value = channel.toNormalised(static_cast<uint16_t>(raw));
    require((value - last) * direction >= 0, "values rise from low to high");
    last = value;
  }
}

// Of any channel, possible or not: the sanitizer looks on.
void scale(const CalibratedChannel &channel, uint16_t raw) {
  require(channel.toNormalised(raw) >= -32767 && channel.toMicroseconds(raw) >= -32767, "no further than 32767");
}

void judge(const Calibration &calibration) {
  const StoredState state = sbus::stateOf(calibration);
  bool possible = true;
  for (const CalibratedChannel &channel : calibration.channels) {
    require(sbus::isPossible(channel) == canBe(channel), "isPossible() is what its rules say");
    possible = possible && canBe(channel);
    scale(channel, calibration.checkValue);
  }
  require(state != StoredState::Good || possible, "good only if all channels can be");
  require((state == StoredState::OtherVersion) == (calibration.version != sbus::CalibrationVersion), "the version");
  Calibration sealed = calibration;
  seal(sealed);
  require(sbus::stateOf(sealed) == (possible ? StoredState::Good : StoredState::Impossible),
          "sealed: good, if possible");
  uint8_t bytes[sizeof sealed];
  std::memcpy(bytes, &sealed, sizeof sealed);
  require(sealed.checkValue == crcOf(bytes, sizeof sealed - 2), "the check value is CRC-16/CCITT-FALSE of the others");
  const bool wasSealed = std::memcmp(&sealed, &calibration, sizeof sealed) == 0;
  require((state == StoredState::Good || state == StoredState::Impossible) == wasSealed,
          "only what was sealed is intact");
  if (possible) {
    for (const CalibratedChannel &channel : calibration.channels) {
      requireExact(channel);
    }
  }
}

void store(Input input) {
  uint8_t bytes[sizeof(Calibration)];
  for (uint8_t &byte : bytes) {
    byte = input.byte();
  }
  Calibration calibration;
  std::memcpy(&calibration, bytes, sizeof bytes);
  judge(calibration);
  // Nearly what can be: numbers within 11 bits, dead zones small.
  for (CalibratedChannel &channel : calibration.channels) {
    channel.range.low &= 2047;
    channel.range.centre &= 2047;
    channel.range.high &= 2047;
    channel.deadZone &= 127;
  }
  judge(calibration);
}

void requireSame(const Calibration &one, int filling, const char *what) {
  Calibration other;
  std::memset(&other, filling, sizeof other);
  require(std::memcmp(&one, &other, sizeof other) == 0, what);
}

void checkResults(const sbus::Calibrator &calibrator, uint16_t wanted) {
  constexpr int Filling = 0xA5;
  constexpr uint8_t NoChannel = 99;
  Calibration calibration;
  std::memset(&calibration, Filling, sizeof calibration);
  uint8_t channel = NoChannel;
  const Refusal refusal = calibrator.finish(wanted, calibration, channel);
  require(refusal == Refusal::None || channel < sbus::ProportionalCount, "a refusal names a channel");
  unsigned firstBad = sbus::ProportionalCount;
  for (uint8_t i = 0; i < sbus::ProportionalCount; i++) {
    CalibratedChannel found = {{0, 0, 0}, 0};
    const Refusal reason = calibrator.result(i, found);
    require(sbus::isCalibrated(found) == (reason == Refusal::None), "refused, and nothing touched; or found");
    require(canBe(found), "what is found can be");
    if (reason != Refusal::None && (wanted >> i & 1) != 0 && firstBad == sbus::ProportionalCount) {
      firstBad = i;
      require(reason == refusal, "the reason is that of the first bad channel");
    }
    if (refusal == Refusal::None && reason == Refusal::NotCentred) {
      require(sbus::isCalibrated(calibration.channels[i]) && calibration.channels[i].deadZone == 0,
              "what is not wanted may rest anywhere");
    } else if (refusal == Refusal::None && reason == Refusal::NotPushed) {
      require(calibration.channels[i].range.low < calibration.channels[i].range.high, "what is not pushed runs forwards");
    } else if (refusal == Refusal::None) {
      require(std::memcmp(&found, &calibration.channels[i], sizeof found) == 0, "finish() gives what result() does");
    }
  }
  if (refusal == Refusal::None) {
    require(firstBad == sbus::ProportionalCount && channel == NoChannel, "none wanted is bad, none is named");
    require(sbus::stateOf(calibration) == StoredState::Good, "what is finished is good");
    judge(calibration);
  } else {
    require(channel == firstBad, "the first bad channel that is wanted is named");
    requireSame(calibration, Filling, "a refusal leaves the calibration as it is");
  }
  require(text(refusal)[0] == (refusal == Refusal::None ? '\0' : ' '), "there are words for it");
}

void drive(Input input) {
  const uint16_t wanted = input.word();
  sbus::Calibrator calibrator;
  uint16_t channels[sbus::ProportionalCount] = {};  // the sanitizer guards its end
  while (!input.empty()) {
    const uint8_t operation = input.byte();
    const uint8_t x = operation & 0x3F;
    if (operation >= 0xC0) {
      const uint16_t kept = channels[x >> 2];
      channels[x >> 2] = 0;
      calibrator.feed(channels, (x & 1) != 0, (x & 2) != 0);
      channels[x >> 2] = kept;
    } else if (operation >= 0x40) {
      const uint8_t each = operation < 0x80 ? input.byte() & 7 : 0;
      for (uint8_t i = 0; i < sbus::ProportionalCount; i++) {
        channels[i] = operation < 0x80 ? static_cast<uint16_t>(32 * x + each * i) : input.word();
      }
      calibrator.feed(channels, false, false);
    } else if (x == 0) {
      calibrator.begin();
    } else if (x == 1) {
      calibrator.centre();
    } else if (x == 2) {
      calibrator.high();
    } else {
      calibrator.setDeadZone(static_cast<uint16_t>(4 * x));
    }
  }
  checkResults(calibrator, wanted);
  checkResults(calibrator, 0);
  checkResults(calibrator, 0xFFFF);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  Input input(data, size);
  if ((input.byte() & 1) == 0) {
    store(input);
  } else {
    drive(input);
  }
  return 0;
}
