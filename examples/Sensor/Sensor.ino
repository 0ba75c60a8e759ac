/*
  Sensor: a board measures two voltages, and a Futaba radio shows them as volts and amperes.

  Needs a Futaba receiver with S.BUS2 (R7008SB and others) in a mode that has telemetry: FASSTest 14CH or 18CH, T-FHSS.
  On the radio choose these sensors and slots by hand: SBS-01V in slot 6, CURR-F1678 (or SBS-01C) in slot 24. It was
  tried only on simulated receivers, not on a Futaba: tell us (extras/docs/answering.md).

  Wiring (Tlera Grasshopper, Futaba R7008SB):
    S.BUS2 -> D0 (RX1)
    D1 (TX1) -> diode (1N4148), its ring to S.BUS2
    +      -> VIN
    -      -> GND
    the battery, divided by 11 (10 kOhm and 1 kOhm) -> A0
    a current sensor, 0.1 V an ampere               -> A1

  A Teensy 4 can do without diode and RX, with dSBus(Serial1, sbus::SingleWire): extras/docs/answering.md.

  Servos belong on the receiver's other outputs. Sends a line over USB once a second: slots sent and skipped since the
  start, and collisions with another sensor.
*/

#include <SBus2Sensor.h>
#include <SBusBoard.h>
#include <elapsedMillis.h>

SBus2Sensor dSBus(SBUS_UART);  // this board's port, on most boards Serial1: extras/docs/boards.md

const uint8_t PIN_VOLTAGE = A0;
#if defined(ESP8266)
const uint8_t PIN_CURRENT = A0;  // it has no other analogue pin
#elif defined(ESP32)
const uint8_t PIN_CURRENT = A3;  // a classic ESP32 has no A1
#else
const uint8_t PIN_CURRENT = A1;
#endif

const uint8_t SLOT_VOLTAGE = 6;
const uint8_t SLOT_CURRENT = 24;

const uint32_t REFERENCE = 3300;     // mV, what analogRead() takes for FULL_SCALE
const uint32_t FULL_SCALE = 1023;    // ESP32: 4095
const uint32_t DIVIDER = 11;         // for the battery's voltage
const uint32_t MV_PER_AMPERE = 100;  // for the current sensor

const unsigned long PERIOD_MEASURE = 100;   // ms
const unsigned long PERIOD_DISPLAY = 1000;  // ms

elapsedMillis timerMeasure;
elapsedMillis timerDisplay;

uint32_t charge = 0;  // mA * 100 ms

// Returns the voltage at `pin`, mV.
uint32_t millivolts(uint8_t pin) { return static_cast<uint32_t>(analogRead(pin)) * REFERENCE / FULL_SCALE; }

void measure() {
  const uint32_t battery = millivolts(PIN_VOLTAGE) * DIVIDER;               // mV
  const uint32_t current = millivolts(PIN_CURRENT) * 1000 / MV_PER_AMPERE;  // mA
  charge += current;

  sbus::VoltageSbs01V volts;
  volts.batteryDecivolts = 0;
  volts.externalDecivolts = static_cast<uint16_t>(battery / 100);
  dSBus.writeSensor(SLOT_VOLTAGE, volts);

  sbus::CurrentF1678 amperes;
  amperes.centiamperes = static_cast<int16_t>(current / 10);
  amperes.centivolts = static_cast<uint16_t>(battery / 10);
  amperes.milliampereHours = static_cast<uint16_t>(charge / 36000);
  dSBus.writeSensor(SLOT_CURRENT, amperes);
}

void setup() {
  Serial.begin(115200);
  dSBus.begin();
}

// Without Serial.print() this takes some microseconds: boards without a timer for the slots need a call every 75 us.
void loop() {
  dSBus.parseSBusFrame();
  if (timerMeasure >= PERIOD_MEASURE) {
    timerMeasure = 0;
    measure();
  }
  if (timerDisplay >= PERIOD_DISPLAY) {
    timerDisplay = 0;
    Serial.print("sent:");
    Serial.print(dSBus.sentSlots());
    Serial.print(",skipped:");
    Serial.print(dSBus.skippedSlots());
    Serial.print(",collisions:");
    Serial.println(dSBus.collisions());
  }
}
