#pragma once

#include "FreeRTOS.h"

struct StaticSemaphore_t {
  bool made, inTask, inLoop;
};
using SemaphoreHandle_t = StaticSemaphore_t *;

SemaphoreHandle_t xSemaphoreCreateMutexStatic(StaticSemaphore_t *memory);
int xSemaphoreTake(SemaphoreHandle_t mutex, uint32_t ticks);
int xSemaphoreGive(SemaphoreHandle_t mutex);
