/*
  Telemetry: prints what the receiver and a sensor of an S.BUS2 line measure.

  Needs a Futaba receiver with S.BUS2 (R7008SB and others) in a mode that has telemetry: FASSTest 14CH or 18CH, T-FHSS.
  The receiver always sends its own voltage. A sensor uses the slot that is set on the radio: set SLOT and Sensor below
  to match. It was tried on simulated receivers and recordings of real ones, not on a Futaba: tell us
  (extras/docs/telemetry.md).

  Wiring (Tlera Grasshopper, Futaba R7008SB):
    S.BUS2 -> D0 (RX1)
    +      -> VIN
    -      -> GND

  Sends a line over USB five times a second: receiver or external voltage in V, and the sensor's battery and external
  voltage in V, "-" for a value older than a second; and how often the bytes between frames were not telemetry.
*/

#include <DecodeSBusTelemetry.h>
#include <SBusBoard.h>
#include <elapsedMillis.h>

DecodeSBusTelemetry dSBus(SBUS_UART);  // this board's port, on most boards Serial1: extras/docs/boards.md

typedef sbus::VoltageSbs01V Sensor;  // others: src/sbus2/Sensors.h
const uint8_t SLOT = 1;              // its first slot, as set on the radio

const unsigned long PERIOD_DISPLAY = 200;  // ms

elapsedMillis timerDisplay;

// Prints tenths of a volt.
void print(const char *name, bool isThere, uint16_t decivolts) {
  Serial.print(name);
  if (isThere) {
    Serial.print(decivolts / 10);
    Serial.print('.');
    Serial.print(decivolts % 10);
  } else {
    Serial.print('-');
  }
}

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

  sbus::ReceiverVoltage receiver = {};
  const bool hasReceiver = dSBus.readSensor(0, receiver);
  print(receiver.isExternal ? "external:" : "receiver:", hasReceiver, receiver.decivolts);
  Sensor sensor = {};
  const bool hasSensor = dSBus.readSensor(SLOT, sensor);
  print(",battery:", hasSensor, sensor.batteryDecivolts);
  print(",pack:", hasSensor, sensor.externalDecivolts);
  Serial.print(",rejected:");
  Serial.println(dSBus.rejectedGroups());
}
