/// @file
/// The Ticker of an ESP32 (arduino-esp32 2.0 and later): a one-shot of esp_timer. Its task polls. Tasks of a higher
/// priority (WiFi) and writes to flash hold it up.
#pragma once

#include <Arduino.h>
#include <freertos/FreeRTOS.h>
#include <freertos/semphr.h>

namespace sbus {

class Ticker : public AnyTicker {
 public:
  // The task is on another core than loop(): loop() waits for it. The task, which others also need, never blocks on
  // loop(): it sets wasDue instead.
  class Change {
   public:
    explicit Change(TickType_t most = portMAX_DELAY)
        : _taken(_mutex != nullptr && xSemaphoreTake(_mutex, most) == pdTRUE) {}
    ~Change() {
      if (_taken) {
        xSemaphoreGive(_mutex);
      }
    }
    Change(const Change &) = delete;
    Change &operator=(const Change &) = delete;
    bool isTaken() const { return _taken; }

   private:
    const bool _taken;
  };

  static bool start();
  static void stop();

  static volatile bool wasDue;

 private:
  static SemaphoreHandle_t _mutex;
};

}  // namespace sbus
