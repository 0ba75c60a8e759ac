/*
  Normalized: the first four channels of an S.Bus receiver as -1.000 ... +1.000.

  Wiring (Tlera Grasshopper, FrSky R-XSR):
    R-XSR S-BUS_OUT -> D0 (RX1)
    R-XSR +5V       -> VIN
    R-XSR GND       -> GND

  Sends a line "CH1,CH2,CH3,CH4" over USB five times a second. The formula is S. Levy's, as quoted by the paper: FrSky's
  172 becomes -1, 1811 becomes +1 (and 992, FrSky's centre, 0.001). A stick beyond its 100 % goes beyond +-1. For Futaba
  replace sbus::FrSky with sbus::Futaba below.
*/

#include <DecodeSBus.h>
#include <SBusBoard.h>
#include <elapsedMillis.h>
#include <sbus/Scaling.h>

DecodeSBus dSBus(SBUS_UART);  // this board's port, on most boards Serial1: extras/docs/boards.md

const unsigned long PERIOD_DISPLAY = 200;  // ms

uint16_t channels[18];
bool failsafe;
bool lostFrame;

elapsedMillis timerDisplay;

void setup() {
  Serial.begin(115200);
  dSBus.begin();
}

float normalized(uint16_t value) {
  return sbus::toUnit(value, sbus::FrSky);  // or sbus::Futaba, or your own {low, centre, high}
}

void loop() {
  dSBus.parseSBusFrame();
  if (timerDisplay < PERIOD_DISPLAY) {
    return;
  }
  timerDisplay = 0;

  if (dSBus.SBusFrameOk()) {
    dSBus.decodeSBusFrame(channels, failsafe, lostFrame);
    for (int i = 0; i < 3; i++) {
      Serial.print(normalized(channels[i]), 3);
      Serial.print(',');
    }
    Serial.println(normalized(channels[3]), 3);
  }
}
