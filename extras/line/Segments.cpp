#include "line/Segments.h"

#include <algorithm>
#include <iterator>

namespace line {

namespace {

constexpr size_t RowMax = sbus::FrameSize;  // characters in a stretch that is not a frame
constexpr uint32_t GapCharacters = 8;       // a gap as long as this ends it
constexpr uint64_t Forever = UINT64_MAX;

// Indexed by sbus::Rejection.
constexpr const char *Reasons[] = {"no end byte",  "unused flags set",   "a gap inside", "more bytes than a frame",
                                   "not at a gap", "may be a false sync"};
static_assert(std::size(Reasons) == static_cast<size_t>(sbus::Rejection::FalseSync) + 1, "a text for each reason");

struct Error {
  bool parity, stop;
  const char *text;
};
constexpr Error Errors[] = {{true, false, "parity error"},
                            {false, true, "framing error"},
                            {true, true, "parity and framing error"},
                            {false, false, "parity or framing error"}};

// Returns "telemetry slots 1, 2".
std::string numbersOf(const std::vector<TimedSlot> &slots) {
  std::string text = slots.size() == 1 ? "telemetry slot" : "telemetry slots";
  for (size_t i = 0; i < slots.size(); i++) {
    text += (i == 0 ? " " : ", ") + std::to_string(slots[i].number);
  }
  return text;
}

// Returns "parity error (byte 12)", "2 framing errors (bytes 0, 3)" or "7 parity errors"; "" if no character has it.
std::string places(const std::vector<Character> &characters, const Error &error) {
  constexpr size_t Named = 3;
  size_t count = 0;
  std::string bytes;
  for (size_t i = 0; i < characters.size(); i++) {
    const Character &each = characters[i];
    if (each.bad && each.parityWrong == error.parity && each.stopWrong == error.stop) {
      bytes += (count++ == 0 ? "" : ", ") + std::to_string(i);
    }
  }
  if (count == 0) {
    return "";
  }
  const std::string text = count == 1 ? error.text : std::to_string(count) + " " + error.text + "s";
  return count > Named || characters.size() == 1 ? text : text + (count == 1 ? " (byte " : " (bytes ") + bytes + ")";
}

}  // namespace

// If characters have errors, only these are named: no decoder gets them, so the reasons for rejecting the following
// bytes would be wrong. In a stretch as long as a frame, the gap after it cuts off what begins inside.
std::string why(const Stretch &stretch) {
  if (stretch.isFrame()) {
    return {};
  }
  const auto &characters = stretch.characters;
  if (!stretch.slots.empty()) {
    return numbersOf(stretch.slots);
  }
  std::string text;
  for (const Error &error : Errors) {
    const std::string found = places(characters, error);
    text += (text.empty() || found.empty() ? "" : ", ") + found;
  }
  if (!text.empty()) {
    return text;
  }
  const bool isWhole = characters.size() == sbus::FrameSize;
  const bool begins = (characters.front().value & sbus::HeaderMask) == sbus::HeaderByte;
  bool told[std::size(Reasons)] = {};
  for (const Rejected &rejected : stretch.rejected) {
    const auto reason = static_cast<size_t>(rejected.why);
    const bool isCut = isWhole && rejected.at > 0 && rejected.why == sbus::Rejection::GapInside;
    if (!isCut && !std::exchange(told[reason], true)) {
      text += (text.empty() ? "" : ", ") + std::string(Reasons[reason]) +
              (rejected.at == 0 ? "" : " (byte " + std::to_string(rejected.at) + ")");
    }
  }
  const auto isHeader = [](const Character &c) { return c.value == sbus::HeaderByte; };
  const bool hasHeader = std::any_of(characters.begin(), characters.end(), isHeader);
  return !text.empty() ? text : hasHeader && (begins || !isWhole) ? "incomplete" : "no header";
}

void Segments::reset(uint32_t characterUs) {
  _kept.clear();
  _at = 0;
  _characterUs = characterUs;
}

void Segments::cut(const std::vector<Piece> &pieces) {
  for (const Piece &piece : pieces) {
    if (piece.begin >= _at) {  // otherwise the other decoder has claimed part of it
      cutRows(piece.begin, Forever);
      emit(piece.kind, static_cast<size_t>(piece.end - piece.begin));
    }
  }
}

void Segments::cutBefore(uint64_t end, uint64_t nowUs) {
  cutRows(std::max(end, this->end() - std::min(this->end(), KeptMax)), nowUs);
}

void Segments::finish() { cutRows(end(), Forever); }

void Segments::cutRows(uint64_t end, uint64_t nowUs) {
  while (_at < end) {
    const auto most = static_cast<size_t>(std::min<uint64_t>(end - _at, RowMax));
    size_t count = 0;
    bool isGapNext = false;
    while (count < most && !isGapNext) {
      count++;
      const uint64_t gapEndUs = _kept[count - 1].endUs + uint64_t{GapCharacters} * _characterUs;
      isGapNext = count < _kept.size() ? _kept[count].endUs >= gapEndUs + _characterUs + _kept[count].lateUs
                                       : nowUs >= gapEndUs;
    }
    if (count < RowMax && !isGapNext && nowUs != Forever) {
      return;
    }
    emit(Stretch::Kind::NoFrame, count);
  }
}

void Segments::emit(Stretch::Kind kind, size_t count) {
  const auto end = _kept.begin() + static_cast<std::ptrdiff_t>(count);
  Stretch stretch{kind, _at, {_kept.begin(), end}, {}, {}};
  _kept.erase(_kept.begin(), end);
  _at += count;
  _onStretch(stretch);
}

}  // namespace line
