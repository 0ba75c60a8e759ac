/*
  Servos: CH1..CH4 to four servos or speed controllers, with a failsafe for a lost link.

  Wiring (Tlera Grasshopper, FrSky R-XSR): S-BUS_OUT -> D0 (RX1), +5V -> VIN, GND -> GND
    D2..D5 -> the signal wires of CH1..CH4; the servos have their own supply, with its GND connected to GND
    Uno R3, Nano: S.Bus -> 7. All boards: extras/docs/boards.md

  Needs the library Servo, or ESP32Servo on an ESP32, from the Library Manager, unless the board's core has one. An Uno
  R3 and a Nano need neither.

  On failsafe, and when no frame has come for 100 ms, the throttle closes and the other servos hold. A FrSky receiver
  set to "No pulses" may send 0 without a flag: then use DecodeSBusNoPulses, or all servos go to one end. Take the
  propeller off before you try this. Sends the pulses "CH1,CH2,CH3,CH4" in us over USB five times a second, if the board
  has a second port: an ESP8266 has not.
*/

#define SBUS_MAY_TAKE_USB

#include <DecodeSBus.h>
#include <SBusBoard.h>
#include <elapsedMillis.h>
#include <sbus/Scaling.h>
#if defined(ARDUINO_ARCH_stm32l0)
#include "GrasshopperServo.h"  // the STM32L0 core has no Servo library
#elif SBUS_TAKES_TIMER
#include "TimerServo.h"  // the library's interrupt is too long: frames would be missed
#elif defined(ESP32)
#include <ESP32Servo.h>  // No such file? Install the library ESP32Servo from the Library Manager
#else
#include <Servo.h>  // No such file? Install the library Servo from the Library Manager
#endif

DecodeSBus dSBus(SBUS_UART);          // this board's port, on most boards Serial1: extras/docs/boards.md
const int PINS[] = {SBUS_FREE_PINS};  // servo pins: 2, 3, 4, 5 on most boards

const int THROTTLE = 2;                    // CH3, counted from 0
const unsigned long PERIOD_DISPLAY = 200;  // ms

// us, until the first frame
int16_t pulses[] = {sbus::CentrePulse, sbus::CentrePulse, sbus::LowPulse, sbus::CentrePulse};
Servo servos[4];
uint16_t channels[18];
bool failsafe, lostFrame;
#if !SBUS_TAKES_USB
bool tellsRoom = false;
elapsedMillis timerDisplay;
#endif

void setup() {
#if !SBUS_TAKES_USB
  Serial.begin(115200);
#endif
  dSBus.begin();
  for (int i = 0; i < 4; i++) {
    servos[i].writeMicroseconds(pulses[i]);  // before any pulse: the throttle starts closed
    servos[i].attach(PINS[i]);
    servos[i].writeMicroseconds(pulses[i]);  // some libraries forget what was set before attach() (ESP32, Uno R4)
  }
}

void loop() {
  dSBus.parseSBusFrame();
  dSBus.decodeSBusFrame(channels, failsafe, lostFrame);  // failsafe: also if no frame has come for 100 ms, or ever
  for (int i = 0; i < 4; i++) {
    if (!failsafe) {
      pulses[i] = sbus::limited(sbus::toMicroseconds(channels[i], sbus::FrSky), sbus::LowPulse, sbus::HighPulse);
    } else if (i == THROTTLE) {
      pulses[i] = sbus::LowPulse;
    }
    servos[i].writeMicroseconds(pulses[i]);
  }
#if !SBUS_TAKES_USB
  // Printing must not delay the servos. It may wait only where Serial always reports no room (mbed, Uno R4 WiFi).
  tellsRoom = tellsRoom || Serial.availableForWrite() > 0;
  if (timerDisplay >= PERIOD_DISPLAY && (Serial.availableForWrite() > 24 || !tellsRoom)) {
    timerDisplay = 0;
    for (int i = 0; i < 4; i++) {
      Serial.print(pulses[i]);
      Serial.print(i < 3 ? "," : "\r\n");
    }
  }
#endif
}
