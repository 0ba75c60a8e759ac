// A line, and its observer's reports.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "line/Observer.h"
#include "support/Bytes.h"

using line::Character;
using line::Observer;
using line::Stretch;

constexpr uint64_t PeriodUs = 9000;

struct Watched {
  Observer observer;
  std::vector<Stretch> stretches;
  uint64_t us = 0;

  explicit Watched(uint32_t characterUs = line::CharacterUs) : _characterUs(characterUs) {
    observer.reset(0, characterUs);
    observer.listen([this](const Stretch &stretch) { stretches.push_back(stretch); });
  }

  Watched &send(const Bytes &bytes, size_t bad = SIZE_MAX) {
    for (size_t i = 0; i < bytes.size(); i++) {
      us += _characterUs;
      Character character;
      character.endUs = us;
      character.value = bytes[i];
      character.bad = i == bad;
      observer.put(character);
    }
    return *this;
  }

  Watched &gap(uint64_t gapUs) {
    us += gapUs;
    observer.idleUntil(us);
    return *this;
  }

  // Puts a frame of 16 channels, each `value`, and the gap to the next frame.
  Watched &frame(uint16_t value, bool failsafe = false, bool lostFrame = false, uint64_t periodUs = PeriodUs) {
    return send(frameOf(value, failsafe, lostFrame)).gap(periodUs - 25 * _characterUs);
  }

  static Bytes frameOf(uint16_t value, bool failsafe = false, bool lostFrame = false) {
    uint16_t channels[sbus::ChannelCount];
    std::fill_n(channels, sbus::ChannelCount, value);
    channels[16] = 1;
    channels[17] = 0;
    Bytes bytes(sbus::FrameSize);
    sbus::pack(bytes.data(), channels, failsafe, lostFrame);
    return bytes;
  }

  size_t frames() const {
    return static_cast<size_t>(
        std::count_if(stretches.begin(), stretches.end(), [](const Stretch &stretch) { return stretch.isFrame(); }));
  }

 private:
  uint32_t _characterUs;
};

inline Bytes bytesOf(const Stretch &stretch) {
  Bytes bytes;
  for (const Character &character : stretch.characters) {
    bytes.push_back(character.value);
  }
  return bytes;
}
