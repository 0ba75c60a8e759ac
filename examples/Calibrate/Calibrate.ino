/*
  Calibrate: measures what your radio really sends, and keeps the result in EEPROM. Boards without EEPROM do not store
  it.

  Wiring (Tlera Grasshopper, FrSky R-XSR): S-BUS_OUT -> D0 (RX1), +5V -> VIN, GND -> GND

  Follow the instructions in the Serial Monitor. Then it prints CH1..CH4, -1000..+1000. Send a letter to start again.
*/

#include <DecodeSBus.h>
#include <SBusBoard.h>
#include <sbus/Calibrator.h>

#include "Guide.h"
#include "Storage.h"

DecodeSBus dSBus(SBUS_UART);  // this board's port, on most boards Serial1: extras/docs/boards.md
sbus::Calibrator calibrator;
sbus::Calibration calibration;
Guide guide = {dSBus, calibrator, {}};

void setup() {
  Serial.begin(115200);
  dSBus.begin();
  load(EEPROM, calibration);
}

void loop() {
  if (Serial.read() <= ' ' && stateOf(calibration) == sbus::StoredState::Good) {
    guide.listen(200);
    for (uint8_t i = 0; dSBus.SBusFrameOk() && i < 4; i++) {
      Serial.print(calibration.channels[i].toNormalized(guide.channels[i]));
      Serial.print(i < 3 ? "," : "\r\n");
    }
    return;
  }
  calibrator.begin();
  guide.step("1. Move all sticks, sliders and switches to all their ends.", 15, sbus::CalibrationError::NotRested);
  guide.step("2. Centre the sticks, but throttle low, and let go.", 5, sbus::CalibrationError::NotRested);
  calibrator.centre();
  guide.step("Hands off.", 2, sbus::CalibrationError::NotPushed);
  calibrator.high();
  guide.step("3. Push both sticks up and right, and hold them there.", 5, sbus::CalibrationError::None);
  uint8_t bad = 0;
  const sbus::CalibrationError error = calibrator.finish(0x000F, calibration, bad);  // CH1..CH4 must be good
  if (error != sbus::CalibrationError::None) {
    Serial.print("Not stored: CH");
    Serial.print(bad + 1);
    Serial.println(text(error));
  } else {
    Serial.println(store(EEPROM, calibration) ? "Stored, and read back." : "Not stored: the EEPROM does not hold it.");
  }
}
