// Feeds a FrameFinder with polls of a line, as a sketch would, and notes every frame that it delivers.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "Bytes.h"
#include "KnownFrames.h"
#include "board/BoardUart.h"
#include "sbus/ExtraFrame.h"
#include "sbus/FrameFinder.h"

template <typename Format, typename Events>
std::array<uint8_t, Format::Size> lastFrame(const sbus::FrameFinderOf<Format, Events> &finder) {
  std::array<uint8_t, Format::Size> frame;
  std::memcpy(frame.data(), finder.frame(), frame.size());
  return frame;
}

template <typename Format, typename Events = sbus::NoEvents>
struct FeederOf {
  static constexpr uint32_t CharacterUs = 120;
  static constexpr uint32_t GapUs = 4000;  // T = 7 ms

  using Frames = std::vector<std::array<uint8_t, Format::Size>>;

  sbus::FrameFinderOf<Format, Events> finder;
  uint32_t now;

  explicit FeederOf(uint32_t startUs = 0) : now(startUs) { finder.reset(now, CharacterUs); }

  // Polls now, and finds `bytes`. Returns the resulting frames.
  Frames poll(const Bytes &bytes) {
    Frames frames;
    if (bytes.empty()) {
      return note(finder.idle(now));
    }
    finder.poll(static_cast<unsigned>(bytes.size()), now);
    for (size_t at = 0; at < bytes.size();) {
      const int room = finder.room();
      REQUIRE(room >= 1);
      const size_t count = std::min(static_cast<size_t>(room), bytes.size() - at);
      std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), count, finder.space());
      at += count;
      frames = frames + note(finder.received(static_cast<int>(count), static_cast<int>(bytes.size() - at)));
    }
    return frames;
  }

  // Lets `us` pass without a poll.
  FeederOf &block(uint32_t us) {
    now += us;
    return *this;
  }

  // Lets `us` pass without a byte, and polls at the end. A frame that has waited for this is in `waited`.
  FeederOf &wait(uint32_t us) {
    waited = block(us).poll({});
    return *this;
  }
  Frames waited;

  // Feeds `bytes` back to back, with a poll whenever `burst` of them have come.
  Frames feed(const Bytes &bytes, size_t burst = 1) {
    Frames frames;
    for (size_t at = 0; at < bytes.size(); at += burst) {
      const Bytes some = part(bytes, at, at + burst);
      now += CharacterUs * static_cast<uint32_t>(some.size());
      frames = frames + poll(some);
    }
    return frames;
  }

  // Makes the loop period known: some polls that find noise, `periodUs` apart, then a gap. counted() begins after that.
  FeederOf &settle(uint32_t periodUs = CharacterUs, uint32_t gapUs = GapUs) {
    for (unsigned noise = 0; noise < 6; noise++) {
      wait(periodUs).poll({0x55});
    }
    _before = finder.counters();
    return wait(gapUs);
  }

  // settle(), and three frames without 0F in their payload, with gaps: the line variant is known.
  FeederOf &lock(uint8_t end = 0x00) {
    settle();
    for (unsigned number = 0; number < 3; number++) {
      feed(bytesOf(plainFrame(number, end)) + tailOf(end));
      wait(GapUs);
    }
    REQUIRE(finder.counters().frames == 3);
    _before = finder.counters();
    return *this;
  }

  sbus::Counters counted() const { return finder.counters() - _before; }

 private:
  Frames note(const uint8_t *frame) {
    if (frame == nullptr) {
      return {};
    }
    REQUIRE(frame == finder.frame());
    return {lastFrame(finder)};
  }

  sbus::Counters _before = {};
};

using Feeder = FeederOf<sbus::Frame16>;
using ExtraFeeder = FeederOf<sbus::Frame16Extra, sbus::ExtraFrame>;

// Characters and gaps, read through the board's driver by a loop() of some period.
class TimedLine {
 public:
  TimedLine &send(const Bytes &bytes) {
    for (const uint8_t byte : bytes) {
      _us += line::CharacterUs;
      line::Character character;
      character.endUs = _us;
      character.value = byte;
      _characters.push_back(character);
    }
    return *this;
  }
  template <size_t Size>
  TimedLine &send(const std::array<uint8_t, Size> &frame) {
    return send(bytesOf(frame));
  }

  TimedLine &gap(uint64_t us) {
    _us += us;
    return *this;
  }

  // Polls a finder every `loopUs`, until 20 ms after the last character. Returns what it delivers, and its counters.
  template <typename Format = sbus::Frame16, typename Events = sbus::NoEvents>
  typename FeederOf<Format>::Frames frames(uint32_t loopUs, sbus::Counters *counters = nullptr) const {
    FeederOf<Format, Events> feeder;
    const uint32_t start = feeder.settle(loopUs).now;
    host::BoardUart uart;
    uart.open(0);
    typename FeederOf<Format>::Frames found;
    size_t next = 0;
    for (uint64_t us = loopUs; us <= _us + 20000 + loopUs; us += loopUs) {
      for (; next < _characters.size() && _characters[next].endUs <= us; next++) {
        uart.receive(_characters[next]);
      }
      uart.advance(us);
      Bytes bytes(host::BoardUart::BufferSize);
      bytes.resize(static_cast<size_t>(uart.read(bytes.data(), bytes.size())));
      feeder.now = start + static_cast<uint32_t>(us);
      found = found + feeder.poll(bytes);
      if (bytes.size() >= 63) {
        feeder.finder.bytesLost();
      }
    }
    if (counters != nullptr) {
      *counters = feeder.counted();
    }
    return found;
  }

 private:
  uint64_t _us = 0;
  std::vector<line::Character> _characters;
};
