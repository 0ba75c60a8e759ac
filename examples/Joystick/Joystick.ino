/*
  Joystick: the transmitter as a game controller, for a flight simulator on any PC.

  Wiring (Arduino Leonardo or Micro): S.Bus -> inverter -> 0 (RX1), +5V -> 5V, GND -> GND
    Other boards and inverters: extras/docs/boards.md

  A USB joystick needs a Leonardo or Micro; a Zero or MKR (SAMD); an ESP32-S2 or S3 with USB Mode > USB-OTG; a Pico
  (arduino-pico); or a Teensy with USB Type > Serial + Keyboard + Mouse + Joystick. CH1..CH8 are the axes X, Y, Z, RX,
  RY, RZ, slider and dial (six on Pico and Teensy), CH9..CH18 the buttons. All other boards print the axes and the sum
  of the buttons five times a second: a Grasshopper's USB is only a serial port, and an Uno or Mega has a separate chip
  for USB.

  Without a link the axes are centred, the throttle is closed and the buttons are released.
*/

#include <DecodeSBus.h>
#include <SBusBoard.h>
#include <elapsedMillis.h>
#include <sbus/Scaling.h>

#include "UsbJoystick.h"

DecodeSBus dSBus(SBUS_UART);  // this board's port, on most boards Serial1: extras/docs/boards.md

const int THROTTLE = 2;                  // CH3, counted from 0
const int PRESSED = 500;                 // of 1000: a three-position switch is off in its middle
const unsigned long PERIOD_REPORT = 50;  // ms, when nothing moves: a PC may have been plugged in meanwhile

UsbJoystick joystick;
elapsedMillis timerReport;

// Thousandths of the travel of CH1..CH16; for Futaba write sbus::Futaba.
int16_t part(uint16_t raw) { return sbus::limited(sbus::toNormalized(raw, sbus::FrSky), -1000, 1000); }

void setup() {
  Serial.begin(115200);
  dSBus.begin();
  joystick.begin();
}

void loop() {
  dSBus.parseSBusFrame();
  if (!dSBus.newFrame() && timerReport < PERIOD_REPORT) {
    return;
  }
  timerReport = 0;
  uint16_t channels[18];
  bool failsafe, lostFrame;
  dSBus.decodeSBusFrame(channels, failsafe, lostFrame);  // failsafe: also if no frame has come for 100 ms, or ever
  JoystickReport report = {{0, 0, 0, 0, 0, 0, 0, 0}, 0};
  report.axes[THROTTLE] = -1000;  // 1000 if the radio reverses it
  for (int i = 0; i < 18 && !failsafe; i++) {
    if (i < 8) {
      report.axes[i] = part(channels[i]);
    } else if (i < 16 ? part(channels[i]) > PRESSED : channels[i] != 0) {
      report.buttons = static_cast<uint16_t>(report.buttons | 1u << (i - 8));
    }
  }
  joystick.send(report);
}
