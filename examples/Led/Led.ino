/*
  Led: the board's LED shows the link and obeys CH5. It prints nothing, so it also runs on boards with one port, such as
  an ESP8266.

  Wiring (Uno R3, Nano): S.Bus -> 7, +5V -> 5V, GND -> GND.
    Inverters: extras/docs/wiring.md. All boards: extras/docs/boards.md

  The LED
    changes once a second         no frame has come yet
    changes ten times a second    the link is lost: no frame has come for 100 ms, or the receiver is in failsafe
    is on, or off                 CH5 is above its centre, or below
*/

#define SBUS_MAY_TAKE_USB

#include <DecodeSBus.h>
#include <SBusBoard.h>
#include <sbus/Scaling.h>

DecodeSBus dSBus(SBUS_UART);  // this board's port, on most boards Serial1: extras/docs/boards.md

#if defined(LED_BUILTIN)
const uint8_t LED = LED_BUILTIN;
#else
const uint8_t LED = 2;          // on most ESP32 boards
#endif
#if defined(ESP8266)
const bool LIT_BY_HIGH = false;  // most boards with an ESP8266 have the LED between 3.3 V and the pin
#else
const bool LIT_BY_HIGH = true;  // false on a XIAO
#endif
const int SWITCH = 4;  // CH5, counted from 0

SBusFrame frame;

void setup() {
  pinMode(LED, OUTPUT);
  dSBus.begin();
}

void loop() {
  dSBus.read(frame);  // failsafe: also if no frame has come for 100 ms, or ever
  const unsigned long period = dSBus.linkState() == sbus::LinkState::NeverSeen ? 1000 : 100;  // ms
  const bool isOn = frame.failsafe ? millis() / period % 2 != 0 : frame.channels[SWITCH] > sbus::FrSky.centre;
  digitalWrite(LED, isOn == LIT_BY_HIGH ? HIGH : LOW);
}
