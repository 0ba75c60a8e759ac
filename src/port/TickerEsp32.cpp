#include "Ticker.h"

#if defined(SBUS_ESP32)

#include <esp_timer.h>

namespace sbus {

namespace {

constexpr uint32_t Period = 1000;  // us

StaticSemaphore_t mutexMemory;
esp_timer_handle_t timer = nullptr;
volatile bool isRunning = false;

void elapsed(void *) {
  if (!isRunning) {
    return;
  }
  const Ticker::Change lock(0);
  if (lock.isTaken()) {
    PolledByTimer::tickAll();
  } else {
    Ticker::wasDue = true;
  }
  esp_timer_start_once(timer, Period);
}

}  // namespace

SemaphoreHandle_t Ticker::_mutex = nullptr;
volatile bool Ticker::wasDue = false;

bool Ticker::start() {
  if (timer == nullptr) {
    esp_timer_create_args_t settings = {};
    settings.callback = elapsed;
    settings.name = "DecodeSBus";
    if (esp_timer_create(&settings, &timer) != ESP_OK) {
      return false;
    }
    _mutex = xSemaphoreCreateMutexStatic(&mutexMemory);
  }
  if (!isRunning) {
    isRunning = true;
    esp_timer_start_once(timer, Period);  // fails if one from before stop() is still to come
  }
  return true;
}

// One that is still to come finds the list empty.
void Ticker::stop() {
  isRunning = false;
}

}  // namespace sbus

#endif
