#include "Sticks.h"

#include <algorithm>

#include <KnownFrames.h>
#include <sbus/Frame.h>

namespace {

constexpr double LostFrames = 0.02;

Frame packed(const Channels &channels, bool lostFrame) {
  Frame frame;
  sbus::pack(frame.data(), channels.data(), false, lostFrame);
  return frame;
}

}  // namespace

const char *name(Sticks sticks) {
  switch (sticks) {
    case Sticks::Uniform:
      return "uniform";
    case Sticks::Smooth:
      return "smooth";
    case Sticks::Neutral:
      return "neutral";
    case Sticks::Still:
      return "still";
    case Sticks::Of0FAnd00:
      return "0F/00";
    case Sticks::All0F:
      return "all 0F";
    case Sticks::Shifted:
      return "shifted";
    case Sticks::ShiftedStill:
      return "shifted still";
    case Sticks::LowChannel16:
      return "CH16 low";
  }
  return "";
}

const std::vector<Sticks> &gentleSticks() {
  static const std::vector<Sticks> sticks = {Sticks::Uniform, Sticks::Smooth, Sticks::Neutral};
  return sticks;
}

const std::vector<Sticks> &standingSticks() {
  static const std::vector<Sticks> sticks = {Sticks::Still};
  return sticks;
}

const std::vector<Sticks> &adversarialSticks() {
  static const std::vector<Sticks> sticks = {Sticks::Of0FAnd00, Sticks::All0F, Sticks::Shifted, Sticks::ShiftedStill,
                                             Sticks::LowChannel16};
  return sticks;
}

const std::vector<Sticks> &allSticks() {
  static const std::vector<Sticks> sticks = [] {
    std::vector<Sticks> all = gentleSticks();
    all.insert(all.end(), standingSticks().begin(), standingSticks().end());
    all.insert(all.end(), adversarialSticks().begin(), adversarialSticks().end());
    return all;
  }();
  return sticks;
}

StickFrames::StickFrames(Sticks sticks, Random &random) : _sticks(sticks), _random(random) {
  for (unsigned i = 0; i < sbus::ProportionalCount; i++) {
    _channels[i] = static_cast<uint16_t>(_random.below(2048));
  }
}

Frame StickFrames::next() {
  if (_number++ % StandingFrames == 0) {
    _place = 3 + _random.below(19);
    _still = anyFrame();
    if (_sticks == Sticks::ShiftedStill) {
      disguise(_still);
    }
  }
  Frame frame{};
  frame[0] = sbus::HeaderByte;
  switch (_sticks) {
    case Sticks::Uniform:
      frame = anyFrame();
      frame[sbus::FlagsIndex] = _random.chance(LostFrames) ? sbus::FlagLostFrame : 0;
      return frame;
    case Sticks::Smooth:
    case Sticks::LowChannel16:
      moveSmoothly();
      return packed(_channels, _random.chance(LostFrames));
    case Sticks::Neutral:
      return Neutral.bytes;
    case Sticks::Still:
    case Sticks::ShiftedStill:
      return _still;
    case Sticks::Of0FAnd00:
      for (unsigned i = sbus::PayloadIndex; i < sbus::FlagsIndex; i++) {
        frame[i] = _random.chance(0.5) ? sbus::HeaderByte : 0;
      }
      return frame;
    case Sticks::All0F:
      std::fill(frame.begin(), frame.begin() + sbus::FlagsIndex, sbus::HeaderByte);
      return frame;
    case Sticks::Shifted:
      frame = anyFrame();
      disguise(frame);
      return frame;
  }
  return frame;
}

Frame StickFrames::anyFrame() {
  Frame frame{};
  frame[0] = sbus::HeaderByte;
  for (unsigned i = sbus::PayloadIndex; i < sbus::FlagsIndex; i++) {
    frame[i] = _random.byte();
  }
  return frame;
}

// Flags, end byte and header in the payload: the bytes from there to the next frame's same place look like a frame.
void StickFrames::disguise(Frame &frame) {
  frame[_place - 2] = static_cast<uint8_t>(_random.below(4));
  frame[_place - 1] = 0;
  frame[_place] = sbus::HeaderByte;
}

void StickFrames::moveSmoothly() {
  for (unsigned i = 0; i < sbus::ProportionalCount; i++) {
    const int moved = _channels[i] + static_cast<int>(_random.below(41)) - 20;
    _channels[i] = static_cast<uint16_t>(std::clamp<int>(moved, 0, sbus::ChannelMax));
  }
  if (_sticks == Sticks::LowChannel16) {
    _channels[15] = 0;
  }
}
