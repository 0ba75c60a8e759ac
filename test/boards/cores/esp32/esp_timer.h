// github.com/espressif/esp-idf 024e201: components/esp_timer/include/esp_timer.h, as far as the library calls it.
#pragma once

#include <stdint.h>

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
