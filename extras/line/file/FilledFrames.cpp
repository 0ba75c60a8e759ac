#include "line/file/FilledFrames.h"

#include <algorithm>

#include "sbus/Frame.h"

namespace line {

namespace {

// Returns the place of the next header, or SIZE_MAX if there is none among the next `most` bytes.
size_t headerFrom(const TextBytes &bytes, size_t at, size_t most) {
  const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), at + most + 1));
  const auto header = std::find_if(bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), at)), end,
                                   [](TextByte byte) { return byte.value == sbus::HeaderByte; });
  return header == end ? SIZE_MAX : static_cast<size_t>(header - bytes.begin());
}

}  // namespace

FilledFrames::FilledFrames(const TextBytes &head) {
  constexpr size_t Part = 10;  // of the frames have as many bytes before the next one
  size_t found[MostBetween + 1] = {}, all = 0, most = 0;
  for (size_t at = 0; at < head.size(); at++) {
    const size_t next = isFrameAt(head, at) ? headerFrom(head, at + sbus::FrameSize, MostBetween) : SIZE_MAX;
    if (next != SIZE_MAX && isFrameAt(head, next)) {
      found[next - at - sbus::FrameSize]++;
      all++;
    }
  }
  for (size_t i = 0; i <= MostBetween; i++) {
    _counts.push_back(found[i] > 0 && Part * found[i] >= all);
    most = _counts[i] ? i : most;
  }
  // A single frame, and a few bytes after it. One that ends in 08 may lack its tail: then nothing stands between two.
  _most = all == 0 && isFrameAt(head, 0) ? MostBetween : all > 0 ? std::max<size_t>(1, most) : 0;
}

void FilledFrames::put(const TextBytes &bytes, uint32_t characterUs, Character &last,
                       std::deque<Character> &characters) {
  _waiting.insert(_waiting.end(), bytes.begin(), bytes.end());
  cut(false, characterUs, last, characters);
}

void FilledFrames::finish(uint32_t characterUs, Character &last, std::deque<Character> &characters) {
  cut(true, characterUs, last, characters);
}

// Returns the size of the frame at this place, with the tail of its variant; 0 if none is proved by another one.
size_t FilledFrames::frameAt(size_t at, bool isEnd) const {
  if (!any() || !isFrameAt(_waiting, at)) {
    return 0;
  }
  const size_t end = at + sbus::FrameSize, next = headerFrom(_waiting, end, MostBetween);
  const size_t between = std::min(next, _waiting.size()) - end;
  const bool isProved = next == SIZE_MAX ? isEnd : isFrameAt(_waiting, next) && isBetween(between);
  const size_t tail = sbus::LineVariants[sbus::variantOfEnd(_waiting[end - 1].value)].tailSize;
  return isProved || (_since >= 0 && isBetween(static_cast<size_t>(_since)))
             ? sbus::FrameSize + (between < tail ? 0 : tail)
             : 0;
}

void FilledFrames::cut(bool isEnd, uint32_t characterUs, Character &last, std::deque<Character> &characters) {
  constexpr uint64_t SilenceUs = 3000;
  const size_t ahead = any() && !isEnd ? 2 * sbus::FrameSize + MostBetween : 0;
  size_t at = 0;
  for (; at + ahead < _waiting.size(); at++) {
    const bool isFrame = _left == 0 && (_left = frameAt(at, isEnd)) > 0;
    _since = isFrame ? -static_cast<int64_t>(sbus::FrameSize) : _since;
    last.endUs += characterUs + (isFrame || (_left == 0 && _isAfterFrame) ? SilenceUs : 0);
    last.value = _waiting[at].value;
    last.bad = _waiting[at].bad;
    characters.push_back(last);
    _isAfterFrame = _left == 1;
    _left -= _left > 0;
    _since++;
  }
  _waiting.erase(_waiting.begin(), _waiting.begin() + static_cast<std::ptrdiff_t>(at));
}

}  // namespace line
