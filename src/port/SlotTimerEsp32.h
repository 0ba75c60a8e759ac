/// @file
/// The SlotTimer of an ESP32 (arduino-esp32 2.0 and later): a one-shot of esp_timer. Its task polls the port and
/// watches the UART's FIFO, often while a frame's end is expected. Tasks of a higher priority (WiFi) and writes to
/// flash delay that task, and cost answers.
#pragma once

#include <Arduino.h>
#include <esp_timer.h>
#include <freertos/FreeRTOS.h>
#include <freertos/semphr.h>
#include <stdint.h>

#include "FifoWatch.h"

namespace sbus {

// There is only one: a second sensor does not answer.
class SlotTimer : public NoSlotTimer {
 public:
  // The task is on another core than loop(): each waits for the other, and loop() up to 1.5 ms while a frame's end is
  // expected.
  class Lock {
   public:
    Lock() : _taken(_mutex) {
      if (_taken != nullptr) {
        xSemaphoreTake(_taken, portMAX_DELAY);
      }
    }
    ~Lock() {
      if (_taken != nullptr) {
        xSemaphoreGive(_taken);
      }
    }
    Lock(const Lock &) = delete;
    Lock &operator=(const Lock &) = delete;

   private:
    const SemaphoreHandle_t _taken;
  };
  using Apart = Lock;

  // No interrupt, and no write to flash, comes between a look at the clock and the start bit; but the cache may lack
  // what lies in flash. So send() looks once more, and the time of the start is the latest that it allows.
  class Alone {
   public:
    Alone() { portENTER_CRITICAL(&_lock); }
    ~Alone() { portEXIT_CRITICAL(&_lock); }
    Alone(const Alone &) = delete;
    Alone &operator=(const Alone &) = delete;
    uint32_t start(uint32_t planned) const {
      _looked = clock();
      const uint32_t latest = _looked + LongestSend;
      return static_cast<int32_t>(latest - planned) > 0 ? latest : planned;
    }
  };

  using NoSlotTimer::start;
  static bool start(HardwareSerial &port, void (*due)(void *), void *context);
  static void stop(void *context);
  static void at(uint32_t us);
  static int waiting(Port &);
  static bool isQuiet(Port &port, int waiting);
  static bool send(const uint8_t *characters, size_t size);

  static void polled(unsigned found, uint32_t by);
  static FrameEnd endOf(bool isTimed, ReceiveNotice, unsigned found, uint32_t, uint32_t by) {
    return isTimed && found != 0 ? _watch.end() : FifoWatch::unknown(by);
  }

 private:
  static constexpr uint32_t LongestSend = 30;  // us
  static uint32_t clock() { return static_cast<uint32_t>(esp_timer_get_time()); }

  static SemaphoreHandle_t _mutex;
  static portMUX_TYPE _lock;
  static uint32_t _looked;
  static FifoWatch _watch;
};

}  // namespace sbus
