#include "Observer.h"

#include <algorithm>
#include <iterator>

namespace line {

namespace {

constexpr size_t RowMax = sbus::FrameSize;  // characters of a stretch that is no frame
constexpr uint32_t PauseCharacters = 8;     // so long a pause ends one
constexpr size_t KeptMax = 256;             // characters; two decoders wait for less than 100 good ones
constexpr uint64_t SecondUs = 1000000;
constexpr uint64_t LateUs = 20000;  // USB keeps bytes back for up to 16 ms, and a browser for some more

void addWord(std::string &words, const std::string &word) {
  words += words.empty() ? word : ", " + word;
}

// Takes what was refused before good byte `end` off the list.
template <typename Refusals>
void takeRefusals(Refusals &refusals, uint64_t end, Stretch *stretch) {
  while (!refusals.empty() && refusals.front().at < end) {
    if (stretch != nullptr) {
      stretch->refusedByEnd += refusals.front().byEnd;
      stretch->refusedByFlags += refusals.front().byFlags;
      stretch->refusedByExtra += refusals.front().byExtra;
    }
    refusals.pop_front();
  }
}

template <typename Side>
void resetSide(Side &side, uint64_t nowUs, uint8_t characterUs) {
  side.finder.reset(static_cast<uint32_t>(nowUs), characterUs);
  side.passed = 0;
  side.refusals.clear();
}

}  // namespace

std::string why(const Stretch &stretch) {
  std::string words;
  if (stretch.isFrame()) {
    return words;
  }
  const auto &characters = stretch.characters;
  const auto bad = std::count_if(characters.begin(), characters.end(), [](const Character &c) { return c.bad; });
  const bool header = std::any_of(characters.begin(), characters.end(),
                                  [](const Character &c) { return !c.bad && c.value == sbus::HeaderByte; });
  if (bad > 0) {
    addWord(words, std::to_string(bad) + (bad == 1 ? " bad character" : " bad characters"));
  }
  if (stretch.refusedByEnd > 0) {
    addWord(words, "no end byte");
  }
  if (stretch.refusedByFlags > 0) {
    addWord(words, "unused flags set");
  }
  if (stretch.refusedByExtra > 0) {
    addWord(words, "more bytes than a frame, or a pause in it");
  }
  if (words.empty()) {
    words = header ? "incomplete" : "no header";
  }
  return words;
}

void Extent::add(uint64_t value) {
  low = count == 0 ? value : std::min(low, value);
  high = count == 0 ? value : std::max(high, value);
  sum += value;
  count++;
}

void Observer::reset(uint64_t nowUs, uint32_t characterUs) {
  _characterUs = characterUs;
  _waiting = 0;
  resetFinders(nowUs, sbus::CharacterTime);
  _link.reset();
  _kept.clear();
  _cut = 0;
  _lastEndUs = 0;
  _lastBurstUs = 0;
  _characters = 0;
  _badCharacters = 0;
  _newest = Values();
  _frameEndsUs.clear();
  resetMarks();
}

void Observer::resetMarks() {
  _gaps = Extent();
  _travel.fill(Extent());
}

void Observer::put(const Character &character) {
  const uint64_t startUs = character.endUs - _characterUs;
  if (_characters == 0) {
    const uint32_t us = std::min<uint32_t>(_characterUs, UINT8_MAX);  // on a slower line there is no S.Bus
    resetFinders(startUs, us);
  } else {
    idleUntil(startUs);
  }
  _characters++;
  _badCharacters += character.bad;
  _lastEndUs = character.endUs;
  _kept.push_back(character);
  if (!character.bad) {
    _burst[_waiting++] = character.value;
  }
  if (character.bad || _waiting == _burst.size()) {
    handOver(character.endUs);
  }
}

void Observer::putBurst(const uint8_t *bytes, size_t count, uint64_t nowUs) {
  const uint64_t takenUs = uint64_t{count} * _characterUs;
  if (_characters == 0) {
    _burstClockUs = nowUs;
    resetFinders(nowUs, std::min<uint32_t>(_characterUs, UINT8_MAX));
  } else {
    handOver(_lastEndUs + _characterUs);
  }
  const uint64_t quietUs = nowUs - std::min(nowUs, std::max(_lastBurstUs, _lastEndUs));
  _burstClockUs += quietUs > takenUs + LateUs ? quietUs : takenUs;
  _lastBurstUs = nowUs;
  for (size_t i = 0; i < count; i++) {
    const uint64_t afterUs = (count - 1 - i) * _characterUs;
    Character character;
    character.endUs = std::max(_lastEndUs + (_characters > 0 ? _characterUs : 0), nowUs - std::min(nowUs, afterUs));
    character.value = bytes[i];
    _kept.push_back(character);
    _characters++;
    _lastEndUs = character.endUs;
  }
  feed(_side16, bytes, count, _burstClockUs);
  feed(_side24, bytes, count, _burstClockUs);
}

void Observer::idleUntil(uint64_t nowUs) {
  if (nowUs >= _lastEndUs + _characterUs) {
    handOver(_lastEndUs + _characterUs);
  }
  if (!_kept.empty()) {
    cutNoFrames(keptBefore(passed()), nowUs, false);
  }
}

void Observer::finish() {
  handOver(_lastEndUs + _characterUs);
  cutNoFrames(_kept.size(), _lastEndUs, true);
}

void Observer::handOver(uint64_t nowUs) {
  if (_waiting > 0) {
    feed(_side16, _burst.data(), _waiting, nowUs);
    feed(_side24, _burst.data(), _waiting, nowUs);
    _waiting = 0;
  }
  if (_kept.size() > KeptMax) {
    cutNoFrames(_kept.size(), nowUs, true);  // bad characters only, or nearly so
  }
}

template <typename Format>
void Observer::feed(Side<Format> &side, const uint8_t *bytes, size_t count, uint64_t nowUs) {
  sbus::FrameFinderOf<Format> &finder = side.finder;
  finder.poll(static_cast<unsigned>(count), static_cast<uint32_t>(nowUs));
  while (count > 0) {
    const size_t taken = std::min(count, static_cast<size_t>(finder.room()));
    std::copy_n(bytes, taken, finder.space());
    bytes += taken;
    count -= taken;
    const sbus::Counters before = finder.counters();
    const uint8_t *const frame = finder.received(static_cast<int>(taken));
    found(side, before, frame);
  }
}

// A decoder does not say where in the line its frame stood, but counts the bytes that it has passed.
template <typename Format>
void Observer::found(Side<Format> &side, const sbus::Counters &before, const uint8_t *frame) {
  const sbus::Counters &after = side.finder.counters();
  const uint64_t begin = side.passed;
  const bool extra = after.extraFrames != before.extraFrames;
  side.passed += after.skippedBytes - before.skippedBytes + (extra ? sbus::FrameSize : 0u) +
                 (frame != nullptr ? Format::Size : 0u);
  const Refusal refusal = {begin, after.refusedByEnd - before.refusedByEnd,
                           after.refusedByFlags - before.refusedByFlags, after.refusedByExtra - before.refusedByExtra};
  if (refusal.byEnd + refusal.byFlags + refusal.byExtra > 0) {
    side.refusals.push_back(refusal);
  }
  if (has24() != (Format::Size == sbus::FrameSize24)) {
    return;
  }
  if (extra && isWhole(begin, begin + sbus::FrameSize)) {
    sbus::unpackExtra(side.finder.extra(), &_newest.raw[sbus::ProportionalCount]);
    _newest.count = static_cast<unsigned>(_newest.raw.size());
    for (size_t i = sbus::ProportionalCount; i < _newest.raw.size() && !_newest.lostFrame && !_newest.failsafe; i++) {
      _travel[i].add(_newest.raw[i]);
    }
    cut(begin, begin + sbus::FrameSize, Stretch::Kind::Extra);
  }
  const uint64_t first = side.passed - Format::Size;
  if (frame != nullptr && !isWhole(first, side.passed)) {
    cut(first, side.passed, Stretch::Kind::NoFrame);
  } else if (frame != nullptr) {
    const size_t through = keptThrough(side.passed);
    take<Format>(frame, through > 0 ? _kept[through - 1].endUs : _lastEndUs);
    cut(first, side.passed, Format::Size == sbus::FrameSize24 ? Stretch::Kind::Frame24 : Stretch::Kind::Frame);
  }
}

template <typename Format>
void Observer::take(const uint8_t *frame, uint64_t endUs) {
  const uint8_t flags = frame[Format::Size - 2];
  uint16_t channels[Format::Channels];
  Format::unpack(frame, channels);
  constexpr bool Is24 = Format::Size == sbus::FrameSize24;
  constexpr size_t Count = Is24 ? sbus::ChannelCount24 : sbus::ProportionalCount;
  std::copy_n(channels, Count, _newest.raw.begin());
  _newest.count = std::max(static_cast<unsigned>(Count), Is24 ? 0 : _newest.count);
  _newest.switches = {!Is24 && (flags & sbus::FlagChannel17) != 0, !Is24 && (flags & sbus::FlagChannel18) != 0};
  _newest.lostFrame = (flags & sbus::FlagLostFrame) != 0;
  _newest.failsafe = (flags & sbus::FlagFailsafe) != 0;
  if (!_frameEndsUs.empty()) {
    _gaps.add(endUs - _newest.endUs);
  }
  _newest.endUs = endUs;
  for (size_t i = 0; i < Count && !_newest.lostFrame && !_newest.failsafe; i++) {
    _travel[i].add(channels[i]);
  }
  _frameEndsUs.push_back(endUs);
  while (_frameEndsUs.front() + SecondUs <= endUs) {
    _frameEndsUs.pop_front();
  }
  _link.frame(flags);
}

sbus::LinkState Observer::state(uint64_t nowUs) {
  return _link.state(static_cast<uint32_t>(_newest.endUs), static_cast<uint32_t>(std::max(nowUs, _newest.endUs)));
}

unsigned Observer::framesPerSecond(uint64_t nowUs) const {
  const auto count = std::count_if(_frameEndsUs.begin(), _frameEndsUs.end(),
                                   [nowUs](uint64_t endUs) { return endUs + SecondUs > nowUs && endUs <= nowUs; });
  return static_cast<unsigned>(count);
}

// So many good bytes nobody waits for any more. Before the first frame either decoder may be right.
uint64_t Observer::passed() const {
  return counters().frames == 0 ? std::min(_side16.passed, _side24.passed) : has24() ? _side24.passed : _side16.passed;
}

// So many of the characters kept reach through good byte `good` - 1, counted from the line's beginning.
size_t Observer::keptThrough(uint64_t good) const {
  size_t count = 0;
  uint64_t goods = _cut;
  while (goods < good && count < _kept.size()) {
    goods += !_kept[count++].bad;
  }
  return count;
}

// The same, and the bad ones after it.
size_t Observer::keptBefore(uint64_t good) const {
  size_t count = keptThrough(good);
  while (count < _kept.size() && _kept[count].bad) {
    count++;
  }
  return count;
}

// No bad character is among good bytes `begin` to `end` - 1. A decoder does not hear of bad ones: to it a frame that
// has one, and then a byte too many, looks whole.
bool Observer::isWhole(uint64_t begin, uint64_t end) const {
  const auto at = [this](size_t index) { return _kept.begin() + static_cast<std::ptrdiff_t>(index); };
  return std::none_of(at(keptBefore(begin)), at(std::max(keptBefore(begin), keptThrough(end))),
                      [](const Character &character) { return character.bad; });
}

// Good bytes `begin` to `end` - 1 are a stretch: what is before them is no frame.
void Observer::cut(uint64_t begin, uint64_t end, Stretch::Kind kind) {
  if (begin < _cut) {
    return;  // the other decoder has had some of them
  }
  cutNoFrames(keptBefore(begin), _lastEndUs, true);
  say(kind, keptThrough(end));
}

// The first `count` characters kept are no frame. Unless they must all go, the last ones wait for more, or for a pause.
void Observer::cutNoFrames(size_t count, uint64_t nowUs, bool all) {
  const uint64_t pauseUs = uint64_t{PauseCharacters} * _characterUs;
  while (count > 0) {
    size_t row = 1;
    const auto pauseAfter = [&] {
      const uint64_t nextUs = row < _kept.size() ? _kept[row].endUs - _characterUs : nowUs;
      return nextUs >= _kept[row - 1].endUs + pauseUs;
    };
    while (row < count && row < RowMax && !pauseAfter()) {
      row++;
    }
    if (!all && row < RowMax && !pauseAfter()) {
      return;
    }
    say(Stretch::Kind::NoFrame, row);
    count -= row;
  }
}

// The first `count` characters kept are a stretch.
void Observer::say(Stretch::Kind kind, size_t count) {
  Stretch stretch;
  stretch.kind = kind;
  const auto end = _kept.begin() + static_cast<std::ptrdiff_t>(count);
  _cut += static_cast<uint64_t>(std::count_if(_kept.begin(), end, [](const Character &c) { return !c.bad; }));
  const bool told = kind == Stretch::Kind::NoFrame;
  takeRefusals(_side16.refusals, _cut, told && !has24() ? &stretch : nullptr);
  takeRefusals(_side24.refusals, _cut, told && has24() ? &stretch : nullptr);
  if (_listener) {
    stretch.characters.assign(_kept.begin(), end);
  }
  _kept.erase(_kept.begin(), end);
  if (_listener) {
    _listener(stretch);
  }
}

void Observer::resetFinders(uint64_t nowUs, uint32_t characterUs) {
  resetSide(_side16, nowUs, static_cast<uint8_t>(characterUs));
  resetSide(_side24, nowUs, static_cast<uint8_t>(characterUs));
}

}  // namespace line
