// Scales raw values by FrSky's range, Futaba's, or that of a radio that was calibrated here; calibrates; and reads
// conditions, which compare scaled values.
#include <cstring>

#include "ShownLine.h"
#include "line/Condition.h"
#include "sbus/Calibrator.h"

using namespace scope;

namespace {

Scale scale = Scale::FrSky;

sbus::Calibrator calibrator;
sbus::Calibration calibration;
sbus::CalibrationError finishError = sbus::CalibrationError::None;
double range[3];
line::Condition condition("", nullptr);
ReadCondition answer;

sbus::CalibratedChannel uncalibrated() { return {scale == Scale::Futaba ? sbus::Futaba : sbus::FrSky, 0}; }

sbus::CalibratedChannel of(unsigned channel) {
  const bool known = scale == Scale::Calibrated && channel < sbus::ProportionalCount &&
                     sbus::isCalibrated(calibration.channels[channel]);
  return known ? calibration.channels[channel] : uncalibrated();
}

}  // namespace

EXPORT(setScale)(int chosen)->void { scale = static_cast<Scale>(chosen); }
// Receivers of both makes turn a raw value into a pulse of 5 * raw / 8 + 880 us: a Futaba's into 1100, 1520 and 1940.
EXPORT(microseconds)(unsigned channel, double raw)->int {
  const sbus::CalibratedChannel scaled = scale == Scale::Futaba ? sbus::CalibratedChannel{sbus::FrSky, 0} : of(channel);
  return scaled.toMicroseconds(static_cast<uint16_t>(raw));
}
EXPORT(thousandths)(unsigned channel, double raw)->int { return of(channel).toNormalized(static_cast<uint16_t>(raw)); }

// Reads a condition, the text in the buffer.
EXPORT(readCondition)(unsigned count, int isBoard)->const ReadCondition * {
  const auto shown = [](unsigned channel, uint16_t raw, bool isPercent) {
    return isPercent ? thousandths(channel, raw) / 10.0 : microseconds(channel, raw);
  };
  condition = line::Condition(transferred(count), isBoard == 1 ? line::Condition::Shown() : shown, isBoard != 0);
  const auto &[text, at, length] = condition.error();
  const std::vector<line::Condition::Step> &steps = condition.steps();
  answer = {text.c_str(), at, length, steps.data(), steps.size() * sizeof steps[0]};
  return &answer;
}

// Raw values at -100 %, 0 % and +100 %.
EXPORT(rangeOf)(unsigned channel)->const double * {
  const sbus::Range &found = of(channel).range;
  range[0] = found.low;
  range[1] = found.centre;
  range[2] = found.high;
  return range;
}

// Step 1: whole travel; 2: at rest; 3: up and right.
EXPORT(calibrate)(int step)->void {
  if (step == 1) {
    calibrator.begin();
  } else if (step == 2) {
    calibrator.centre();
  } else if (step == 3) {
    calibrator.high();
  }
}

// Takes a frame: its raw values are in the buffer, 16 bits each.
EXPORT(feedCalibrator)(int failsafe, int lostFrame)->void {
  uint16_t raw[sbus::ProportionalCount];
  std::memcpy(raw, transfer, sizeof raw);
  calibrator.feed(raw, failsafe != 0, lostFrame != 0);
}

// Returns what is still to be done with a channel, from 0 on: an sbus::CalibrationError.
EXPORT(calibrationErrorOf)(unsigned channel)->int {
  sbus::CalibratedChannel found;
  return static_cast<int>(calibrator.result(static_cast<uint8_t>(channel), found));
}
// Returns the error's text, to follow the channel's name.
EXPORT(calibrationErrorText)(int error)->const char * { return sbus::text(static_cast<sbus::CalibrationError>(error)); }

// Bit 0 of `required` is CH1. Returns the channel that failed, from 0 on, or -1: Scale::Calibrated then uses the
// calibration.
EXPORT(finishCalibration)(unsigned required)->int {
  uint8_t channel = 0;
  finishError = calibrator.finish(static_cast<uint16_t>(required), calibration, channel);
  return finishError == sbus::CalibrationError::None ? -1 : channel;
}
EXPORT(finishCalibrationError)()->int { return static_cast<int>(finishError); }

// Returns the calibration's bytes, for the page to store and to put back.
EXPORT(calibrationBytes)()->sbus::Calibration * { return &calibration; }
EXPORT(calibrationSize)()->unsigned { return sizeof calibration; }

// Returns true if the calibration that was put back is good. A damaged one is dropped.
EXPORT(calibrationIsGood)()->int {
  const bool good = sbus::stateOf(calibration) == sbus::StoredState::Good;
  if (!good) {
    calibration = {};
  }
  return good;
}
