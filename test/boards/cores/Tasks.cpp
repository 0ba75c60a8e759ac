#include "Tasks.h"

#include <ucontext.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

#include "World.h"
#include "core/FreeRtos.h"

void setup();
void loop();

struct Queue {
  size_t length, size;
  std::vector<std::vector<uint8_t>> items;
};

struct Task {
  TaskFunction_t function;
  void *parameter;
  UBaseType_t priority;
  BaseType_t core;
  uint64_t wakeUs = 0;
  QueueHandle_t queue = nullptr;  // that it waits for
  bool isDeleted = false;
  uint64_t turn = 0;
  ucontext_t context = {};
  std::vector<char> stack = std::vector<char>(256 * 1024);  // what it needs on a PC says nothing about an ESP32
};

namespace sim {

namespace {

Chip chip;

constexpr uint64_t TickUs = 1000000 / configTICK_RATE_HZ;
constexpr uint64_t TurnUs = 20;           // the time that a task takes from one wait to the next
constexpr uint64_t WatchdogUs = 5000000;  // CONFIG_ESP_TASK_WDT_TIMEOUT_S, of core 0's idle task
constexpr uint32_t LeastStack = 768;      // bytes: CONFIG_FREERTOS_IDLE_TASK_STACKSIZE
constexpr UBaseType_t LoopPriority = 1;   // arduino-esp32, cores/esp32/main.cpp

std::vector<std::unique_ptr<Task>> tasks;
std::vector<std::unique_ptr<Queue>> queues;
Task *running = nullptr;
ucontext_t scheduler;
uint64_t turns = 0;

// configASSERT(): a failed assertion does not continue.
void check(bool holds) {
  world.crashes += holds ? 0 : 1;
  if (!holds && running != nullptr) {
    running->isDeleted = true;
    swapcontext(&running->context, &scheduler);
  }
}

bool isReady(const Task &task) {
  return !task.isDeleted && (task.wakeUs <= world.nowUs || (task.queue != nullptr && !task.queue->items.empty()));
}

// Lets other tasks run.
void wait(uint64_t untilUs, QueueHandle_t queue = nullptr) {
  running->wakeUs = untilUs;
  running->queue = queue;
  running->turn = ++turns;
  swapcontext(&running->context, &scheduler);
  running->queue = nullptr;
}

// Returns the time of the tick interrupt `ticks` from now.
uint64_t tickUs(TickType_t ticks) {
  return (world.nowUs / TickUs + ticks) * TickUs;
}

// A task must not return: prvTaskExitError() (portable/xtensa/port.c).
void enter() {
  running->function(running->parameter);
  check(false);
}

void loopTask(void *) {
  setup();
  for (;;) {
    loop();
    wait(world.nowUs);
  }
}

// Returns the ready task of the highest priority; of several, the one that waits longest.
Task *next() {
  Task *best = nullptr;
  for (const auto &task : tasks) {
    if (isReady(*task) && (best == nullptr || task->priority > best->priority ||
                           (task->priority == best->priority && task->turn < best->turn))) {
      best = task.get();
    }
  }
  return best;
}

}  // namespace

void startTasks(const Chip &newChip) {
  chip = newChip;
  tasks.clear();
  queues.clear();
  running = nullptr;
  xTaskCreatePinnedToCore(loopTask, "loopTask", 8192, nullptr, LoopPriority, nullptr,
                          static_cast<BaseType_t>(chip.cores) - 1);
}

// Both cores' tasks run in turn, as if on one: a sketch must not rely on more.
void runTasks(uint64_t us) {
  uint64_t idleUs = world.nowUs;
  for (const uint64_t endUs = world.nowUs + us; world.nowUs < endUs;) {
    running = next();
    if (running == nullptr) {
      uint64_t wakeUs = endUs;
      for (const auto &task : tasks) {
        wakeUs = task->isDeleted ? wakeUs : std::min(wakeUs, task->wakeUs);
      }
      world.nowUs = std::max(wakeUs, world.nowUs + 1);
      idleUs = world.nowUs;
      continue;
    }
    swapcontext(&scheduler, &running->context);
    world.nowUs += TurnUs;
    world.crashes += world.nowUs - idleUs >= WatchdogUs;
  }
}

}  // namespace sim

using sim::check;
using sim::world;

// tasks.c: prvInitialiseNewTask() asserts the priority; esp_additions/freertos_tasks_c_additions.h:
// xTaskCreatePinnedToCore() the core, and takes the stack in bytes.
BaseType_t xTaskCreatePinnedToCore(TaskFunction_t function, const char *, uint32_t stackBytes, void *parameter,
                                   UBaseType_t priority, TaskHandle_t *task, BaseType_t core) {
  check(core >= 0 && core < static_cast<BaseType_t>(sim::chip.cores));
  check(priority < configMAX_PRIORITIES);
  check(stackBytes >= sim::LeastStack);
  if (sim::tasks.size() >= sim::chip.mostTasks) {
    return -1;  // errCOULD_NOT_ALLOCATE_REQUIRED_MEMORY
  }
  sim::tasks.emplace_back(new Task());
  Task &made = *sim::tasks.back();
  made.function = function;
  made.parameter = parameter;
  made.priority = priority;
  made.core = core;
  made.wakeUs = world.nowUs;
  getcontext(&made.context);
  made.context.uc_stack.ss_sp = made.stack.data();
  made.context.uc_stack.ss_size = made.stack.size();
  made.context.uc_link = nullptr;
  makecontext(&made.context, sim::enter, 0);
  if (task != nullptr) {
    *task = &made;
  }
  if (sim::running != nullptr && priority > sim::running->priority) {
    sim::wait(world.nowUs);  // it runs at once
  }
  return pdPASS;
}

// 0 lets tasks of the same priority run, and none below (tasks.c, vTaskDelay()).
void vTaskDelay(TickType_t ticks) {
  sim::wait(ticks == 0 ? world.nowUs : sim::tickUs(ticks));
}

void vTaskDelete(TaskHandle_t task) {
  Task *const deleted = task == nullptr ? sim::running : task;
  deleted->isDeleted = true;
  if (deleted == sim::running) {
    sim::wait(0);
  }
}

BaseType_t xPortGetCoreID() {
  return sim::running->core;
}

QueueHandle_t xQueueCreate(UBaseType_t length, UBaseType_t size) {
  check(length > 0);
  sim::queues.emplace_back(new Queue{length, size, {}});
  return sim::queues.back().get();
}

// queue.c, xQueueGenericSend(): asserts a queue, and that it has one place. A task that waits and has a higher priority
// runs at once.
BaseType_t xQueueOverwrite(QueueHandle_t queue, const void *item) {
  check(queue != nullptr && queue->length == 1);
  const uint8_t *const bytes = static_cast<const uint8_t *>(item);
  queue->items.assign(1, std::vector<uint8_t>(bytes, bytes + queue->size));
  for (const auto &task : sim::tasks) {
    if (task->queue == queue && task->priority > sim::running->priority) {
      sim::wait(world.nowUs);
      break;
    }
  }
  return pdPASS;
}

BaseType_t xQueueReceive(QueueHandle_t queue, void *item, TickType_t ticks) {
  check(queue != nullptr);
  if (queue->items.empty() && ticks != 0) {
    sim::wait(sim::tickUs(ticks), queue);
  }
  if (queue->items.empty()) {
    return pdFALSE;
  }
  std::memcpy(item, queue->items.front().data(), queue->size);
  queue->items.erase(queue->items.begin());
  return pdTRUE;
}
