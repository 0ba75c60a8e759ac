// FreeRTOS as ESP-IDF has it (v5.1, components/freertos/FreeRTOS-Kernel), which arduino-esp32's Arduino.h brings in.
// What fails there with configASSERT() counts as a crash.
#pragma once

#include <stddef.h>
#include <stdint.h>

typedef int BaseType_t;
typedef unsigned UBaseType_t;
typedef uint32_t TickType_t;
typedef void (*TaskFunction_t)(void *);
typedef struct Task *TaskHandle_t;
typedef struct Queue *QueueHandle_t;

constexpr BaseType_t pdFALSE = 0, pdTRUE = 1, pdPASS = 1;
constexpr UBaseType_t configMAX_PRIORITIES = 25;
constexpr uint32_t configTICK_RATE_HZ = 1000;  // arduino-esp32's; ESP-IDF's own default is 100
constexpr TickType_t pdMS_TO_TICKS(uint32_t ms) {
  return static_cast<TickType_t>(uint64_t{ms} * configTICK_RATE_HZ / 1000);
}

BaseType_t xTaskCreatePinnedToCore(TaskFunction_t function, const char *name, uint32_t stackBytes, void *parameter,
                                   UBaseType_t priority, TaskHandle_t *task, BaseType_t core);
void vTaskDelay(TickType_t ticks);
void vTaskDelete(TaskHandle_t task);
BaseType_t xPortGetCoreID();

QueueHandle_t xQueueCreate(UBaseType_t length, UBaseType_t size);
BaseType_t xQueueOverwrite(QueueHandle_t queue, const void *item);
BaseType_t xQueueReceive(QueueHandle_t queue, void *item, TickType_t ticks);
