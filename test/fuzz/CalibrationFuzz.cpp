// A stored calibration of any bytes, and a calibration with any frames, is good only if it can be used for scaling.
//
// The input: its first byte is the mode, the others are
//   even: a stored calibration, 132 bytes, missing bytes are 0; it is judged as it is, and again with its check value
//   right odd:  two bytes for `wanted`, then operations of one byte and what they need:
//     00xxxxxx   begin (x = 0), centre (x = 1), high (x = 2), set the dead zone to 4 * x (other x)
//     01xxxxxx   a frame of one value, 32 * x, on all channels; then an offset for each channel, a byte that is 0..7
//                times the channel's number
//     10xxxxxx   a frame; two bytes for each of its channels follow
//     11xxxxxx   the last frame again, with failsafe (bit 0), lost frame (bit 1) and one channel (bits 2..5) at 0
#include <cstring>

#include "fuzz/Require.h"
#include "support/CalibrationRules.h"
#include "support/Radio.h"

namespace {

using sbus::CalibratedChannel;
using sbus::Calibration;
using sbus::CalibrationError;
using sbus::StoredState;

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

void judge(const Calibration &calibration) {
  const StoredState state = sbus::stateOf(calibration);
  bool possible = true;
  for (const CalibratedChannel &channel : calibration.channels) {
    require(sbus::isPossible(channel) == possibleByRule(channel), "isPossible() is what its rules say");
    possible = possible && possibleByRule(channel);
    // Scales by any channel, possible or not, under the sanitizer.
    const uint16_t raw = calibration.checkValue;
    require(channel.toNormalised(raw) >= -32767 && channel.toMicroseconds(raw) >= -32767, "no further than 32767");
    require(!possibleByRule(channel) || !sbus::isCalibrated(channel) || isExact(channel), "exact at the three points");
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
}

void store(Input input) {
  uint8_t bytes[sizeof(Calibration)];
  for (uint8_t &byte : bytes) {
    byte = input.byte();
  }
  Calibration calibration;
  std::memcpy(&calibration, bytes, sizeof bytes);
  judge(calibration);
  // Makes it nearly possible: numbers within 11 bits, small dead zones.
  for (CalibratedChannel &channel : calibration.channels) {
    channel.range.low &= 2047;
    channel.range.centre &= 2047;
    channel.range.high &= 2047;
    channel.deadZone &= 127;
  }
  judge(calibration);
}

void checkResults(const sbus::Calibrator &calibrator, uint16_t wanted) {
  const Finished finished(calibrator, wanted);
  const bool good = finished.error == CalibrationError::None;
  unsigned firstBad = Radio::NoChannel;
  bool any = false;
  for (uint8_t i = 0; i < sbus::ProportionalCount; i++) {
    CalibratedChannel found = {{0, 0, 0}, 0};
    const CalibratedChannel &stored = finished.calibration.channels[i];
    const CalibrationError reason = calibrator.result(i, found);
    require(sbus::isCalibrated(found) == (reason == CalibrationError::None), "rejected, and nothing touched; or found");
    require(possibleByRule(found), "what is found can be");
    const bool named = wanted == 0 ? !good : (wanted >> i & 1) != 0;  // none required, none found: CH1 is named
    if (reason != CalibrationError::None && named && firstBad == Radio::NoChannel) {
      firstBad = i;
      require(reason == finished.error, "the reason is that of the first bad channel");
    }
    any = any || (good ? sbus::isCalibrated(stored) : reason == CalibrationError::None);
    if (good && reason == CalibrationError::NotCentred) {
      require(sbus::isCalibrated(stored) && stored.deadZone == 0, "what is not wanted may rest anywhere");
    } else if (good && reason == CalibrationError::NotPushed) {
      require(stored.range.low < stored.range.high, "what is not pushed runs forwards");
    } else if (good) {
      require(std::memcmp(&found, &stored, sizeof found) == 0, "finish() gives what result() does");
    }
  }
  require(finished.channel == firstBad, "the first bad channel that is wanted is named");
  require(good == (firstBad == Radio::NoChannel), "all that are wanted are good, or it is rejected");
  require(wanted != 0 || any == good, "none is wanted: rejected if none is good");
  require(finished.isGood() == good && finished.isTouched() == good, "good, or left as it is");
  if (good) {
    judge(finished.calibration);
  }
  require(text(finished.error)[0] == (good ? '\0' : ' '), "there are words for it");
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
