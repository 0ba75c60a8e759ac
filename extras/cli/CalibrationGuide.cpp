#include "cli/CalibrationGuide.h"

#include <stdexcept>
#include <utility>

namespace tool {

namespace {

using sbus::CalibrationError;

constexpr unsigned Sticks = 4;  // CH1 to CH4 must be good
constexpr uint64_t LookUs = 1000000;

}  // namespace

CalibrationGuide::CalibrationGuide(Say say) : _say(std::move(say)) {
  _calibrator.setDeadZone(0);
  begin(Step::Move);
}

void CalibrationGuide::begin(Step step) {
  _step = step;
  _lookUs = _nowUs + LookUs;
  if (step == Step::Move) {
    _calibrator.begin();
    sayOnce(
        "1 of 3: Move all sticks, sliders and switches to all their ends. Then centre the sticks, throttle low, let "
        "go, and press Enter.");
  } else if (step == Step::LetGo || step == Step::Rest) {
    _calibrator.centre();
  } else if (step == Step::Push) {
    _calibrator.high();
    sayOnce("3 of 3: Push both sticks up and right, and hold them there.");
  }
}

void CalibrationGuide::sayOnce(const std::string &text) {
  if (std::exchange(_said, text) != text) {
    _say(text);
  }
}

void CalibrationGuide::take(const line::Values &values, uint64_t nowUs) {
  _nowUs = nowUs;
  _calibrator.feed(values.raw.data(), values.failsafe, values.lostFrame);
}

// Returns what the first incomplete stick lacks, with its message in `text`; `next` if this step is complete.
CalibrationError CalibrationGuide::worst(CalibrationError next, std::string &text) const {
  for (uint8_t i = 0; i < Sticks; i++) {
    sbus::CalibratedChannel calibrated;
    const CalibrationError error = _calibrator.result(i, calibrated);
    if (error != next) {
      text = "CH" + std::to_string(i + 1) + sbus::text(error);
      return error;
    }
  }
  return next;
}

void CalibrationGuide::pressEnter() {
  std::string text;
  if (worst(CalibrationError::NotRested, text) == CalibrationError::NotRested) {
    sayOnce("2 of 3: Hands off.");
    begin(Step::LetGo);
  } else {
    sayOnce(text + ". Then press Enter.");
  }
}

// Checks the channels at the end of a second. A step that can no longer be completed starts over.
void CalibrationGuide::look() {
  std::string text;
  const CalibrationError next = _step == Step::Push ? CalibrationError::None : CalibrationError::NotPushed;
  const CalibrationError error = worst(next, text);
  if (error == next) {
    begin(_step == Step::LetGo ? Step::Rest : _step == Step::Rest ? Step::Push : Step::Done);
    return;
  }
  sayOnce(text + ".");
  if (error == CalibrationError::MovedOneWay || error == CalibrationError::CentreOutside) {
    begin(Step::Move);
  } else if (_step == Step::Push) {
    _lookUs = _nowUs + LookUs;
  } else {
    begin(Step::LetGo);
  }
}

void CalibrationGuide::tick(uint64_t nowUs, bool hasLink) {
  _nowUs = nowUs;
  if (waitsForEnter() || isDone()) {
    return;
  }
  if (!hasLink) {
    sayOnce("The link is lost: switch the radio on.");
    _lookUs = nowUs + LookUs;
  } else if (nowUs >= _lookUs) {
    look();
  }
}

sbus::Calibration CalibrationGuide::calibration() const {
  std::string text;
  sbus::Calibration found;
  uint8_t channel = 0;
  if (!isDone()) {
    worst(CalibrationError::None, text);
    throw std::runtime_error("nothing was written, because the third step was not completed: " + text);
  }
  _calibrator.finish((1 << Sticks) - 1, found, channel);
  return found;
}

}  // namespace tool
