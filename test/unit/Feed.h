// Feeds a Receiver with looks at a line, as a sketch would, and notes every frame that it delivers.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "BitByBit.h"
#include "runtime/BoardUart.h"
#include "sbus/Receiver.h"

using Bytes = std::vector<uint8_t>;
using Frames = std::vector<Frame>;

inline Bytes bytesOf(const Frame &frame) {
  return Bytes(frame.begin(), frame.end());
}

inline Bytes join(const Frames &frames) {
  Bytes bytes;
  for (const Frame &frame : frames) {
    bytes.insert(bytes.end(), frame.begin(), frame.end());
  }
  return bytes;
}

inline Bytes operator+(Bytes left, const Bytes &right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

// `bytes` from `from` up to but without `to`.
inline Bytes part(const Bytes &bytes, size_t from, size_t to = SIZE_MAX) {
  const auto at = [&bytes](size_t index) {
    return bytes.begin() + static_cast<std::ptrdiff_t>(std::min(index, bytes.size()));
  };
  return Bytes(at(from), at(to));
}
inline Bytes part(const Frame &frame, size_t from, size_t to = SIZE_MAX) {
  return part(bytesOf(frame), from, to);
}

inline Bytes without(const Frame &frame, size_t index) {
  return part(frame, 0, index) + part(frame, index + 1);
}

inline Bytes with(const Frame &frame, size_t index, uint8_t inserted) {
  return part(frame, 0, index) + Bytes{inserted} + part(frame, index);
}

inline Frame withByte(Frame frame, size_t index, unsigned byte) {
  frame[index] = static_cast<uint8_t>(byte);
  return frame;
}

inline Frame lastFrame(const sbus::Receiver &receiver) {
  Frame frame;
  std::memcpy(frame.data(), receiver.frame(), frame.size());
  return frame;
}

struct Feeder {
  static constexpr uint32_t CharacterUs = 120;

  sbus::Receiver receiver;
  uint32_t now;
  const uint32_t characterUs;

  explicit Feeder(uint32_t startUs = 0, uint32_t characterTime = CharacterUs)
      : now(startUs), characterUs(characterTime) {
    receiver.reset(now, static_cast<uint8_t>(characterUs));
  }

  // One look, now, that finds `bytes`. Returns the frames that it brings.
  Frames look(const Bytes &bytes) {
    Frames frames;
    size_t at = 0;
    size_t count;
    size_t room;
    do {
      room = static_cast<size_t>(receiver.room());
      REQUIRE(room >= 1);
      REQUIRE(room <= 32);
      count = std::min(room, bytes.size() - at);
      std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), count, receiver.space());
      at += count;
      const size_t waiting = count == room ? bytes.size() - at : 0;
      if (receiver.received(static_cast<uint8_t>(count), static_cast<uint8_t>(waiting), now)) {
        frames.push_back(lastFrame(receiver));
      }
    } while (count == room);
    return frames;
  }

  // `us` without a byte and without a look.
  Feeder &wait(uint32_t us) {
    now += us;
    return *this;
  }

  // `bytes` back to back on the wire, one look whenever `lump` of them have come.
  Frames feed(const Bytes &bytes, size_t lump = 1) {
    Frames frames;
    for (size_t at = 0; at < bytes.size(); at += lump) {
      const Bytes burst = part(bytes, at, at + lump);
      now += characterUs * static_cast<uint32_t>(burst.size());
      for (const Frame &frame : look(burst)) {
        frames.push_back(frame);
      }
    }
    return frames;
  }

  // A look at an idle line, long after the last byte.
  Frames idle(uint32_t us = 3000) {
    wait(us);
    return look({});
  }
};

// The frames in `bytes`, without a pause among them. A last look without bytes lets go a frame that waits for a successor.
inline Frames feedNew(const Bytes &bytes, size_t lump = 1) {
  Feeder feeder;
  Frames frames = feeder.feed(bytes, lump);
  for (const Frame &frame : feeder.idle()) {
    frames.push_back(frame);
  }
  return frames;
}

// A wire: characters and pauses, and what the board's driver and a loop() of some length make of them.
class Wire {
 public:
  explicit Wire(uint32_t characterUs = host::CharacterUs)
      : _characterUs(characterUs), _us(1000 * characterUs / host::CharacterUs) {}

  Wire &send(const Bytes &bytes) {
    for (const uint8_t byte : bytes) {
      _us += _characterUs;
      host::Character character;
      character.endUs = _us;
      character.value = byte;
      _characters.push_back(character);
    }
    return *this;
  }
  Wire &send(const Frame &frame) { return send(bytesOf(frame)); }

  Wire &pause(uint64_t us) {
    _us += us;
    return *this;
  }

  // What a receiver finds that looks every `loopUs`, and for 20 ms more than the wire goes on.
  Frames frames(uint32_t loopUs) const {
    Feeder feeder(0, _characterUs);
    return play(feeder, loopUs);
  }

  Frames play(Feeder &feeder, uint32_t loopUs) const {
    host::BoardUart uart;
    uart.open(0, _characterUs);
    Frames found;
    size_t next = 0;
    const uint32_t start = feeder.now;
    for (uint64_t us = loopUs; us <= _us + 20000 + loopUs; us += loopUs) {
      for (; next < _characters.size() && _characters[next].endUs <= us; next++) {
        uart.receive(_characters[next]);
      }
      uart.advance(us);
      Bytes bytes(host::BoardUart::BufferSize);
      bytes.resize(static_cast<size_t>(uart.read(bytes.data(), bytes.size())));
      feeder.now = start + static_cast<uint32_t>(us);
      for (const Frame &frame : feeder.look(bytes)) {
        found.push_back(frame);
      }
      if (bytes.size() >= 63) {
        feeder.receiver.broken();
      }
    }
    return found;
  }

 private:
  const uint32_t _characterUs;
  uint64_t _us;
  std::vector<host::Character> _characters;
};
