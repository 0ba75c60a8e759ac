#include "line/compare/Aligner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "line/Format.h"

namespace line {

namespace {

constexpr int64_t Ended = INT64_MAX / 2;  // up to when a side is known that has ended
constexpr int64_t WindowUs = 50000;       // how far the delay may jump: a period of the slowest receiver, a late port
constexpr int64_t TryEachUs = 2000000;
constexpr int64_t TryMostUs = 600000000;
constexpr int64_t MinuteUs = 60000000;
constexpr int64_t RecentUs = 4000000;
constexpr int64_t MovedUs = 1000000;  // by which a port may be late without saying so

}  // namespace

bool Aligner::isSame(const Values &a, const Values &b) const {
  const std::ptrdiff_t channels = std::min(_channels, commonChannels(a, b));
  return std::equal(a.raw.begin(), a.raw.begin() + channels, b.raw.begin()) &&
         (!_hasSwitches || a.switches == b.switches);
}

uint64_t Aligner::hashOf(const Values &values) const {
  uint64_t hash = 1469598103934665603U;  // FNV-1a
  const auto add = [&hash](unsigned value) { hash = (hash ^ value) * 1099511628211U; };
  std::for_each(values.raw.begin(), values.raw.begin() + _channels, add);
  if (_hasSwitches) {
    std::for_each(values.switches.begin(), values.switches.end(), add);
  }
  return hash;
}

// Notes a change for the search. Returns true for one, and for the first frame.
bool Aligner::isChange(size_t side, int64_t us, const Values &values) {
  const bool isFirst = !_newest[side];
  const bool is = isFirst || !isSame(*_newest[side], values);
  if (is && !isFirst) {
    _changes.put(side, us, hashOf(values));
  }
  _newest[side] = values;
  return is;
}

void Aligner::noteRate(Side &side, int64_t us, int64_t lateUs) {
  const auto late = static_cast<uint32_t>(lateUs);
  const bool isJoined = side.newestUs != NeverUs &&
                        gapOf(static_cast<uint64_t>(side.newestUs), static_cast<uint64_t>(us), late) == Gap::Ordinary;
  side.rate.put(static_cast<uint64_t>(us), late, isJoined);
  side.newestUs = us;
}

// Finds out which channels both sides have. If they are others than before, the frames that wait are seen again.
void Aligner::setCommon() {
  const Values &a = *(_newest[0] ? _newest[0] : _newest[1]), &b = *(_newest[1] ? _newest[1] : _newest[0]);
  if (_channels == commonChannels(a, b) && _hasSwitches == haveSwitches(a, b)) {
    return;
  }
  _channels = commonChannels(a, b);
  _hasSwitches = haveSwitches(a, b);
  _changes.clear();
  for (const size_t side : {size_t{0}, size_t{1}}) {
    const std::optional<Values> newest = std::exchange(_newest[side], std::nullopt);
    for (Frame &frame : _sides[side].frames) {
      frame.isChange = isChange(side, frame.us, frame.values);
    }
    _newest[side] = newest;
  }
}

// Returns the length of the run of frames with the channels of `first`, which continues at `next`; 0 if its end is not
// known yet.
size_t Aligner::runOf(const Frame &first, const std::deque<Frame> &frames, size_t next) const {
  size_t run = 1;
  while (next < frames.size() && isSame(frames[next].values, first.values)) {
    next++;
    run++;
  }
  return next < frames.size() ? run : 0;
}

void Aligner::put(size_t side, int64_t us, const Values &values, int64_t lateUs) {
  auto &late = _sides[side].late;
  if (lateUs > WindowUs && !late.empty() && us - lateUs <= late.back().second) {
    late.back().second = us;
  } else if (lateUs > WindowUs) {
    late.emplace_back(us - lateUs, us);
  }
  while (!late.empty() && late.front().second < us - 2 * TryMostUs) {
    late.pop_front();
  }
  noteRate(_sides[side], us, lateUs);
  _changes.forgetBefore(side, us - MinuteUs);
  _sides[side].frames.push_back({us, isChange(side, us, values), values, lateUs});
  auto &changes = _sides[side].changes;
  if (_sides[side].frames.back().isChange) {
    changes.push_back(_sides[side].frames.back());
  }
  while (!changes.empty() && changes.front().us < us - RecentUs) {
    changes.pop_front();
  }
  setCommon();
  knownUntil(side, us);
}

void Aligner::knownUntil(size_t side, int64_t us) {
  _sides[side].knownUs = std::max(_sides[side].knownUs, us);
  work(false);
}

void Aligner::finish() {
  work(true);
  checkDelay();
  giveUpSecond(INT64_MAX);
  pairUnmatched(INT64_MAX);
  emitBefore(INT64_MAX);
}

// The delay was found early: what came since then may repeat itself, or tell another one.
void Aligner::checkDelay() {
  if (_by == DelayBy::Times) {
    return;
  }
  const DelaySearch::Result result = _changes.search({Ended, Ended});
  if (!result.best.isLikely()) {
    return;
  }
  const bool isConfirmed = std::abs(static_cast<double>(result.best.delayUs) - _delayUs) < WindowUs;
  _searched = isConfirmed ? result : DelaySearch::Result{_searched.best, result.best};
}

std::string Aligner::evidence() const {
  if (_by == DelayBy::Times) {
    return "the times alone: not certain";
  }
  return format("the contents: %zu of %zu agree", _searched.best.agreeing, _searched.best.of) +
         (isCertain()
              ? ""
              : format(", with another delay %zu of %zu: not certain", _searched.second.agreeing, _searched.second.of));
}

void Aligner::work(bool isEnd) {
  giveUpOld(0);
  giveUpOld(1);
  if (!_hasDelay && !findDelay(isEnd)) {
    return;
  }
  std::deque<Frame> &frames = _sides[0].frames;
  while (!frames.empty()) {
    const int64_t expectedUs = frames.front().us + std::llround(_delayUs);
    if (!isEnd && _sides[1].knownUs < expectedUs + WindowUs) {
      return;
    }
    const Frame frame = frames.front();
    frames.pop_front();
    match(frame);
    giveUpSecond(expectedUs - WindowUs);
    pairUnmatched(frame.us - MovedUs - 2 * WindowUs);
    emitBefore(frame.us - MovedUs - 3 * WindowUs);
  }
  // Without frames from the first source, those of the second remain unmatched once their time has passed.
  if (!isEnd && frames.empty()) {
    const int64_t us = std::min<int64_t>(_sides[0].knownUs, _sides[1].knownUs - std::llround(_delayUs));
    giveUpSecond(us + std::llround(_delayUs) - 2 * WindowUs);
    pairUnmatched(us - MovedUs - 3 * WindowUs);
    emitBefore(us - MovedUs - 4 * WindowUs);
  }
}

// Returns true once the delay is found or given up.
bool Aligner::findDelay(bool isEnd) {
  const int64_t knownUs = std::min(_sides[0].knownUs, _sides[1].knownUs);
  if (knownUs == NeverUs && !isEnd) {
    return false;
  }
  if (_tryUs == NeverUs) {
    _tryUs = knownUs == NeverUs ? 0 : knownUs + TryEachUs;
  }
  if (!isEnd && knownUs < _tryUs) {
    return false;
  }
  _tryUs = knownUs + TryEachUs;
  const auto waitsFor = [this, knownUs](int64_t us) {
    return std::all_of(_sides.begin(), _sides.end(),
                       [=](const Side &side) { return !side.frames.empty() && side.frames.front().us < knownUs - us; });
  };
  const bool isLast = isEnd || waitsFor(TryMostUs);
  const DelaySearch::Result result = _changes.search({_sides[0].knownUs, _sides[1].knownUs});
  if (isLast || waitsFor(MinuteUs) ? result.best.isLikely() : result.isFinal()) {
    _by = DelayBy::Contents;
    _searched = result;
    _delayUs = static_cast<double>(result.best.delayUs);
  }
  _hasDelay = isLast || _by == DelayBy::Contents;
  const double most = std::max(perSecond(0), perSecond(1));
  _periodUs = most > 0 ? std::clamp<int64_t>(std::llround(1e6 / most), 4000, 30000) : _periodUs;
  return _hasDelay;
}

// Returns true if both sides have had these channels only once within the last seconds: a resting stick may alternate
// between two values, and frames with these values are at many places.
bool Aligner::isOnly(const Frame &frame) const {
  return std::all_of(_sides.begin(), _sides.end(), [this, &frame](const Side &side) {
    return std::count_if(side.changes.begin(), side.changes.end(),
                         [this, &frame](const Frame &each) { return isSame(each.values, frame.values); }) == 1;
  });
}

// If a run begins here, takes the second side's frame that begins a run of the same length: receivers with different
// clocks repeat a frame at different times. Otherwise takes the nearest one with these channels within half a period.
void Aligner::match(const Frame &frame) {
  std::deque<Frame> &others = _sides[1].frames;
  const int64_t expectedUs = frame.us + std::llround(_delayUs);
  const size_t run = frame.isChange ? runOf(frame, _sides[0].frames, 0) : 0;
  size_t best = others.size();
  int64_t leastUs = INT64_MAX;
  bool isRun = false;
  for (size_t i = 0; i < others.size() && others[i].us <= expectedUs + WindowUs; i++) {
    const int64_t awayUs = std::abs(others[i].us - expectedUs);
    const bool isBegin = run > 0 && others[i].isChange && awayUs <= WindowUs &&
                         runOf(others[i], others, i + 1) == run &&
                         (awayUs <= _periodUs / 2 || (isSame(others[i].values, frame.values) && isOnly(frame)));
    const bool isBetter = isBegin == isRun ? awayUs < leastUs : isBegin;
    if ((isBegin || awayUs <= _periodUs / 2) && isBetter && isSame(others[i].values, frame.values)) {
      best = i;
      leastUs = awayUs;
      isRun = isBegin;
    }
  }
  if (best == others.size()) {
    _sides[0].unmatched.push_back(frame);
    return;
  }
  const auto end = others.begin() + static_cast<std::ptrdiff_t>(best);
  _sides[1].unmatched.insert(_sides[1].unmatched.end(), others.begin(), end);
  add(frame, *end, true, isLate(frame.us));
  if (!isLate(frame.us)) {
    _delayUs += (static_cast<double>(end->us - frame.us) - _delayUs) / (leastUs > _periodUs / 2 ? 1 : 16);
  }
  others.erase(others.begin(), end + 1);
}

// Gives up the second side's frames before this time, in its own clock.
void Aligner::giveUpSecond(int64_t beforeUs) {
  std::deque<Frame> &others = _sides[1].frames;
  while (!others.empty() && others.front().us < beforeUs) {
    _sides[1].unmatched.push_back(others.front());
    others.pop_front();
  }
}

// Pairs the oldest unmatched frame of a side with one of the other side that has these channels and came at another
// time: a port that hands bytes over late moves frames that are alike. A port may be later than it says: then only a
// frame is paired that is the only one with these channels.
bool Aligner::pairMoved(size_t side) {
  std::deque<Frame> &frames = _sides[side].unmatched, &others = _sides[1 - side].unmatched;
  const Frame frame = frames.front();
  const int64_t expectedUs = frame.us + (side == 0 ? 1 : -1) * std::llround(_delayUs);
  const auto other = std::find_if(others.begin(), others.end(), [&](const Frame &each) {
    const int64_t awayUs = std::abs(each.us - expectedUs);
    const bool isLatePort = std::max(frame.lateUs, each.lateUs) > _periodUs / 2;
    return isSame(each.values, frame.values) &&
           ((isLatePort && awayUs <= 2 * WindowUs) ||
            (awayUs <= MovedUs && frame.isChange && each.isChange && isOnly(frame)));
  });
  if (other == others.end()) {
    return false;
  }
  add(side == 0 ? frame : *other, side == 0 ? *other : frame, true, true);
  others.erase(other);
  frames.pop_front();
  return true;
}

// Unmatched frames at the same time are a pair with different contents.
void Aligner::pairUnmatched(int64_t beforeUs) {
  const int64_t delayUs = std::llround(_delayUs);
  std::deque<Frame> &ones = _sides[0].unmatched, &others = _sides[1].unmatched;
  while (!ones.empty() || !others.empty()) {
    const int64_t oneUs = ones.empty() ? INT64_MAX : ones.front().us;
    const int64_t otherUs = others.empty() ? INT64_MAX : others.front().us - delayUs;
    if (std::min(oneUs, otherUs) >= beforeUs) {
      return;
    }
    const size_t side = oneUs <= otherUs ? 0 : 1;
    if (pairMoved(side)) {
      continue;
    }
    if (!ones.empty() && !others.empty() && std::abs(oneUs - otherUs) <= _periodUs / 2) {
      add(ones.front(), others.front(), false, isLate(ones.front().us));
      ones.pop_front();
      others.pop_front();
      continue;
    }
    addOnly(side, std::min(oneUs, otherUs), _sides[side].unmatched.front());
    _sides[side].unmatched.pop_front();
  }
}

void Aligner::add(const Frame &a, const Frame &b, bool isSameContent, bool isLate) {
  _found.emplace(a.us, Alignment{Alignment::Kind::Pair, 0, {a.values, b.values}, b.us - a.us, isSameContent, isLate});
}

void Aligner::addOnly(size_t side, int64_t us, const Frame &frame) {
  Alignment finding{Alignment::Kind::Only, side, {}, 0, false, isLate(us)};
  finding.values[side] = frame.values;
  _found.emplace(us, finding);
}

// Returns true if the PC was late on either side, at a time of the first one.
bool Aligner::isLate(int64_t us) const {
  int64_t sideUs = us;
  for (const Side &side : _sides) {
    if (std::any_of(side.late.begin(), side.late.end(), [sideUs](const std::pair<int64_t, int64_t> &late) {
          return sideUs >= late.first - WindowUs && sideUs <= late.second + WindowUs;
        })) {
      return true;
    }
    sideUs = us + std::llround(_delayUs);
  }
  return false;
}

// Before the delay is known: gives up frames from a minute or more before the other side's first frame.
void Aligner::giveUpOld(size_t side) {
  std::deque<Frame> &frames = _sides[side].frames;
  const Side &other = _sides[1 - side];
  while (!_hasDelay && other.frames.empty() && !frames.empty() && frames.front().us < other.knownUs - MinuteUs) {
    addOnly(side, frames.front().us, frames.front());
    emitBefore(INT64_MAX);
    frames.pop_front();
  }
}

void Aligner::emitBefore(int64_t us) {
  while (!_found.empty() && _found.begin()->first < us) {
    _onFinding(_found.begin()->first, _found.begin()->second);
    _found.erase(_found.begin());
  }
}

}  // namespace line
