/*
  PpmOut: eight channels of S.Bus as a PPM sum signal, for the trainer port of a radio or an old flight controller.

  Wiring (Tlera Grasshopper, FrSky R-XSR): S-BUS_OUT -> D0 (RX1), +5V -> VIN, GND -> GND
    D2 (Mega: 11; Leonardo, Uno, Nano: 9) -> 1 kOhm -> the PPM input, GND -> its GND

  A frame of CH1..CH8 comes every 22.5 ms: nine pulses of 0.3 ms, 0.8 to 2.2 ms from one to the next, then at least 4.6
  ms without a pulse. In failsafe, and when no frame has come for 100 ms, there are no pulses at all: only this tells
  the connected device that the link is lost. Held positions would look like a pilot who does not move, and a receiver's
  failsafe positions like one who closes the throttle, and no trainer port would give the model back to the teacher.
  Take the propeller off before you try this. Sends the eight channels in us over USB five times a second, 0 without
  pulses.
*/

#include <DecodeSBus.h>
#include <SBusBoard.h>
#include <elapsedMillis.h>
#include <sbus/Scaling.h>

#include "PpmTimer.h"

DecodeSBus dSBus(SBUS_UART);  // this board's port, on most boards Serial1: extras/docs/boards.md
Ppm ppm;

const bool INVERTED = false;               // true: HIGH at rest, LOW pulses
const unsigned long PERIOD_DISPLAY = 200;  // ms

elapsedMillis timerDisplay;

void setup() {
  Serial.begin(115200);
  dSBus.begin();
  ppmTimer::begin(ppm, INVERTED);
}

void loop() {
  dSBus.parseSBusFrame();
  uint16_t channels[18];
  bool failsafe, lostFrame;
  dSBus.decodeSBusFrame(channels, failsafe, lostFrame);  // failsafe: also if no frame has come for 100 ms, or ever
  int16_t pulses[Ppm::Channels] = {};
  if (failsafe) {
    ppm.stop();
  } else {
    for (uint8_t i = 0; i < Ppm::Channels; i++) {
      pulses[i] = sbus::toMicroseconds(channels[i], sbus::FrSky);
    }
    ppm.write(pulses);
  }
  ppmTimer::poll();
  if (timerDisplay >= PERIOD_DISPLAY) {
    timerDisplay = 0;
    for (uint8_t i = 0; i < Ppm::Channels; i++) {
      Serial.print(pulses[i]);
      Serial.print(i + 1 < Ppm::Channels ? "," : "\r\n");
    }
  }
}
