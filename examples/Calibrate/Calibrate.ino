/*
  Calibrate: finds out what your radio really sends, and keeps it in EEPROM. Boards without any forget it.

  Wiring (Tlera Grasshopper, FrSky R-XSR): S-BUS_OUT -> D0 (RX1), +5V -> VIN, GND -> GND

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

void listen(unsigned long ms) {
  for (elapsedMillis timer; timer < ms;) {
    dSBus.parseSBusFrame();
    if (dSBus.newFrame()) {  // each frame once
      dSBus.decodeSBusFrame(channels, failsafe, lostFrame);
      calibrator.feed(channels, failsafe, lostFrame);
    }
  }
}

// A line a second: how far CH1..CH4 have come, and what is still to do with each, unless that is `next`.
void step(const char *what, uint8_t seconds, sbus::Refusal next) {
  Serial.println(what);
  for (uint8_t i = 0; i < 4 * seconds; i++) {
    listen(250);  // no more than one channel is printed at once: it takes time in which frames come
    uint16_t low = 0, high = 0;
    calibrator.reached(i % 4, low, high);
    sbus::CalibratedChannel found;
    const sbus::Refusal refusal = calibrator.result(i % 4, found);
    Serial.print("  CH");
    Serial.print(i % 4 + 1);
    Serial.print(refusal == next ? " ok" : text(refusal));
    Serial.print(' ');
    Serial.print(low);
    Serial.print("..");
    Serial.print(high);
    Serial.print(i % 4 < 3 ? "," : "\r\n");
  }
}

void setup() {
  Serial.begin(115200);
  dSBus.begin();
  load(EEPROM, calibration);
}

void loop() {
  if (Serial.read() <= ' ' && stateOf(calibration) == sbus::StoredState::Good) {
    listen(200);
    for (uint8_t i = 0; dSBus.SBusFrameOk() && i < 4; i++) {
      Serial.print(calibration.channels[i].toNormalised(channels[i]));
      Serial.print(i < 3 ? "," : "\r\n");
    }
    return;
  }
  calibrator.begin();
  step("1. Move all sticks, sliders and switches to all their ends.", 15, sbus::Refusal::NotRested);
  step("2. Centre the sticks, but throttle low, and let go.", 5, sbus::Refusal::NotRested);
  calibrator.centre();
  step("Hands off.", 2, sbus::Refusal::NotPushed);
  calibrator.high();
  step("3. Push both sticks up and right, and hold them there.", 5, sbus::Refusal::None);
  uint8_t bad = 0;
  const sbus::Refusal refusal = calibrator.finish(0x000F, calibration, bad);  // CH1..CH4 must be good
  if (refusal != sbus::Refusal::None) {
    Serial.print("Not stored: CH");
    Serial.print(bad + 1);
    Serial.println(text(refusal));
  } else {
    Serial.println(store(EEPROM, calibration) ? "Stored, and read back." : "Not stored: the EEPROM does not hold it.");
  }
}
