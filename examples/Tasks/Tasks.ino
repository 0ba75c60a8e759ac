/*
  Tasks: one task reads the receiver, another drives the throttle, and neither waits for the other.

  Wiring (ESP32, FrSky R-XSR): S-BUS_OUT -> GPIO16, +5V -> 5V, GND -> GND. Grasshopper: S-BUS_OUT -> D0, +5V -> VIN

  On an ESP32 the reading task hands each frame over through a queue of one place, in which a new frame replaces the old
  one. The second task waits there for at most 100 ms: if no frame comes in that time, or the frame says failsafe, it
  closes the throttle. Other boards have no FreeRTOS: loop() does both in turn. Sends "throttle,failsafe" over USB five
  times a second, 0..2047 and 0 or 1. extras/docs/interrupts.md has the rules.
*/

#include <DecodeSBus.h>
#include <SBusBoard.h>
#include <elapsedMillis.h>

DecodeSBus dSBus(SBUS_UART);  // this board's port, on most boards Serial1: extras/docs/boards.md

const int THROTTLE = 2;                    // CH3, counted from 0
const uint16_t CLOSED = 172;               // Futaba: 352
const unsigned long PERIOD_DISPLAY = 200;  // ms

elapsedMillis timerDisplay;

// Takes the newest frame or, if none came in time, one with the failsafe flag.
void drive(const SBusFrame &frame) {
  const uint16_t throttle = frame.failsafe ? CLOSED : frame.channels[THROTTLE];
  if (timerDisplay >= PERIOD_DISPLAY) {
    timerDisplay = 0;
    Serial.print(throttle);
    Serial.print(',');
    Serial.println(frame.failsafe ? 1 : 0);
  }
}

#if defined(ESP32)

const unsigned long TIMEOUT = 100;        // ms
const uint32_t STACK = 4096;              // bytes, of each task
const UBaseType_t READS = 3, DRIVES = 2;  // priorities: above loop(), 1, and far below those of Wi-Fi

QueueHandle_t newest;

void readTask(void *) {
  SBusFrame frame;
  dSBus.begin();  // here: the port's interrupt then runs on this core
  for (;;) {
    if (dSBus.read(frame)) {
      xQueueOverwrite(newest, &frame);
    }
    vTaskDelay(1);  // a tick, 1 ms; 0 would never let a task below run
  }
}

void driveTask(void *) {
  for (;;) {
    SBusFrame frame;
    xQueueReceive(newest, &frame, pdMS_TO_TICKS(TIMEOUT));
    drive(frame);
  }
}

void setup() {
  Serial.begin(115200);
  const BaseType_t core = xPortGetCoreID();  // 1, away from Wi-Fi; 0 if there is only one core
  newest = xQueueCreate(1, sizeof(SBusFrame));
  if (newest == nullptr ||
      xTaskCreatePinnedToCore(driveTask, "drive", STACK, nullptr, DRIVES, nullptr, core) != pdPASS ||
      xTaskCreatePinnedToCore(readTask, "read", STACK, nullptr, READS, nullptr, core) != pdPASS) {
    Serial.println("There is no memory for queue and tasks.");
  }
}

void loop() {
  vTaskDelete(nullptr);  // the tasks do it all
}

#else

SBusFrame frame;

void setup() {
  Serial.begin(115200);
  dSBus.begin();
}

void loop() {
  dSBus.read(frame);
  drive(frame);
}

#endif
