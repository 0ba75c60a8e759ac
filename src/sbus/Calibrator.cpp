#include "Calibrator.h"

namespace sbus {

namespace {

// In the order of CalibrationError.
const char Errors[] SBUS_FLASH =
    "\0"
    " was not seen: switch the radio on\0"
    " hardly moved: move it to both ends\0"
    " went further than while it moved: move it to both ends\0"
    " did not stand still: let go of it\0"
    " rests neither near the middle nor at an end: centre it\0"
    " is where it rested: push it up or right\0"
    " moved one way only: move it to both ends\0"
    " has not rested: let go of it\0"
    " was not held: hold it up or right until told\0";

// A channel that rests within 1/16 of its travel from an end rests at that end; at least 1/4 of its travel from both
// ends it is centred, since trims move it that far. A push moves it by more than 1/4 of its travel.
constexpr int16_t EndPart = 16;
constexpr int16_t CentrePart = 4;
constexpr int16_t PushPart = 4;

// Sticks of all makes have their centre here, with trims of up to 25 %; none has an end here.
constexpr uint16_t MiddleMin = 700;
constexpr uint16_t MiddleMax = 1350;

constexpr uint8_t WrongFrame = 8;                                     // good frames that cancel one bad frame
constexpr uint8_t HeldMax = Calibrator::HeldFrames + 2 * WrongFrame;  // two wrong frames at the end do no harm

constexpr uint16_t smaller(uint16_t a, uint16_t b) { return a < b ? a : b; }
constexpr uint16_t larger(uint16_t a, uint16_t b) { return a > b ? a : b; }
constexpr bool isInMiddle(uint16_t value) { return value >= MiddleMin && value <= MiddleMax; }

}  // namespace

Text text(CalibrationError error) { return textOf(Errors, static_cast<uint8_t>(error)); }

void Calibrator::Extent::include(uint16_t lowest, uint16_t highest) {
  low = smaller(low, lowest);
  high = larger(high, highest);
}

void Calibrator::Hold::follow(uint16_t value) {
  if (frames > 0 && (value > place ? value - place : place - value) <= StillMax) {
    frames = smaller(static_cast<uint16_t>(frames + 1), HeldMax);
    // Follows the value by one: otherwise a first value that is far off would stay.
    place = static_cast<uint16_t>(place + (value > place) - (value < place));
  } else if (frames > WrongFrame) {
    frames = static_cast<uint16_t>(frames - WrongFrame);
  } else {
    *this = {value, 1};
  }
}

// Forgets what was seen in this step and those after it.
void Calibrator::begin(Step step) {
  _step = step;
  _frames = 0;
  for (uint8_t i = step; i < High; i++) {
    for (Extent &seen : _seen[i]) {
      seen = {UINT16_MAX, 0};
    }
  }
  for (Lately &lately : _lately) {
    lately.hold = {0, 0};
  }
}

void Calibrator::feed(ChannelArray<const uint16_t, ProportionalCount> channels, bool failsafe, bool lostFrame) {
  if (failsafe || lostFrame) {
    return;
  }
  if (_frames < SeenFrames) {
    _frames++;
  }
  for (uint8_t i = 0; i < ProportionalCount; i++) {
    const uint16_t value = smaller(channels[i], ChannelMax);
    if (_step == High) {
      _lately[i].hold.follow(value);
    } else if (_step == Centre) {
      _seen[Centre][i].include(value);
    } else {
      const Window window = _lately[i].window;
      if (_frames == SeenFrames) {
        _seen[Travel][i].include(larger(value, larger(window.last, window.before)),
                                 smaller(value, smaller(window.last, window.before)));
      }
      _lately[i].window = {value, window.last};
    }
  }
}

bool Calibrator::reached(uint8_t channel, uint16_t &low, uint16_t &high) const {
  if (channel >= ProportionalCount || _seen[Travel][channel].low > _seen[Travel][channel].high) {
    return false;
  }
  low = _seen[Travel][channel].low;
  high = _seen[Travel][channel].high;
  return true;
}

CalibrationError Calibrator::measure(uint8_t channel, bool required, CalibratedChannel &calibrated) const {
  if (channel >= ProportionalCount) {
    return CalibrationError::NeverSeen;
  }
  Extent travel = _seen[Travel][channel];
  const Extent &rest = _seen[Centre][channel];
  const Hold &hold = _lately[channel].hold;
  const bool pushed = _step == High;
  if (!travel.seen()) {
    return CalibrationError::NeverSeen;
  }
  if (travel.high < travel.low + TravelMin) {
    return CalibrationError::HardlyMoved;
  }
  if (!rest.seen()) {
    return isInMiddle(travel.low) || isInMiddle(travel.high) ? CalibrationError::MovedOneWay
                                                             : CalibrationError::NotRested;
  }
  if (rest.high - rest.low > StillMax) {
    return CalibrationError::NotStill;
  }
  if (pushed && hold.frames < HeldFrames) {
    return CalibrationError::NotHeld;
  }
  const uint16_t further = static_cast<uint16_t>((travel.high - travel.low) / EndPart);
  const uint16_t lowest = pushed ? smaller(rest.low, hold.place) : rest.low;
  const uint16_t highest = pushed ? larger(rest.high, hold.place) : rest.high;
  if (lowest + further < travel.low || highest > travel.high + further) {
    return CalibrationError::CentreOutside;
  }
  travel.include(lowest, highest);
  const int16_t length = static_cast<int16_t>(travel.high - travel.low);
  const int16_t resting = static_cast<int16_t>((rest.low + rest.high + 1) / 2);
  const int16_t below = static_cast<int16_t>(resting - travel.low);
  const int16_t above = static_cast<int16_t>(travel.high - resting);
  const int16_t nearest = below < above ? below : above;
  const bool centred = nearest >= length / CentrePart;
  const bool atEnd = nearest <= length / EndPart;
  if (atEnd && isInMiddle(static_cast<uint16_t>(resting))) {
    return CalibrationError::MovedOneWay;
  }
  if (!centred && !atEnd && required) {
    return CalibrationError::NotCentred;
  }
  const int16_t risen = static_cast<int16_t>(pushed ? hold.place - resting : 0);
  const bool backwards = risen < -(length / PushPart);
  if ((required || !pushed) && !backwards && risen <= length / PushPart) {
    return CalibrationError::NotPushed;
  }
  const uint16_t jitter = static_cast<uint16_t>(resting - rest.low);
  const uint16_t middle = static_cast<uint16_t>((travel.low + travel.high + 1) / 2);
  calibrated.range.low = backwards ? travel.high : travel.low;
  calibrated.range.centre = centred ? static_cast<uint16_t>(resting) : middle;
  calibrated.range.high = backwards ? travel.low : travel.high;
  calibrated.deadZone = !centred ? uint16_t{0} : jitter > _deadZone ? jitter : _deadZone;
  return CalibrationError::None;
}

CalibrationError Calibrator::finish(uint16_t required, Calibration &calibration, uint8_t &channel) const {
  Calibration found;
  bool any = false;
  for (uint8_t i = 0; i < ProportionalCount; i++) {
    const bool isRequired = (required >> i & 1) != 0;
    found.channels[i] = {{0, 0, 0}, 0};
    const CalibrationError error = measure(i, isRequired, found.channels[i]);
    if (isRequired && error != CalibrationError::None) {
      channel = i;
      return error;
    }
    any = any || error == CalibrationError::None;
  }
  if (!any) {
    channel = 0;
    return result(0, found.channels[0]);
  }
  seal(found);
  calibration = found;
  return CalibrationError::None;
}

}  // namespace sbus
