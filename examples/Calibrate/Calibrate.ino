/*
  Calibrate: finds out what your radio really sends, and keeps it in EEPROM. Boards without any forget it.

  Wiring (Tlera Grasshopper, FrSky R-XSR): S-BUS_OUT -> D0 (RX1), +5V -> 5V, GND -> GND

  Do what it says in the Serial Monitor. Then it sends CH1..CH4, -1000..+1000. Send it a letter to begin anew.
*/

#include <DecodeSBus.h>
#include <elapsedMillis.h>
#include <sbus/Calibrator.h>

#include "Storage.h"

DecodeSBus dSBus(Serial1);  // RX: D0 of a Grasshopper; other boards: extras/docs/boards.md

uint16_t channels[18];
bool failsafe, lostFrame;
sbus::Calibration calibration;
sbus::Calibrator calibrator;

void listen(const char *text, unsigned long ms) {
  Serial.print(text);
  for (elapsedMillis timer; timer < ms;) {
    dSBus.parseSBusFrame();
    dSBus.decodeSBusFrame(channels, failsafe, lostFrame);
    calibrator.feed(channels, failsafe, lostFrame);
  }
}

void setup() {
  Serial.begin(115200);
  dSBus.begin();
  load(EEPROM, calibration);
}

void loop() {
  if (Serial.read() <= ' ' && stateOf(calibration) == sbus::StoredState::Good) {
    listen("", 200);
    for (uint8_t i = 0; dSBus.SBusFrameOk() && i < 4; i++) {
      Serial.print(calibration.channels[i].toNormalised(channels[i]));
      Serial.print(i < 3 ? "," : "\r\n");
    }
    return;
  }
  calibrator.begin();
  listen("Move all sticks, sliders and switches to all their ends.\r\n", 15000);
  listen("Centre the sticks, but throttle low, and let go.\r\n", 5000);
  calibrator.centre();
  listen("Stay so.\r\n", 2000);
  calibrator.high();
  listen("Push both sticks up and right.\r\n", 5000);
  uint8_t bad = 0;
  const sbus::Refusal refusal = calibrator.finish(0x000F, calibration, bad);  // CH1..CH4 must be good
  if (refusal == sbus::Refusal::None) {
    Serial.println(store(EEPROM, calibration) ? "Stored." : "Not stored: the EEPROM does not hold it.");
  } else {
    Serial.print("Not stored: CH");
    Serial.print(bad + 1);
    Serial.println(text(refusal));
  }
}
