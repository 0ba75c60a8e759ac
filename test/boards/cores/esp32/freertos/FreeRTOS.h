#pragma once

#include <stdint.h>

#define portMAX_DELAY 0xffffffffu

struct portMUX_TYPE {
  unsigned taken;
};
#define portMUX_INITIALIZER_UNLOCKED {0}
#define portENTER_CRITICAL(lock) sim::enterCritical(lock)
#define portEXIT_CRITICAL(lock) sim::exitCritical(lock)

namespace sim {
void enterCritical(portMUX_TYPE *lock);
void exitCritical(portMUX_TYPE *lock);
}  // namespace sim
