/*
  Diagnose: no frames, or wrong ones? It finds the line's fault and the remedy.

  Wiring (Tlera Grasshopper, FrSky R-XSR): S-BUS_OUT -> D0 (RX1), +5V -> VIN, GND -> GND

  Opens the port in every way that a receiver may need, for half a second each, prints over USB what it received and the
  verdict, and starts again. Switch the radio on and open the Serial Monitor. A port that cannot invert the line needs
  an inverter in the signal wire; it is tried only at the two baud rates.
*/

#include <DecodeSBusDiagnosis.h>
#include <SBusBoard.h>
#include <sbus/Diagnosis.h>

DecodeSBusDiagnosis dSBus(SBUS_UART);  // this board's port, on most boards Serial1: extras/docs/boards.md
auto &input = sbus::portOf(SBUS_UART);

struct Setting {
  unsigned long baud;
  uint32_t config;
  const char *text;
};

// The first is what dSBus.begin() opens.
const Setting SETTINGS[] = {
    {100000, sbus::Inverted, "begin(100000): "},
    {200000, sbus::Inverted, "begin(200000): "},
    {100000, sbus::Uninverted, "begin(100000, sbus::Uninverted): "},
    {200000, sbus::Uninverted, "begin(200000, sbus::Uninverted): "},
};
const uint8_t SETTING_COUNT = sbus::opensBothWays(input) ? 4 : 2;
const uint32_t TRIAL = 500;  // ms

sbus::Diagnosis diagnosis;

void print(uint32_t number, const char *text) {
  Serial.print(number);
  Serial.print(text);
}

void tryOut(const Setting &setting) {
  dSBus.begin(setting.baud, setting.config);
  const uint32_t start = millis();
  while (static_cast<uint32_t>(millis()) - start < TRIAL) {
    dSBus.parseSBusFrame();
  }
  const sbus::Trial trial = dSBus.trial(setting.baud, setting.config == sbus::Inverted, TRIAL);
  diagnosis.add(trial);
  Serial.print(setting.text);
  print(trial.counters.frames, " frames, ");
  print(trial.counters.discardedBytes, " discarded bytes\r\n");
}

// Prints the numbers of the setting with the most frames.
void tell() {
  const sbus::Finding finding = diagnosis.finding();
  const sbus::Counters &seen = diagnosis.seen();
  Serial.println(text(finding));
  Serial.println(remedy(finding));
  if (seen.frames != 0) {
    Serial.print("dSBus.");
    Serial.print(SETTINGS[diagnosis.best()].text);
    print(seen.frames * 1000 / TRIAL, " frames a second and ");
    print(impairedFrames(seen) * 1000 / TRIAL, " damaged, frame interval ");
    print(seen.period, " us; ");
    print(seen.lostFrames * 100 / seen.frames, " % with the lost-frame flag\r\n");
  }
}

void setup() { Serial.begin(115200); }

void loop() {
  static uint8_t next = 0;
  tryOut(SETTINGS[next++]);
  if (next == SETTING_COUNT) {
    next = 0;
    tell();
    diagnosis.begin();
    delay(1000);
  }
}
