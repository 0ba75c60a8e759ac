/*
  Diagnose: no frames, or bad ones? Says what is wrong with the line, and the cure.

  Wiring (Tlera Grasshopper, FrSky R-XSR):
    R-XSR S-BUS_OUT -> D0 (RX1)
    R-XSR +5V       -> 5V
    R-XSR GND       -> GND

  Opens the port in every way that a receiver may need, half a second each, prints over USB what came, then the verdict,
  and begins again. Switch the radio on and open the Serial Monitor. A board whose core has no SERIAL_SBUS needs an
  inverter in the signal wire, see README.md.
*/

#include <DecodeSBus.h>

struct Setting {
  unsigned long baud;
  uint32_t config;
  const char *text;
};

const Setting SETTINGS[] = {  // the first is what dSBus.begin() opens
#if defined(SERIAL_SBUS)
  {100000, SERIAL_SBUS, "begin(100000, SERIAL_SBUS)"},
  {200000, SERIAL_SBUS, "begin(200000, SERIAL_SBUS)"},
#endif
  {100000, SERIAL_8E2, "begin(100000, SERIAL_8E2)"},
  {200000, SERIAL_8E2, "begin(200000, SERIAL_8E2)"},
};
const uint8_t SETTING_COUNT = sizeof SETTINGS / sizeof SETTINGS[0];
const uint32_t TRIAL = 500;      // ms
const uint32_t FRAMES_MIN = 5;   // in a trial; the slowest receiver known, ELRS at 25 Hz, sends 12
const uint32_t REFUSED_MAX = 3;  // in a trial; until the true header is found, a 0F of the payload is taken for one

DecodeSBus dSBus(Serial1);
uint8_t best;           // the setting with the most frames,
sbus::Counters seen;    // what came with it,
sbus::LinkState state;  // and the link's state at its end
bool anyByte;           // something came, with whatever setting

uint32_t refused(const sbus::Counters &counters) {
  return counters.refusedByEnd + counters.refusedByFlags + counters.refusedByExtra;
}

void print(uint32_t number, const char *text) {
  Serial.print(number);
  Serial.print(text);
}

void tryOut(uint8_t index) {
  const Setting &setting = SETTINGS[index];
  dSBus.end();
  dSBus.begin(setting.baud, setting.config);
  const uint32_t start = millis();
  while (static_cast<uint32_t>(millis()) - start < TRIAL) {
    dSBus.parseSBusFrame();
  }
  const sbus::Counters counters = dSBus.counters();
  const bool any = counters.frames != 0 || counters.skippedBytes != 0;
  anyByte = any || (anyByte && index != 0);
  if (index == 0 || counters.frames > seen.frames) {
    best = index;
    seen = counters;
    state = dSBus.linkState();
  }
  Serial.print(setting.text);
  Serial.print(": ");
  print(counters.frames, " frames, ");
  print(refused(counters), " refused, ");
  print(counters.skippedBytes, " bytes of no frame");
  Serial.println();
}

// A character with a wrong parity or stop bit does not count as a byte: the port drops it without a word. What shows is
// that the frame it belonged to is refused.
void verdict() {
  if (!anyByte) {
    Serial.println("NO SIGNAL: not a byte in any setting. Check the signal wire and its pin, and the receiver: is it");
    Serial.println("powered, bound, and its port set to S.Bus, not to CPPM?");
    return;
  }
  if (seen.frames < FRAMES_MIN) {
    Serial.println("NOISE: bytes come, but few frames or none. Connect the grounds, check the supply, shorten the");
    Serial.println("wire. If that does not help: is the port set to S.Bus? Is an inverter missing, or one too many?");
    return;
  }
  if (SETTINGS[best].config != SETTINGS[0].config) {
    Serial.println("WRONG INVERSION: the line is an uninverted pad's, or there is an inverter in it.");
  }
  if (SETTINGS[best].baud != SETTINGS[0].baud) {
    Serial.println("WRONG BAUD RATE: this is Fast S.Bus.");
  }
  if (best != 0) {
    Serial.print("Open the port with dSBus.");
    Serial.println(SETTINGS[best].text);
  }
  if (refused(seen) > REFUSED_MAX) {
    Serial.println("NOISE: frames are damaged. Connect the grounds, check the supply, shorten the wire.");
  } else if (state == sbus::LinkState::Failsafe || seen.lostFrames > seen.frames / 2) {
    Serial.println("NO RADIO: the receiver is well, but hears nothing. Switch the radio on, or bind them.");
  } else if (seen.lostFrames > seen.frames / 10) {
    Serial.println("LOSSY: the receiver is well, but misses radio frames. Check the distance and the aerials.");
  } else {
    Serial.println("ALL WELL.");
  }
  print(seen.frames * 1000 / TRIAL, " frames a second, ");
  print(seen.period, " us from one to the next; ");
  print(seen.lostFrames * 100 / seen.frames, " % with the lost-frame flag");
  Serial.println();
}

void setup() {
  Serial.begin(115200);
}

void loop() {
  static uint8_t next = 0;
  tryOut(next++);
  if (next == SETTING_COUNT) {
    next = 0;
    verdict();
    delay(1000);
  }
}
