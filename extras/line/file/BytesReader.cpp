#include "line/file/BytesReader.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>
#include <utility>

#include "line/Observer.h"
#include "line/recording/Words.h"

namespace line {

namespace {

// Returns true if most channels of a frame hardly differ from those of the one before, like those of sticks; if hardly
// any is at an end that no radio reaches, unless it is cut off there or not given; and if its bytes use all eight bits,
// as channels of 11 bits do: small numbers and repeated tables have none of that.
bool areSticks(const Stretch &frame, const Values &values, const Values &before) {
  constexpr int Move = 100, End = 64;
  constexpr size_t Alike = 12, Odd = 2;  // of 16
  size_t alike = 0, odd = 0;
  unsigned bits = 0;
  for (size_t i = 0; i < sbus::ProportionalCount; i++) {
    const int raw = values.raw[i];
    alike += std::abs(raw - before.raw[i]) <= Move;
    odd += (raw > 0 && raw < End) || (raw > sbus::ChannelMax - End && raw < sbus::ChannelMax);
  }
  for (size_t i = 1; i < sbus::FlagsIndex; i++) {
    bits |= frame.characters[i].value;
  }
  return values.count == before.count && alike >= Alike && odd <= Odd && (bits == 0xFF || bits == 0);
}

}  // namespace

// A line has hardly anything but frames; a bad one has a quarter of its bytes in them, and these repeat.
bool BytesReader::Found::areLine() const {
  const bool areRepeated = (frames == 1 ? 2 : 4) * taken >= bytes && 2 * alike > frames;
  return frames > 0 && (20 * taken >= 19 * bytes || areRepeated);
}

BytesReader::BytesReader(std::string_view head, bool isText, const LineSettings &settings)
    : _isText(isText),
      _characterUs(settings.characterUs()),
      _text(isText ? head : std::string_view(), head.size() < FileHeadMax),
      _isLong(head.size() >= FileHeadMax) {
  examine(head);
  if (_text.hasWords()) {  // with each word's bytes in the other order, more of them may be in frames
    const auto asPrinted = std::pair(_found, _filled);
    _text.swapWords();
    examine(head);
    if (_found.taken <= asPrinted.first.taken) {
      _text.swapWords();
      std::tie(_found, _filled) = asPrinted;
    }
  }
  if (!_found.areLine() && isText) {  // then each line must be bytes
    _text.setStrict();
    examine(head);
  }
}

void BytesReader::examine(std::string_view head) {
  TextBytes bytes;
  for (std::string_view rest = head; !rest.empty();) {
    bytesOf(_isText ? takeLine(rest) : std::exchange(rest, std::string_view()), bytes);
  }
  _filled = FilledFrames(bytes);
  _found = framesOf(bytes, FilledFrames());
  const Found spaced = _filled.any() ? framesOf(bytes, _filled) : Found();
  const bool isSpaced =
      std::tie(spaced.frames, spaced.alike) > std::tie(_found.frames, _found.alike) && spaced.areLine();
  _filled = isSpaced ? _filled : FilledFrames();
  _found = isSpaced ? spaced : _found;
}

BytesReader::Found BytesReader::framesOf(const TextBytes &bytes, FilledFrames filled) const {
  Found found;
  Values before;
  Observer observer;
  observer.reset(0, _characterUs);
  observer.listen([&](const Stretch &stretch) {
    found.taken += stretch.isFrame() || !stretch.slots.empty() ? stretch.characters.size() : 0;
    found.frames += stretch.isFrame();
    if (stretch.isFrame() && stretch.kind != Stretch::Kind::Extra) {
      found.alike += areSticks(stretch, observer.newest(), found.alike == 0 ? observer.newest() : before);
      before = observer.newest();
    }
  });
  std::deque<Character> characters;
  Character last;
  filled.put(bytes, _characterUs, last, characters);
  filled.finish(_characterUs, last, characters);
  for (const Character &character : characters) {
    observer.put(character);
  }
  observer.idleUntil(last.endUs + (_isLong ? 0 : TailUs));  // a file's last frame ends in silence
  observer.finish();
  found.bytes = bytes.size();
  found.baud = observer.readAtBaud();
  return found;
}

std::string BytesReader::why() const {
  const char *const expected = "bytes of a line are expected, mostly frames, or a recording or a capture";
  return std::string("is no line of S.Bus: ") +
         (_found.frames == 0
              ? "its first " + std::to_string(_found.bytes) + " bytes have no frame"
              : "only " + std::to_string(_found.taken) + " of its first " + std::to_string(_found.bytes) +
                    (_isText ? " numbers" : " bytes") + " look like frames, which happens by chance") +
         "; " + expected;
}

std::string BytesReader::note() const {
  return std::string(_text.isDecimal() ? "bytes in decimal, " : "bytes ") +
         "without times: times are not known, frames are assumed to be " +
         (_filled.any() ? "between other bytes" : "back to back");
}

std::string BytesReader::bytesOf(std::string_view text, TextBytes &bytes) const {
  if (_isText) {
    return _text.line(text, bytes);
  }
  for (const char c : text) {
    bytes.push_back({static_cast<uint8_t>(c), false});
  }
  return {};
}

std::string BytesReader::line(std::string_view text, std::deque<Character> &characters) {
  TextBytes bytes;
  const std::string wrong = bytesOf(text, bytes);
  _filled.put(bytes, _characterUs, _last, characters);
  return wrong;
}

std::string BytesReader::finish(std::deque<Character> &characters) {
  _filled.finish(_characterUs, _last, characters);
  return _last.endUs > 0 ? "" : "is empty: bytes of a line are expected";
}

}  // namespace line
