// Two decoders read the line, one for 16 channels and one for 24. The one that finds more of the newest frames is the
// right one.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "line/Segments.h"
#include "sbus/FrameFinder.h"

namespace line {

// All that are counts.
constexpr uint32_t sbus::Counters::*AllCounts[] = {
    &sbus::Counters::frames,         &sbus::Counters::lostFrames,      &sbus::Counters::failsafeFrames,
    &sbus::Counters::rejectedByEnd,  &sbus::Counters::rejectedByFlags, &sbus::Counters::rejectedByLength,
    &sbus::Counters::discardedBytes, &sbus::Counters::resyncs,         &sbus::Counters::overflows,
    &sbus::Counters::shortfalls,     &sbus::Counters::extraFrames,     &sbus::Counters::otherSizeFrames};

// Takes a decoder's events, and maps them to places on the line.
class Places : public sbus::NoEvents {
 public:
  // Takes the place of the decoder's next byte.
  void put(uint64_t at) { _open.push_back(at); }

  // Returns the place of the first byte that may still belong to a frame, or `end`.
  uint64_t openAt(uint64_t end) const { return _open.empty() ? end : _open.front(); }

  void extra(const uint8_t *, uint32_t) { found(Stretch::Kind::Extra, sbus::FrameSize, 0); }
  void discarded(const uint8_t *, int count) { _open.erase(_open.begin(), _open.begin() + count); }
  void rejected(int at, sbus::Rejection why);
  bool seesEachGap() const { return !isBursty; }

  // Returns the counters without the frames that had a character error, which the decoder does not see.
  sbus::Counters withoutErrors(sbus::Counters counters) const;

  bool isBursty = true;              // a port delivers bytes in bursts, which hide gaps
  int votes = 0;                     // frames that speak for this decoder, since the last decision
  std::vector<Piece> pieces;         // found by the last call
  std::vector<Rejected> rejections;  // only the newest ones

 protected:
  void found(Stretch::Kind variant, int size, uint8_t flags);

 private:
  bool isDoubtful(Stretch::Kind variant, uint64_t begin) const;

  sbus::Counters _bad{};       // frames that had a character error
  std::deque<uint64_t> _open;  // places of the bytes still in the decoder
  uint64_t _foundEnd = 0;      // place after the last frame; 0 before the first
};

template <typename Format>
struct PlacesOf : Places {
  void accepted(const uint8_t *frame) {
    found(Format::Size == sbus::FrameSize ? Stretch::Kind::Frame : Stretch::Kind::Frame24, Format::Size,
          Format::flags(frame));
  }
};

class Decoders {
 public:
  void reset(uint64_t nowUs, uint32_t characterUs);

  // Takes the time up to which there are no further bytes. Returns the pieces found.
  const std::vector<Piece> &idle(uint64_t nowUs);

  // Takes a character without error at place `at` and time `nowUs`. Returns the pieces found.
  const std::vector<Piece> &put(uint8_t byte, uint64_t at, uint64_t nowUs, bool isBursty);

  bool has24() const { return _is24; }
  sbus::Counters counters() const;
  // Returns the counters of the decoder for 16 channels.
  sbus::Counters counters16() const { return _finder16.events().withoutErrors(_finder16.counters()); }

  // Returns the places of the right decoder.
  const Places &places() const {
    return has24() ? static_cast<const Places &>(_finder24.events()) : _finder16.events();
  }
  // Takes the end of the line. Returns the remaining pieces.
  const std::vector<Piece> &finish();

  // Returns the place of the first byte that may still belong to a frame, or `end`: of either decoder until the right
  // one is known.
  uint64_t openAt(uint64_t end) const;

 private:
  template <typename Format>
  using Finder = sbus::FrameFinderOf<Format, PlacesOf<Format>>;

  template <typename Call>
  const std::vector<Piece> &forBoth(Call call);
  sbus::Counters ownCounters() const;
  bool leads24() const;
  const std::vector<Piece> &decide(bool isOver);

  Finder<sbus::Frame16Extra> _finder16;
  Finder<sbus::Frame24> _finder24;
  uint64_t _nowUs;         // the decoders' newest time
  uint64_t _byteUs;        // of the last byte
  bool _isDecided;         // the right decoder is known
  bool _is24;              // the one for 24 channels
  int _lead24;             // by how many of the newest frames that one leads; below 0: the other one
  sbus::Counters _before;  // to be added to the right decoder's: the line was another one
  std::vector<Piece> _none;
};

}  // namespace line
