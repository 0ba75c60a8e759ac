/*
  DecodeSBus: the first four channels of an S.Bus receiver as curves.

  Wiring (Tlera Grasshopper, FrSky R-XSR):
    R-XSR S-BUS_OUT -> D0 (RX1)
    R-XSR +5V       -> VIN
    R-XSR GND       -> GND

  Sends a line "CH1,CH2,CH3,CH4,failsafe,lostFrame" over USB five times a second, for Serial Oscilloscope
  (http://x-io.co.uk/serial-oscilloscope/) and the Serial Plotter of the Arduino IDE. The channels are 0..2047, the two
  flags 0 or 1. It sends nothing before the first frame.

  After J. Lemaire, "Decoding the S-Bus protocol with a Grasshopper".
*/

#include <DecodeSBus.h>
#include <SBusBoard.h>
#include <elapsedMillis.h>

DecodeSBus dSBus(SBUS_UART);  // this board's port, on most boards Serial1: extras/docs/boards.md

const unsigned long PERIOD_DISPLAY = 200;  // ms

uint16_t channels[18];
bool failsafe;
bool lostFrame;

elapsedMillis timerDisplay;

// As in the paper: the core calls this after every loop() while bytes wait on Serial1. Other cores read here, or in
// loop(); on the Grasshopper the port has already called the library when the bytes came.
void serialEvent1() { dSBus.parseSBusFrame(); }

void setup() {
  Serial.begin(115200);
  dSBus.begin();
}

void loop() {
  dSBus.parseSBusFrame();
  if (timerDisplay < PERIOD_DISPLAY) {
    return;
  }
  timerDisplay = 0;

  if (dSBus.SBusFrameOk()) {
    dSBus.decodeSBusFrame(channels, failsafe, lostFrame);
    for (int i = 0; i < 4; i++) {
      Serial.print(channels[i]);
      Serial.print(',');
    }
    Serial.print(failsafe);
    Serial.print(',');
    Serial.println(lostFrame);
  }
}
