// What a raw value means, on a FrSky, a Futaba, or a radio that was calibrated here; and the calibration.
#include "Scope.h"
#include "sbus/Calibrator.h"

using namespace scope;

namespace {

enum Scale { FrSky, Futaba, Calibrated };
int scale = FrSky;

sbus::Calibrator calibrator;
sbus::Calibration calibration;
bool calibrating = false;
const char *rejection = "";
double range[3];

sbus::CalibratedChannel uncalibrated() {
  return {scale == Futaba ? sbus::Futaba : sbus::FrSky, 0};
}

sbus::CalibratedChannel of(unsigned channel) {
  const bool known =
      scale == Calibrated && channel < sbus::ProportionalCount && sbus::isCalibrated(calibration.channels[channel]);
  return known ? calibration.channels[channel] : uncalibrated();
}

}  // namespace

void scope::feedCalibrator(const line::Values &newest) {
  if (calibrating) {
    calibrator.feed(newest.raw.data(), newest.failsafe, newest.lostFrame);
  }
}

EXPORT(setScale)(int chosen)->void {
  scale = chosen;
}
// Of a Futaba 1100, 1520 and 1940 us: either make's receivers turn a raw value into the same pulse, 5 * raw / 8 + 880.
EXPORT(microseconds)(unsigned channel, double raw)->int {
  const sbus::CalibratedChannel scaled = scale == Futaba ? sbus::CalibratedChannel{sbus::FrSky, 0} : of(channel);
  return scaled.toMicroseconds(static_cast<uint16_t>(raw));
}
EXPORT(thousandths)(unsigned channel, double raw)->int {
  return of(channel).toNormalised(static_cast<uint16_t>(raw));
}

// Raw values at -100 %, 0 % and +100 %.
EXPORT(rangeOf)(unsigned channel)->const double * {
  const sbus::Range &found = of(channel).range;
  range[0] = found.low;
  range[1] = found.centre;
  range[2] = found.high;
  return range;
}

// Step 1: whole travel; 2: at rest; 3: up and right; 0: leaves it.
EXPORT(calibrate)(int step)->void {
  calibrating = step != 0;
  if (step == 1) {
    calibrator.begin();
  } else if (step == 2) {
    calibrator.centre();
  } else if (step == 3) {
    calibrator.high();
  }
}

// What is still to be done with a channel, to stand after its name; "" if nothing.
EXPORT(rejectionOf)(unsigned channel)->const char * {
  sbus::CalibratedChannel found;
  return sbus::text(calibrator.result(static_cast<uint8_t>(channel), found));
}

// Bit 0 of `wanted` is CH1. The channel that was rejected, from 0 on; -1 if none was, and scale 2 is this calibration.
EXPORT(finishCalibration)(unsigned wanted)->int {
  uint8_t channel = 0;
  const sbus::CalibrationError why = calibrator.finish(static_cast<uint16_t>(wanted), calibration, channel);
  rejection = sbus::text(why);
  return why == sbus::CalibrationError::None ? -1 : channel;
}
EXPORT(lastError)()->const char * {
  return rejection;
}

// The calibration, as it is stored: for the page to keep, and to put back.
EXPORT(calibrationBytes)()->sbus::Calibration * {
  return &calibration;
}
EXPORT(calibrationSize)()->unsigned {
  return sizeof calibration;
}

// Asked after they were put back. If not, there is none.
EXPORT(calibrationIsGood)()->int {
  const bool good = sbus::stateOf(calibration) == sbus::StoredState::Good;
  if (!good) {
    calibration = {};
  }
  return good;
}
