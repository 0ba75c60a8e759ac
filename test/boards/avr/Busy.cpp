// A sketch that answers in eleven slots while loop() writes one of them, again and again. (No .ino, as Background.cpp.)
// Sends every second
//   frames,resyncs,rejected,collisions,skipped,restored,decivolts
// The first five count from the beginning; restored: 1 if end() has restored timer 4.
// A tone() sounds meanwhile, on timer 2.

#include <Arduino.h>
#include <SBus2Sensor.h>
#include <elapsedMillis.h>

namespace {

const unsigned long PERIOD_DISPLAY = 1000;  // ms
const unsigned long WORK = 3;               // ms

elapsedMillis timerDisplay;
SBus2Sensor dSBus(Serial1);
const sbus::CurrentF1678 current = {2345, 1234, 1500};
bool isRestored;

bool endRestoresTimer4() {
  const uint8_t modeA = TCCR4A, modeB = TCCR4B, mask = TIMSK4;
  dSBus.begin();
  const bool isTaken = TCCR4A != modeA && TIMSK4 != mask;
  dSBus.end();
  return isTaken && TCCR4A == modeA && TCCR4B == modeB && TIMSK4 == mask;
}

}  // namespace

void setup() {
  Serial.begin(115200);
  isRestored = endRestoresTimer4();
  tone(LED_BUILTIN, 1000);
  dSBus.begin();
  const sbus::GpsF1675 gps = {50, true, 100, 45296, 25, 31512499, 8045658};
  dSBus.writeSensor(8, gps);
}

void loop() {
  for (elapsedMillis work; work < WORK;) {
    dSBus.writeSensor(24, current);
  }
  uint16_t channels[18];
  bool failsafe, lostFrame;
  dSBus.decodeSBusFrame(channels, failsafe, lostFrame);
  if (timerDisplay >= PERIOD_DISPLAY) {
    timerDisplay = 0;
    const sbus::Counters counters = dSBus.counters();
    sbus::ReceiverVoltage voltage = {};
    dSBus.readSensor(0, voltage);
    const uint32_t numbers[] = {counters.frames,    counters.resyncs,     dSBus.rejectedGroups(),
                                dSBus.collisions(), dSBus.skippedSlots(), isRestored};
    for (const uint32_t number : numbers) {
      Serial.print(number);
      Serial.print(',');
    }
    Serial.println(voltage.decivolts);
  }
}
