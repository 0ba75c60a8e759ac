/*
  Channels24: all 24 channels of an FrSky receiver, as numbers on a line.

  On the radio, set the receiver to 24 channels: in ETHOS choose "SBUS 24", not "SBUS 16"; in EdgeTX switch on "SBUS24"
  in the receiver's options. ACCESS and TD receivers can do this. No numbers? The example Diagnose says why.

  Wiring (Tlera Grasshopper, FrSky ACCESS or TD receiver):
    SBUS OUT -> D0 (RX1)
    +5V      -> VIN
    GND      -> GND

  Sends a line "CH1,CH2, ... CH23,CH24" over USB five times a second, each 0..2047. Read it with the Serial Monitor, a
  file or a spreadsheet. As curves, the Serial Plotter of the Arduino IDE shows the first 8 and Serial Oscilloscope the
  first 9: to see others, set FIRST to the number of the first channel.
*/

#include <DecodeSBus.h>
#include <SBusBoard.h>
#include <elapsedMillis.h>

DecodeSBus24 dSBus(SBUS_UART);  // this board's port, on most boards Serial1: extras/docs/boards.md

const int FIRST = 1;                       // the first channel on the line, 1..24
const unsigned long PERIOD_DISPLAY = 200;  // ms

uint16_t channels[24];
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
    for (int i = FIRST; i < 24; i++) {
      Serial.print(channels[i - 1]);
      Serial.print(',');
    }
    Serial.println(channels[23]);
  }
}
