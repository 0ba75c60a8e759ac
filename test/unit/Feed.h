// Feeds a Receiver with bytes in lumps, as a serial port would, and notes every frame that it completes.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <vector>

#include "BitByBit.h"
#include "sbus/Receiver.h"

using Bytes = std::vector<uint8_t>;
using Frames = std::vector<Frame>;

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

inline Frame lastFrame(const sbus::Receiver &receiver) {
  Frame frame;
  std::memcpy(frame.data(), receiver.frame(), frame.size());
  return frame;
}

// Offers `bytes` in lumps of at most `lump`, each cut further where the receiver has no more room.
inline Frames feed(sbus::Receiver &receiver, const Bytes &bytes, size_t lump = 1) {
  Frames frames;
  for (size_t at = 0; at < bytes.size();) {
    const size_t lumpEnd = std::min(at + lump, bytes.size());
    while (at < lumpEnd) {
      REQUIRE(receiver.room() >= 1);
      REQUIRE(receiver.room() <= 25);
      const size_t count = std::min<size_t>(receiver.room(), lumpEnd - at);
      std::memcpy(receiver.space(), bytes.data() + at, count);
      at += count;
      if (receiver.received(static_cast<uint8_t>(count))) {
        frames.push_back(lastFrame(receiver));
      }
    }
  }
  return frames;
}

inline Frames feedNew(const Bytes &bytes, size_t lump = 1) {
  sbus::Receiver receiver;
  return feed(receiver, bytes, lump);
}
