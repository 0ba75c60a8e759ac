// A sketch that prints what has come over Serial1. It is no .ino, so that tools that look for sketches find the
// examples only. Sends every second
//   frames,discarded  since the beginning: frames, and bytes that belong to none
// and when SBusFrameOk() changes
//   ok,0 or 1,us      and the time, as micros() has it

#include <Arduino.h>
#include <DecodeSBus.h>
#include <elapsedMillis.h>

namespace {

const unsigned long PERIOD_DISPLAY = 1000;  // ms

elapsedMillis timerDisplay;
DecodeSBus dSBus(Serial1);
bool wasOk = false;

}  // namespace

void serialEvent1() {
  dSBus.parseSBusFrame();
}

void setup() {
  Serial.begin(115200);
  dSBus.begin();
}

void loop() {
  const bool ok = dSBus.SBusFrameOk();
  if (ok != wasOk) {
    const unsigned long now = micros();
    wasOk = ok;
    Serial.print(ok ? "ok,1," : "ok,0,");
    Serial.println(now);
  }
  if (timerDisplay >= PERIOD_DISPLAY) {
    timerDisplay = 0;
    const sbus::Counters counters = dSBus.counters();
    Serial.print(counters.frames);
    Serial.print(',');
    Serial.println(counters.discardedBytes);
  }
}
