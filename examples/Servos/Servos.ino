/*
  Servos: CH1..CH4 to four servos or speed controllers, with a failsafe for when the radio is lost.

  Wiring (Tlera Grasshopper, FrSky R-XSR): S-BUS_OUT -> D0 (RX1), +5V -> VIN, GND -> GND
    D2..D5 -> the signal wires of CH1..CH4; the servos have a supply of their own, and its GND goes to GND

  On failsafe, and when no frame has come for 100 ms, the throttle closes and the rest holds where it is. Take the
  propeller off to try that. Sends the pulses "CH1,CH2,CH3,CH4" in us over USB five times a second.
*/

#include <DecodeSBus.h>
#include <elapsedMillis.h>
#include <sbus/Scaling.h>
#if defined(SERIAL_SBUS)
#include "GrasshopperServo.h"  // the STM32L0 core has no Servo library
#elif defined(ESP32)
#include <ESP32Servo.h>  // from the Library Manager
#else
#include <Servo.h>
#endif

DecodeSBus dSBus(Serial1);  // RX: D0 of a Grasshopper; ESP32: dSBus(Serial1, 16, 17); others: extras/docs/boards.md
const int PINS[] = {2, 3, 4, 5};  // of the servos; other boards: extras/docs/boards.md

const int THROTTLE = 2;                    // CH3, counted from 0
const unsigned long PERIOD_DISPLAY = 200;  // ms

// us, until a frame comes
int16_t pulses[] = {sbus::CentrePulse, sbus::CentrePulse, sbus::LowPulse, sbus::CentrePulse};
Servo servos[4];
bool tellsRoom = false;
elapsedMillis timerDisplay;

void setup() {
  Serial.begin(115200);
  dSBus.begin();
  for (int i = 0; i < 4; i++) {
    servos[i].writeMicroseconds(pulses[i]);  // before it sends any: the throttle begins closed
    servos[i].attach(PINS[i]);
    servos[i].writeMicroseconds(pulses[i]);  // some libraries forget what was set before attach() (ESP32, Uno R4)
  }
}

void loop() {
  dSBus.parseSBusFrame();
  uint16_t channels[18];
  bool failsafe, lostFrame;
  dSBus.decodeSBusFrame(channels, failsafe, lostFrame);  // failsafe also if no frame has come, or none for 100 ms
  for (int i = 0; i < 4; i++) {
    if (!failsafe) {
      pulses[i] = sbus::limited(sbus::toMicroseconds(channels[i], sbus::FrSky), sbus::LowPulse, sbus::HighPulse);
    } else if (i == THROTTLE) {
      pulses[i] = sbus::LowPulse;
    }
    servos[i].writeMicroseconds(pulses[i]);
  }
  // Printing must not delay the servos. It may wait only where Serial always reports no room (mbed, Uno R4 WiFi).
  tellsRoom = tellsRoom || Serial.availableForWrite() > 0;
  if (timerDisplay >= PERIOD_DISPLAY && (Serial.availableForWrite() > 24 || !tellsRoom)) {
    timerDisplay = 0;
    for (int i = 0; i < 4; i++) {
      Serial.print(pulses[i]);
      Serial.print(i < 3 ? "," : "\r\n");
    }
  }
}
