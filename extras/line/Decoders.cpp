#include "Decoders.h"

#include <algorithm>

#include "sbus/FrameFinder.tpp"

SBUS_COMPILE_FINDER(sbus::Frame16, line::PlacesOf<sbus::Frame16>)
SBUS_COMPILE_FINDER(sbus::Frame24, line::PlacesOf<sbus::Frame24>)

namespace line {

namespace {

constexpr uint8_t ShortGap = 3;  // as if a port waited for so many characters

}  // namespace

void Places::rejected(int at, sbus::Rejection why) {
  rejections.push_back({_open[static_cast<size_t>(at)], why});
  if (rejections.size() > Segments::KeptMax) {
    rejections.erase(rejections.begin());
  }
}

// A decoder does not hear of bad characters: to it a frame that has one, and a byte too many at its end, looks whole.
void Places::found(Stretch::Kind kind, int size) {
  const uint64_t begin = _open.front();
  const uint64_t end = _open[static_cast<size_t>(size - 1)] + 1;
  discarded(size);
  pieces.push_back({end - begin == static_cast<uint64_t>(size) ? kind : Stretch::Kind::NoFrame, begin, end});
}

template <typename Call>
const std::vector<Piece> &Decoders::forBoth(Call call) {
  _finder16.events().pieces.clear();
  _finder24.events().pieces.clear();
  call(_finder16);
  call(_finder24);
  return places().pieces;
}

// A gap of eight characters is known, one of seven is not. idle(): a finder that has heard of no such call would guess.
void Decoders::reset(uint64_t nowUs, uint32_t characterUs) {
  const auto us = static_cast<uint8_t>(std::min<uint32_t>(characterUs, UINT8_MAX));  // a slower line has no S.Bus
  _nowUs = nowUs;
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

const std::vector<Piece> &Decoders::put(uint8_t byte, uint64_t at, uint64_t nowUs) {
  _nowUs = nowUs;
  return forBoth([=](auto &finder) {
    finder.events().put(at);
    finder.poll(1, static_cast<uint32_t>(nowUs));
    *finder.space() = byte;
    finder.received(1, 0);
  });
}

uint64_t Decoders::openAt(uint64_t end) const {
  return counters().frames != 0 ? places().openAt(end)
                                : std::min(_finder16.events().openAt(end), _finder24.events().openAt(end));
}

}  // namespace line
