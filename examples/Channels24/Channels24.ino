/*
  Channels24: all 24 channels of an FrSky receiver on a line.

  Set the receiver to 24 channels on the radio: in ETHOS "SBUS 24", not "SBUS 16"; in EdgeTX switch "SBUS24" on in the
  receiver's options. Receivers of the series ACCESS and TD can do it. No numbers? The example Diagnose says why.

  Wiring (Tlera Grasshopper, FrSky ACCESS or TD receiver):
    SBUS OUT -> D0 (RX1)
    +5V      -> VIN
    GND      -> GND

  Sends a line "CH1,CH2, ... CH23,CH24" over USB five times a second, each 0..2047. Read it with the Serial Monitor, a
  file or a spreadsheet. As curves, the Serial Plotter of the Arduino IDE shows the first 8 and Serial Oscilloscope the
  first 9: to see others, set FIRST to the number of the first channel.
*/

#include <DecodeSBus.h>
#include <SBusUart.h>
#include <elapsedMillis.h>

DecodeSBus24 dSBus(SBUS_UART);  // the port of this board, Serial1 of most: extras/docs/boards.md

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
