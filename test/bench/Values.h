// What sending, scaling and calibrating cost, in instructions. Each is 0 if what it measures does not do its work.
#pragma once

#include <cstdint>

// EncodeSBus::write(), micros() with it, without the port's own.
uint32_t costOfSending();  // a frame
uint32_t costOfNotDue();   // too early for one

// The worst of all 2048 raw values, or of -1000..1000, on a FrSky's range.
uint32_t costOfMicroseconds();
uint32_t costOfNormalised();
uint32_t costOfFromNormalised();
uint32_t costOfUnit();
uint32_t costOfCalibrated();  // toNormalised() by a calibrated channel with a dead zone

uint32_t costOfFeeding();    // Calibrator::feed(), the worst of the three steps
uint32_t costOfFinishing();  // Calibrator::finish(), 16 good channels
uint32_t costOfStateOf();    // of a good calibration
