// The task of esp_timer on core 0, beside a loop() on core 1: World's alarm. It waits for what loop() has locked. (The
// opposite does not occur here: while the task runs, loop() stands still.)
#include <Arduino.h>
#include <esp_timer.h>
#include <freertos/semphr.h>
#include <hal/uart_ll.h>

#include "World.h"

using sim::world;

struct esp_timer {
  esp_timer_create_args_t settings;
};

namespace {

constexpr uint64_t LookUs = 1;
esp_timer only;

}  // namespace

esp_err_t esp_timer_create(const esp_timer_create_args_t *settings, esp_timer_handle_t *timer) {
  only.settings = *settings;
  *timer = &only;
  return ESP_OK;
}

// esp_timer.c:222 and 438: an armed timer stays as it is. The interrupt wakes a task, and both take time.
esp_err_t esp_timer_start_once(esp_timer_handle_t timer, uint64_t us) {
  if (world.alarmAtUs != sim::World::Never) {
    return ESP_ERR_INVALID_STATE;
  }
  world.crashes += timer != &only;
  world.alarmAtUs = world.nowUs + us + 5 + world.upTo(10);
  world.alarm = [] { only.settings.callback(only.settings.arg); };
  return ESP_OK;
}

int64_t esp_timer_get_time() {
  world.pass(LookUs);
  return static_cast<int64_t>(world.nowUs);
}

void sim::enterCritical(portMUX_TYPE *lock) {
  world.crashes += lock->taken++;
  world.masked++;
}

void sim::exitCritical(portMUX_TYPE *lock) {
  lock->taken--;
  world.masked--;
}

SemaphoreHandle_t xSemaphoreCreateMutexStatic(StaticSemaphore_t *memory) {
  *memory = {true, false, false};
  return memory;
}

// The mutex is not recursive, and nothing may wait for it without interrupts.
int xSemaphoreTake(SemaphoreHandle_t mutex, uint32_t ticks) {
  if (ticks == 0 && (mutex->inTask || mutex->inLoop)) {
    return 0;
  }
  world.crashes += !mutex->made || world.masked != 0 || mutex->inTask || mutex->inLoop;
  (world.inAlarm ? mutex->inTask : mutex->inLoop) = true;
  world.locked++;
  world.locks++;
  return 1;
}

int xSemaphoreGive(SemaphoreHandle_t mutex) {
  bool &isTaken = world.inAlarm ? mutex->inTask : mutex->inLoop;
  world.crashes += !isTaken;
  isTaken = false;
  world.locked--;
  return 1;
}

sim::Uart *sim::uartOf(int number) { return &(number == 2 ? Serial2 : Serial1).uart; }

// uart_ll.h:285: the count and the two pointers are read one after the other. If the driver empties the FIFO between
// them, it seems to hold 128.
uint32_t uart_ll_get_rxfifo_len(uart_dev_t *hw) {
  const unsigned before = hw->fifo();
  world.pass(LookUs);
  const unsigned after = hw->fifo();
  return before != 0 && after == 0 ? 128 : after;
}

// Code of the caller that is in flash may wait for the cache, though no interrupt comes.
bool uart_ll_is_tx_idle(uart_dev_t *hw) {
  world.nowUs += world.upTo(world.upTo(world.cacheUs));
  return hw->pending() == 0;
}

void uart_ll_write_txfifo(uart_dev_t *hw, const uint8_t *bytes, uint32_t size) {
  world.pass(LookUs);
  for (uint32_t i = 0; i < size; i++) {
    hw->write(bytes[i]);
  }
}
