#include "line/Decoders.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace line {

namespace {

constexpr uint8_t ShortGap = 3;    // characters, like a port that waits for them
constexpr int SureLead = 2;        // votes ahead of the other decoder
constexpr int LeadMost = 8;        // after as many frames a line that has changed has its other decoder
constexpr uint64_t EndUs = 50000;  // a longer silence ends everything before it
constexpr size_t MostOpen = 8;     // at most this many frames of one decoder wait for the other

}  // namespace

void Places::rejected(int at, sbus::Rejection why) {
  rejections.push_back({_open[static_cast<size_t>(at)], why});
  if (rejections.size() > Segments::KeptMax) {
    rejections.erase(rejections.begin());
  }
}

// Characters with errors never reach a decoder: a frame with such a character and an extra byte at its end looks whole.
void Places::found(Stretch::Kind variant, int size, uint8_t flags) {
  const uint64_t begin = _open.front();
  const uint64_t end = _open[static_cast<size_t>(size - 1)] + 1;
  _open.erase(_open.begin(), _open.begin() + size);
  votes += variant != Stretch::Kind::Extra && !isDoubtful(variant, begin);
  _foundEnd = end;
  if (end - begin == static_cast<uint64_t>(size)) {
    pieces.push_back({variant, begin, end});
    return;
  }
  pieces.push_back({Stretch::Kind::NoFrame, begin, end});
  _bad.discardedBytes += static_cast<uint32_t>(size);
  if (variant == Stretch::Kind::Extra) {
    _bad.extraFrames++;
  } else {
    _bad.count(flags);
  }
}

sbus::Counters Places::withoutErrors(sbus::Counters counters) const {
  counters.frames -= _bad.frames;
  counters.lostFrames -= _bad.lostFrames;
  counters.failsafeFrames -= _bad.failsafeFrames;
  counters.extraFrames -= _bad.extraFrames;
  counters.discardedBytes += _bad.discardedBytes;
  return counters;
}

// Returns true if this may be part of the other decoder's frames when gaps do not help: 25 of every 36 bytes, or 36
// bytes that begin in every second frame.
bool Places::isDoubtful(Stretch::Kind variant, uint64_t begin) const {
  const uint64_t between = (begin - _foundEnd) % sbus::FrameSize24;
  const bool is24 = variant == Stretch::Kind::Frame24;
  return isBursty && (_foundEnd == 0 || (is24 ? between != 0 : between == sbus::FrameSize24 - sbus::FrameSize));
}

template <typename Call>
const std::vector<Piece> &Decoders::forBoth(Call call) {
  if (_isDecided) {
    _finder16.events().pieces.clear();
    _finder24.events().pieces.clear();
  }
  call(_finder16);
  call(_finder24);
  return decide(_nowUs >= _byteUs + EndUs);
}

bool Decoders::leads24() const {
  return _lead24 != 0 ? _lead24 > 0 : _finder24.counters().frames > _finder16.counters().frames;
}

sbus::Counters Decoders::ownCounters() const {
  return places().withoutErrors(has24() ? _finder24.counters() : _finder16.counters());
}

sbus::Counters Decoders::counters() const {
  sbus::Counters counters = ownCounters();
  for (const auto count : AllCounts) {
    counters.*count += _before.*count;
  }
  return counters;
}

const std::vector<Piece> &Decoders::decide(bool isOver) {
  const int more24 = std::exchange(_finder24.events().votes, 0) - std::exchange(_finder16.events().votes, 0);
  _lead24 = std::clamp(_lead24 + more24, -LeadMost, LeadMost);
  const bool is24 = leads24();
  if (_isDecided && is24 != _is24 && counters().frames > 0) {
    const sbus::Counters all = counters();
    _is24 = is24;
    const sbus::Counters own = ownCounters();
    for (const auto count : AllCounts) {
      _before.*count = all.*count - own.*count;
    }
    return _none;
  }
  _is24 = is24;
  _isDecided = _isDecided || !_finder16.events().isBursty || std::abs(_lead24) >= SureLead ||
               (isOver && counters().frames != 0) || places().pieces.size() >= MostOpen;
  return _isDecided ? places().pieces : _none;
}

const std::vector<Piece> &Decoders::finish() { return decide(true); }

// A gap of eight characters is seen, one of seven is not. idle() is called at once: otherwise a finder would guess.
void Decoders::reset(uint64_t nowUs, uint32_t characterUs) {
  const auto us = static_cast<uint8_t>(std::min<uint32_t>(characterUs, UINT8_MAX));  // a slower line is not S.Bus
  _nowUs = nowUs;
  _byteUs = nowUs;
  _isDecided = false;
  _is24 = false;
  _lead24 = 0;
  _before = {};
  forBoth([=](auto &finder) {
    finder.reset(static_cast<uint32_t>(nowUs), us, ShortGap);
    finder.events() = {};
    finder.idle(static_cast<uint32_t>(nowUs));
  });
}

const std::vector<Piece> &Decoders::idle(uint64_t nowUs) {
  _nowUs = std::max(_nowUs, nowUs);
  return forBoth([this](auto &finder) { finder.idle(static_cast<uint32_t>(_nowUs)); });
}

const std::vector<Piece> &Decoders::put(uint8_t byte, uint64_t at, uint64_t nowUs, bool isBursty) {
  _nowUs = nowUs;
  _byteUs = nowUs;
  return forBoth([=](auto &finder) {
    finder.events().put(at);
    finder.events().isBursty = isBursty;
    finder.poll(1, static_cast<uint32_t>(nowUs));
    *finder.space() = byte;
    finder.received(1, 0);
  });
}

uint64_t Decoders::openAt(uint64_t end) const {
  if (counters().frames != 0 && _isDecided) {
    return places().openAt(end);
  }
  for (const Places *each :
       {static_cast<const Places *>(&_finder16.events()), static_cast<const Places *>(&_finder24.events())}) {
    end = std::min(each->pieces.empty() ? end : each->pieces.front().begin, each->openAt(end));
  }
  return end;
}

}  // namespace line
