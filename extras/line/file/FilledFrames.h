// Finds frames between other bytes, where no times tell them apart: line ends, zeros, a count. Frames with the same
// number of bytes from one to the next are evidence.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "line/Line.h"
#include "line/file/ByteText.h"

namespace line {

class FilledFrames {
 public:
  // Finds nothing: frames follow each other directly.
  FilledFrames() = default;

  // Finds out from a file's first bytes what stands between its frames.
  explicit FilledFrames(const TextBytes &head);

  // Returns true if something does.
  bool any() const { return _most > 0; }

  // Takes the next bytes, and appends their characters: back to back, after `last`, with a silence before and after
  // each frame that is found. Some wait for the next bytes.
  void put(const TextBytes &bytes, uint32_t characterUs, Character &last, std::deque<Character> &characters);

  // Takes the end.
  void finish(uint32_t characterUs, Character &last, std::deque<Character> &characters);

 private:
  static constexpr size_t MostBetween = 28;

  bool isBetween(size_t count) const { return count <= _most && _counts[count]; }
  size_t frameAt(size_t at, bool isEnd) const;
  void cut(bool isEnd, uint32_t characterUs, Character &last, std::deque<Character> &characters);

  size_t _most = 0;           // bytes between two frames
  std::vector<bool> _counts;  // whether so many often stand there
  TextBytes _waiting;
  int64_t _since = MostBetween + 1;  // bytes from the end of the newest frame to these
  size_t _left = 0;                  // bytes of that frame, or its tail, among these
  bool _isAfterFrame = false;        // the byte before these was its last
};

}  // namespace line
