// A sketch that listens in the background, whatever its loop() does. (It is no .ino, so that tools that look for
// sketches find the examples only.) Servos at the pins 2 to 5 have a pulse of 1500 us. Each time that loop() was busy,
// in turn in delay() and with calls of the decoder's methods, it sends
//   frames,discarded,torn,CH1..CH16
// torn: counters() that were of two moments, since more failsafe frames had come than frames;
// and at last how often loop() could go round in a second: while it listened, and while the port was merely open
//   spins,spins

#include <Arduino.h>
#include <DecodeSBusBackground.h>
#include <Servo.h>

namespace {

const unsigned SHORTEST = 1, LONGEST = 20, BLOCKED = 500;  // ms
const unsigned long LAST = 15000;                          // ms

DecodeSBusBackground dSBus(Serial1);
Servo servos[4];
unsigned long spins = 0;  // while it listens
unsigned busy = 0;        // ms
bool calls = false;
sbus::Counters last = {};
unsigned torn = 0;

void look() {
  const sbus::Counters counters = dSBus.counters();
  torn += counters.failsafeFrames - last.failsafeFrames > counters.frames - last.frames;
  last = counters;
}

unsigned long spinsInASecond() {
  volatile unsigned long count = 0;
  for (const unsigned long start = millis(); millis() - start < 1000;) {
    count = count + 1;
  }
  return count;
}

}  // namespace

void setup() {
  Serial.begin(115200);
  for (int i = 0; i < 4; i++) {
    servos[i].attach(2 + i);
    servos[i].writeMicroseconds(1500);
  }
  dSBus.begin();
  delay(100);
  spins = spinsInASecond();
}

void loop() {
  busy = busy == BLOCKED ? SHORTEST : busy < LONGEST ? busy + 1 : BLOCKED;
  calls = !calls;
  if (calls) {
    for (const unsigned long start = millis(); millis() - start < busy;) {
      dSBus.newFrame();
      dSBus.linkState();
      dSBus.setLossLimit(100);
      for (int i = 0; i < 8; i++) {
        look();
      }
    }
  } else {
    delay(busy);
  }
  uint16_t channels[18] = {};
  bool failsafe, lostFrame;
  sbus::Counters before, counters = dSBus.counters();
  do {
    before = counters;
    dSBus.decodeSBusFrame(channels, failsafe, lostFrame);
    counters = dSBus.counters();
  } while (counters.frames != before.frames);
  Serial.print(counters.frames);
  Serial.print(',');
  Serial.print(counters.discardedBytes);
  Serial.print(',');
  Serial.print(torn);
  for (int i = 0; i < 16; i++) {
    Serial.print(',');
    Serial.print(channels[i]);
  }
  Serial.println();
  Serial.flush();
  if (millis() > LAST) {
    dSBus.end();
    Serial1.begin(100000, SERIAL_8E2);
    Serial.print(spins);
    Serial.print(',');
    Serial.println(spinsInASecond());
    delay(100000);
  }
}
