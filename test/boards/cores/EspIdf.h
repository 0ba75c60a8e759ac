// github.com/espressif/esp-idf, as far as the library calls it: 024e201, components/esp_timer/include/esp_timer.h, and
// 01b912a, components/hal/esp32/include/hal/uart_ll.h. build.mk gives it the names of all these headers.
#pragma once

#include <stdint.h>

#include "Uart.h"

#define IRAM_ATTR

using esp_err_t = int;
#define ESP_OK 0
#define ESP_ERR_INVALID_STATE 0x103

struct esp_timer;
using esp_timer_handle_t = esp_timer *;
using esp_timer_cb_t = void (*)(void *context);
enum esp_timer_dispatch_t { ESP_TIMER_TASK };
struct esp_timer_create_args_t {
  esp_timer_cb_t callback;
  void *arg;
  esp_timer_dispatch_t dispatch_method;
  const char *name;
  bool skip_unhandled_events;
};

esp_err_t esp_timer_create(const esp_timer_create_args_t *settings, esp_timer_handle_t *timer);
esp_err_t esp_timer_start_once(esp_timer_handle_t timer, uint64_t us);
int64_t esp_timer_get_time();

#define portMAX_DELAY 0xffffffffu

struct portMUX_TYPE {
  unsigned taken;
};
#define portMUX_INITIALIZER_UNLOCKED \
  { 0 }
#define portENTER_CRITICAL(lock) sim::enterCritical(lock)
#define portEXIT_CRITICAL(lock) sim::exitCritical(lock)

namespace sim {
void enterCritical(portMUX_TYPE *lock);
void exitCritical(portMUX_TYPE *lock);
}  // namespace sim

struct StaticSemaphore_t {
  bool made, inTask, inLoop;
};
using SemaphoreHandle_t = StaticSemaphore_t *;

SemaphoreHandle_t xSemaphoreCreateMutexStatic(StaticSemaphore_t *memory);
int xSemaphoreTake(SemaphoreHandle_t mutex, uint32_t ticks);
int xSemaphoreGive(SemaphoreHandle_t mutex);

using uart_dev_t = sim::Uart;
#define UART_LL_GET_HW(number) sim::uartOf(number)

namespace sim {
Uart *uartOf(int number);
}

uint32_t uart_ll_get_rxfifo_len(uart_dev_t *hw);
bool uart_ll_is_tx_idle(uart_dev_t *hw);
void uart_ll_write_txfifo(uart_dev_t *hw, const uint8_t *bytes, uint32_t size);
