// One step of a calibration: says what to do, listens, and shows live how far CH1..CH4 have come.
#pragma once

#include <DecodeSBus.h>
#include <elapsedMillis.h>
#include <sbus/Calibrator.h>

struct Guide {
  DecodeSBus &dSBus;
  sbus::Calibrator &calibrator;
  uint16_t channels[18];  // of the newest frame

  void listen(unsigned long ms) {
    bool failsafe, lostFrame;
    for (elapsedMillis timer; timer < ms;) {
      dSBus.parseSBusFrame();
      if (dSBus.newFrame()) {  // each frame once
        dSBus.decodeSBusFrame(channels, failsafe, lostFrame);
        calibrator.feed(channels, failsafe, lostFrame);
      }
    }
  }

  // Prints a line a second: how far each channel has come, and what is still to do with it, or "ok" if that is `next`.
  void step(const char *what, uint8_t seconds, sbus::CalibrationError next) {
    Serial.println(what);
    for (uint8_t i = 0; i < 4 * seconds; i++) {
      listen(250);  // no more than one channel is printed at once: it takes time in which frames come
      uint16_t low = 0, high = 0;
      calibrator.reached(i % 4, low, high);
      sbus::CalibratedChannel found;
      const sbus::CalibrationError error = calibrator.result(i % 4, found);
      Serial.print("  CH");
      Serial.print(i % 4 + 1);
      if (error == next) {
        Serial.print(" ok");
      } else {
        Serial.print(text(error));
      }
      Serial.print(' ');
      Serial.print(low);
      Serial.print("..");
      Serial.print(high);
      Serial.print(i % 4 < 3 ? "," : "\r\n");
    }
  }
};
