#include "Calibrator.h"

namespace sbus {

namespace {

constexpr int16_t EndPart = 16;    // a channel that rests within 1/16 of its travel from an end rests at that end
constexpr int16_t CentrePart = 4;  // one that rests at least 1/4 of it from both is centred: trims move it so far
constexpr int16_t PushPart = 4;    // a push moves it by more than 1/4

}  // namespace

const char *text(Refusal refusal) {
  switch (refusal) {
    case Refusal::None:
      return "";
    case Refusal::NeverSeen:
      return " was not seen";
    case Refusal::HardlyMoved:
      return " hardly moved";
    case Refusal::CentreOutside:
      return " rests where it has never been while it moved";
    case Refusal::NotStill:
      return " did not stand still";
    case Refusal::NotCentred:
      return " rests neither near the middle nor at an end";
    case Refusal::NotPushed:
      return " was not pushed";
  }
  return "";
}

void Calibrator::Extent::include(uint16_t value) {
  if (value < low) {
    low = value;
  }
  if (value > high) {
    high = value;
  }
}

// What was seen in this step and the ones after it is forgotten.
void Calibrator::begin(Step step) {
  _step = step;
  for (uint8_t i = step; i < StepCount; i++) {
    for (Extent &seen : _seen[i]) {
      seen = {UINT16_MAX, 0};
    }
  }
}

void Calibrator::feed(const uint16_t channels[], bool failsafe, bool lostFrame) {
  if (failsafe || lostFrame) {
    return;
  }
  for (uint8_t i = 0; i < ProportionalCount; i++) {
    _seen[_step][i].include(channels[i] < ChannelMax ? channels[i] : ChannelMax);
  }
}

Refusal Calibrator::measure(uint8_t channel, bool wanted, CalibratedChannel &calibrated) const {
  if (channel >= ProportionalCount) {
    return Refusal::NeverSeen;
  }
  Extent travel = _seen[Travel][channel];
  const Extent &rest = _seen[Centre][channel];
  const Extent &push = _seen[High][channel];
  if (!travel.seen() || !rest.seen() || (_step == High && !push.seen())) {
    return Refusal::NeverSeen;
  }
  if (travel.high - travel.low < TravelMin) {
    return Refusal::HardlyMoved;
  }
  if (rest.high - rest.low > StillMax) {
    return Refusal::NotStill;
  }
  if (rest.low + StillMax < travel.low || rest.high > travel.high + StillMax) {
    return Refusal::CentreOutside;
  }
  travel.include(rest.low);
  travel.include(rest.high);
  const int16_t length = static_cast<int16_t>(travel.high - travel.low);
  const int16_t resting = static_cast<int16_t>((rest.low + rest.high + 1) / 2);
  const int16_t below = static_cast<int16_t>(resting - travel.low);
  const int16_t above = static_cast<int16_t>(travel.high - resting);
  const int16_t nearest = below < above ? below : above;
  const bool centred = nearest >= length / CentrePart;
  if (!centred && nearest > length / EndPart && wanted) {
    return Refusal::NotCentred;
  }
  const int16_t fallen = static_cast<int16_t>(push.seen() ? resting - push.low : 0);
  const int16_t risen = static_cast<int16_t>(push.seen() ? push.high - resting : 0);
  if (push.seen() && wanted && fallen <= length / PushPart && risen <= length / PushPart) {
    return Refusal::NotPushed;
  }
  const bool backwards = fallen > length / PushPart && fallen > risen;
  const uint16_t jitter = static_cast<uint16_t>(resting - rest.low);
  const uint16_t middle = static_cast<uint16_t>((travel.low + travel.high + 1) / 2);
  calibrated.range.low = backwards ? travel.high : travel.low;
  calibrated.range.centre = centred ? static_cast<uint16_t>(resting) : middle;
  calibrated.range.high = backwards ? travel.low : travel.high;
  calibrated.deadZone = !centred ? uint16_t{0} : jitter > _deadZone ? jitter : _deadZone;
  return Refusal::None;
}

Refusal Calibrator::finish(uint16_t wanted, Calibration &calibration, uint8_t &channel) const {
  Calibration found;
  for (uint8_t i = 0; i < ProportionalCount; i++) {
    const bool isWanted = (wanted >> i & 1) != 0;
    found.channels[i] = {{0, 0, 0}, 0};
    const Refusal refusal = measure(i, isWanted, found.channels[i]);
    if (isWanted && refusal != Refusal::None) {
      channel = i;
      return refusal;
    }
  }
  seal(found);
  calibration = found;
  return Refusal::None;
}

}  // namespace sbus
