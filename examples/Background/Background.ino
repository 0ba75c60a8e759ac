/*
  Background: no frame is lost, however long loop() takes.

  Wiring (Tlera Grasshopper, FrSky R-XSR):
    R-XSR S-BUS_OUT -> D0 (RX1)
    R-XSR +5V       -> VIN
    R-XSR GND       -> GND

  The port calls parseSBusFrame() itself when bytes have come, in the middle of whatever loop() does, and the newest
  frame is always at hand. Sends a line "frames,age,CH3" over USB twice a second: the frames received since the last
  line (55 or 56 from an R-XSR, one every 9 ms), the age of the newest in ms (4294967295 before the first), and the
  throttle, 0..2047.

  It needs an STM32L0: only that core calls back, at PendSV level, above loop() and below all interrupts.
*/

#include <DecodeSBus.h>

#if !defined(SERIAL_SBUS)
#error "Background needs Serial1.onReceive() as only the STM32L0 core has it. Elsewhere keep loop() short instead."
#endif

DecodeSBus dSBus(Serial1);  // RX: D0

const unsigned long WORK = 500;  // ms

uint16_t channels[18];
bool failsafe;
bool lostFrame;
uint32_t framesBefore = 0;

// The port calls this: loop() must not call parseSBusFrame() as well.
void received() {
  dSBus.parseSBusFrame();
}

void setup() {
  Serial.begin(115200);
  dSBus.begin();
  Serial1.onReceive(received);  // at once: the port reports new bytes only when the last ones have been read
}

void loop() {
  delay(WORK);  // stands for slow work: a display, a file, a sensor

  const uint32_t frames = dSBus.counters().frames;
  dSBus.decodeSBusFrame(channels, failsafe, lostFrame);
  Serial.print(frames - framesBefore);
  Serial.print(',');
  Serial.print(dSBus.frameAge());
  Serial.print(',');
  Serial.println(channels[2]);
  framesBefore = frames;
}
