#include "Payload.h"

#include <algorithm>
#include <iterator>

#include "support/KnownFrames.h"
#include <sbus/Frame.h>

namespace {

constexpr const char *Names[] = {"uniform", "smooth",        "neutral",   "still",      "equal",
                                 "zeros",   "CH16 low",      "failsafe",  "0F/00",      "all 0F",
                                 "shifted", "shifted still", "other end", "slot inside"};

constexpr uint8_t OtherEnds[] = {0x04, 0x14, 0x24, 0x34, 0x08};
constexpr uint16_t EqualValues[] = {0, 992, 1024};

}  // namespace

const char *name(Payload sticks) { return Names[static_cast<unsigned>(sticks)]; }

const std::vector<Payload> &ordinarySticks() {
  static const std::vector<Payload> sticks = {Payload::Uniform, Payload::Smooth, Payload::Neutral,     Payload::Still,
                                              Payload::Equal,   Payload::Zeros,  Payload::LowChannel16};
  return sticks;
}

const std::vector<Payload> &deceptiveSticks() {
  static const std::vector<Payload> sticks = {Payload::Failsafe, Payload::Of0FAnd00, Payload::All0F, Payload::Shifted,
                                              Payload::ShiftedStill};
  return sticks;
}

PayloadFrames::PayloadFrames(Payload sticks, Random &random) : _sticks(sticks), _random(random) {
  std::generate_n(_channels.begin(), sbus::ProportionalCount,
                  [this] { return static_cast<uint16_t>(_random.below(2048)); });
}

Frame PayloadFrames::next() {
  if (_number % StandingFrames == 0) {
    change();
  }
  _number++;
  Frame frame{};
  frame[0] = sbus::HeaderByte;
  switch (_sticks) {
    case Payload::Uniform:
      frame = anyFrame();
      frame[sbus::FlagsIndex] = flags();
      break;
    case Payload::Smooth:
    case Payload::Zeros:
    case Payload::LowChannel16:
      move();
      return packed();
    case Payload::Neutral:
      return Neutral.bytes;
    case Payload::Still:
    case Payload::Equal:
    case Payload::ShiftedStill:
    case Payload::OtherEnd:
    case Payload::SlotInside:
      return _still;
    case Payload::Failsafe:
      return FailsafeFrame;
    case Payload::Of0FAnd00:
      std::generate_n(frame.begin() + 1, 22, [this] { return _random.chance(0.5) ? sbus::HeaderByte : uint8_t{0}; });
      break;
    case Payload::All0F:
      std::fill_n(frame.begin(), sbus::FlagsIndex, sbus::HeaderByte);
      break;
    case Payload::Shifted:
      frame = anyFrame();
      disguise(frame);
      break;
  }
  return frame;
}

// Gives new values to the channels that do not move.
void PayloadFrames::change() {
  _place = 2 + _random.below(22);
  _zeros = _random.below(1u << 16) & _random.below(1u << 16);
  _still = anyFrame();
  if (_sticks == Payload::ShiftedStill || _sticks == Payload::OtherEnd) {
    disguise(_still);
  } else if (_sticks == Payload::Equal) {
    const uint32_t which = _random.below(4);
    _channels.fill(which < 3 ? EqualValues[which] : static_cast<uint16_t>(_random.below(2048)));
    _channels[16] = _channels[17] = 0;
    sbus::pack(_still.data(), _channels.data(), false, false);
  }
}

Frame PayloadFrames::anyFrame() {
  Frame frame{};
  frame[0] = sbus::HeaderByte;
  std::generate_n(frame.begin() + 1, 22, [this] { return _random.byte(); });
  return frame;
}

// Flags, end byte and header: the bytes from there to the next frame's same place look like a frame. At place 2 the
// frame's own header serves as flags, and at place 23 its flags as header.
void PayloadFrames::disguise(Frame &frame) {
  if (_place > 2) {
    frame[_place - 2] = static_cast<uint8_t>(_random.below(4));
  }
  frame[_place - 1] = _sticks == Payload::OtherEnd ? OtherEnds[_random.below(std::size(OtherEnds))] : uint8_t{0};
  frame[_place] = sbus::HeaderByte;
}

void PayloadFrames::move() {
  for (unsigned i = 0; i < sbus::ProportionalCount; i++) {
    const int moved = _channels[i] + static_cast<int>(_random.below(41)) - 20;
    _channels[i] = static_cast<uint16_t>(std::clamp<int>(moved, 0, sbus::ChannelMax));
  }
}

Frame PayloadFrames::packed() {
  Channels channels = _channels;
  for (unsigned i = 0; i < sbus::ProportionalCount; i++) {
    if (_sticks == Payload::Zeros && (_zeros >> i & 1) != 0) {
      channels[i] = 0;
    }
  }
  const bool isLow = _sticks == Payload::LowChannel16 && _random.chance(0.5);
  if (isLow) {
    channels[15] = static_cast<uint16_t>(_random.chance(0.5) ? 0 : _random.below(128));
  }
  Frame frame;
  sbus::pack(frame.data(), channels.data(), false, false);
  frame[sbus::FlagsIndex] = isLow && _random.chance(0.5) ? static_cast<uint8_t>(_random.below(16)) : flags();
  return frame;
}

uint8_t PayloadFrames::flags() { return static_cast<uint8_t>(_random.chance(0.02) ? _random.below(16) : 0); }
