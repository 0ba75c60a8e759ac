// Bytes of a line and frames; functions to cut and impair them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "BitByBit.h"
#include "sbus/Counters.h"

using Bytes = std::vector<uint8_t>;
using Frames = std::vector<Frame>;

template <size_t Size>
Bytes bytesOf(const std::array<uint8_t, Size> &frame) {
  return Bytes(frame.begin(), frame.end());
}

inline Bytes join(const Frames &frames) {
  Bytes bytes;
  for (const Frame &frame : frames) {
    bytes.insert(bytes.end(), frame.begin(), frame.end());
  }
  return bytes;
}

template <typename T>
std::vector<T> operator+(std::vector<T> left, const std::vector<T> &right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

// Returns the bytes that an R7003SB (end byte 08) sends straight after each frame; none for other end bytes.
inline Bytes tailOf(uint8_t end) { return end == 0x08 ? Bytes{0x00, 0x03, 0xC0, 0x33, 0x00} : Bytes{}; }

// Returns `bytes`, a frame or Bytes, from `from` up to but without `to`.
template <typename Container>
Bytes part(const Container &bytes, size_t from, size_t to = SIZE_MAX) {
  const auto at = [&bytes](size_t index) {
    return bytes.begin() + static_cast<std::ptrdiff_t>(std::min(index, bytes.size()));
  };
  return Bytes(at(from), at(to));
}

inline Bytes without(const Frame &frame, size_t index) { return part(frame, 0, index) + part(frame, index + 1); }

inline Bytes with(const Frame &frame, size_t index, uint8_t inserted) {
  return part(frame, 0, index) + Bytes{inserted} + part(frame, index);
}

template <size_t Size>
std::array<uint8_t, Size> withByte(std::array<uint8_t, Size> frame, size_t index, unsigned byte) {
  frame[index] = static_cast<uint8_t>(byte);
  return frame;
}

// Returns true if `some` are frames of `all`, in their order.
inline bool isPartOf(const Frames &some, const Frames &all) {
  auto at = all.begin();
  return std::all_of(some.begin(), some.end(), [&](const Frame &frame) {
    at = std::find(at, all.end(), frame);
    return at != all.end() && at++ != all.end();
  });
}

// Returns what was counted since `before`. Up to then there must be no error.
inline sbus::Counters operator-(sbus::Counters now, const sbus::Counters &before) {
  now.frames -= before.frames;
  now.discardedBytes -= before.discardedBytes;
  now.extraFrames -= before.extraFrames;
  return now;
}
