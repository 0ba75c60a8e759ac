// ESP-IDF's timers (components/esp_timer/include/esp_timer.h), as far as an example calls them.
#pragma once

#include <stdint.h>

typedef struct esp_timer *esp_timer_handle_t;
struct esp_timer_create_args_t {
  void (*callback)(void *);
  void *arg;
  int dispatch_method;
  const char *name;
  bool skip_unhandled_events;
};
int esp_timer_create(const esp_timer_create_args_t *settings, esp_timer_handle_t *timer);
int esp_timer_start_once(esp_timer_handle_t timer, uint64_t us);
