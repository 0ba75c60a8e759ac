/// @file
/// An ESP32's task of esp_timer, which polls for an SBus2Sensor and for DecodeSBusBackground.
// SlotTimer.h includes this.
#pragma once

#include <esp_timer.h>
#include <freertos/FreeRTOS.h>
#include <freertos/semphr.h>

#include "../../sbus2/FifoWatch.h"

namespace sbus {

// Keeps the task from polling, while it exists. The task is on another core than loop(), which waits for it: an
// SBus2Sensor's up to 1.5 ms while a frame's end is expected.
class TaskLock {
 public:
  TaskLock() : _held(mutex) {
    if (_held != nullptr) {
      xSemaphoreTake(_held, portMAX_DELAY);
    }
  }
  ~TaskLock() {
    if (_held != nullptr) {
      xSemaphoreGive(_held);
    }
  }
  TaskLock(const TaskLock &) = delete;
  TaskLock &operator=(const TaskLock &) = delete;

  static SemaphoreHandle_t mutex;  // null: no timer has started yet

 private:
  const SemaphoreHandle_t _held;
};

// ESP32 (arduino-esp32 2.0 and later): a one-shot of esp_timer. Its task polls the port and watches the UART's FIFO,
// often while a frame's end is expected. Tasks of a higher priority (WiFi) and writes to flash delay that task, and
// cost answers. A second sensor does not answer.
class SlotTimer : public NoSlotTimer {
 public:
  using Lock = TaskLock;
  using OtherCoreLock = Lock;

  // No interrupt, and no write to flash, comes between a look at the clock and the start bit; but the cache may lack
  // what lies in flash. So send() looks once more, and the time of the start is the latest that it allows.
  class CriticalSection {
   public:
    CriticalSection() { portENTER_CRITICAL(&_lock); }
    ~CriticalSection() { portEXIT_CRITICAL(&_lock); }
    CriticalSection(const CriticalSection &) = delete;
    CriticalSection &operator=(const CriticalSection &) = delete;
    uint32_t start(uint32_t planned) const {
      _looked = clock();
      const uint32_t latest = _looked + SendMax;
      return static_cast<int32_t>(latest - planned) > 0 ? latest : planned;
    }
  };

  using NoSlotTimer::start;
  static bool start(HardwareSerial &port, void (*due)(void *), void *context);
  static void stop(void *context);
  static void callIn(uint32_t us);
  static int waiting(Port &);
  static bool isLineIdle(Port &port, int waiting);
  static bool send(const uint8_t *characters, size_t size);

  static void polled(unsigned found, uint32_t by);
  static FrameEnd endOf(bool isTimed, ReceiveNotice, unsigned found, uint32_t, uint32_t by) {
    return isTimed && found != 0 ? _watch.end() : FifoWatch::unknown(by);
  }

 private:
  static constexpr uint32_t SendMax = 30;  // us
  static uint32_t clock() { return static_cast<uint32_t>(esp_timer_get_time()); }

  static portMUX_TYPE _lock;
  static uint32_t _looked;
  static FifoWatch _watch;
};

}  // namespace sbus
