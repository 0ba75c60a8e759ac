/*
  AllChannels: all eighteen channels of an S.Bus receiver, as numbers on a line.

  Wiring (Tlera Grasshopper, FrSky R-XSR):
    R-XSR S-BUS_OUT -> D0 (RX1)
    R-XSR +5V       -> VIN
    R-XSR GND       -> GND

  Sends a line "CH1,CH2, ... CH16,CH17,CH18" over USB five times a second: CH1..CH16 are 0..2047, CH17 and CH18 are 0
  or 1. Read it with the Serial Monitor, a file or a spreadsheet. As curves, the Serial Plotter of the Arduino IDE shows
  the first 8 and Serial Oscilloscope the first 9: to see others, set FIRST to the number of the first channel.
*/

#include <DecodeSBus.h>
#include <SBusBoard.h>
#include <elapsedMillis.h>

DecodeSBus dSBus(SBUS_UART);  // this board's port, on most boards Serial1: extras/docs/boards.md

const int FIRST = 1;                       // the first channel on the line, 1..18
const unsigned long PERIOD_DISPLAY = 200;  // ms

uint16_t channels[18];
bool failsafe;
bool lostFrame;

elapsedMillis timerDisplay;

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
    for (int i = FIRST; i < 18; i++) {
      Serial.print(channels[i - 1]);
      Serial.print(',');
    }
    Serial.println(channels[17]);
  }
}
