// The example Tasks on the FreeRTOS of an ESP32: the newest frame sets the throttle, which closes when none comes.
#include <ucontext.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

#include "Cores.h"

HardwareSerial Serial1, Serial2;
Console Serial;

using namespace cores;

struct Queue {
  std::vector<uint8_t> item;
  bool isFull;
};

struct Task {
  TaskFunction_t function;
  UBaseType_t priority;
  BaseType_t core;
  uint64_t wakeUs = world.nowUs;
  QueueHandle_t queue = nullptr;  // that it waits for
  bool isDeleted = false;
  ucontext_t context = {};
  std::vector<char> stack = std::vector<char>(256 * 1024);  // what it needs on a PC says nothing about an ESP32
};

namespace {

struct Chip {
  BaseType_t cores;  // 1: ESP32-S2, C3, C6
  size_t mostTasks;  // for which there is memory
};

constexpr uint64_t Second = 1000000, TickUs = Second / configTICK_RATE_HZ;
constexpr uint64_t TurnUs = 20;              // the time that a task takes from one wait to the next
constexpr uint64_t WatchdogUs = 5 * Second;  // of the idle task: CONFIG_ESP_TASK_WDT_TIMEOUT_S
constexpr uint32_t LeastStack = 768;         // bytes: CONFIG_FREERTOS_IDLE_TASK_STACKSIZE
constexpr Chip Two = {2, 100}, One = {1, 100};

Chip chip;
std::vector<std::unique_ptr<Task>> tasks;
std::unique_ptr<Queue> queue;
Task *running = nullptr;
uint64_t idleUs;  // when no task was ready
ucontext_t scheduler;

void wait(uint64_t untilUs, QueueHandle_t waitsFor = nullptr) {
  running->wakeUs = untilUs;
  running->queue = waitsFor;
  swapcontext(&running->context, &scheduler);
}

// A task must not return: prvTaskExitError() (portable/xtensa/port.c).
void enter() {
  running->function(nullptr);
  world.crashes++;
  vTaskDelete(nullptr);
}

// Both cores' tasks run in turn, as if on one: a sketch must not rely on more.
void runTasks(uint64_t us) {
  const auto isReady = [](const Task &task) {
    return !task.isDeleted && (task.wakeUs <= world.nowUs || (task.queue != nullptr && task.queue->isFull));
  };
  for (const uint64_t endUs = world.nowUs + us; world.nowUs < endUs; world.nowUs += TurnUs) {
    running = nullptr;
    for (const auto &task : tasks) {
      if (isReady(*task) && (running == nullptr || task->priority > running->priority)) {
        running = task.get();
      }
    }
    if (running != nullptr) {
      swapcontext(&scheduler, &running->context);
    } else {
      idleUs = world.nowUs;
    }
    world.crashes += world.nowUs - idleUs >= WatchdogUs;
  }
}

void start(const Chip &newChip) {
  switchOn();
  world.pin = 16;
  chip = newChip;
  tasks.clear();
  running = nullptr;
  idleUs = world.nowUs;
  const auto loopTask = [](void *) {
    setup();
    for (;;) {
      loop();
      wait(world.nowUs);
    }
  };
  xTaskCreatePinnedToCore(loopTask, "loopTask", 8192, nullptr, 1, nullptr, chip.cores - 1);
}

// Puts frames on the line, 9 ms apart, from now on; CH3 is `throttle`.
void fly(unsigned frames, uint16_t throttle, unsigned flags = 0) {
  Channels channels = channelsOf(0);
  channels[2] = throttle;
  Frame frame = writeBitByBit(channels);
  frame[23] = static_cast<uint8_t>(flags);
  for (unsigned number = 0; number < frames; number++) {
    uint64_t us = world.nowUs + 9000 * number;
    for (const uint8_t byte : frame) {
      us += 120;
      world.line.push_back({us, byte});
    }
  }
}

std::string printedIn(uint64_t us) {
  world.printed.clear();
  runTasks(us);
  return world.printed;
}

// Returns true if the sketch prints `row`, at least `least` times, and nothing else.
bool prints(uint64_t us, const std::string &row, unsigned least) {
  const std::string printed = printedIn(us);
  std::string rows;
  for (unsigned count = 0; rows.size() < printed.size() || count < least; count++) {
    rows += row + "\r\n";
  }
  return printed == rows;
}

}  // namespace

// What FreeRTOS asserts, counts as a crash: tasks.c, prvInitialiseNewTask(), and freertos_tasks_c_additions.h, which
// takes the stack in bytes.
BaseType_t xTaskCreatePinnedToCore(TaskFunction_t function, const char *, uint32_t stackBytes, void *,
                                   UBaseType_t priority, TaskHandle_t *, BaseType_t core) {
  world.crashes += core < 0 || core >= chip.cores || priority >= configMAX_PRIORITIES || stackBytes < LeastStack;
  if (tasks.size() >= chip.mostTasks) {
    return -1;  // errCOULD_NOT_ALLOCATE_REQUIRED_MEMORY
  }
  tasks.emplace_back(new Task{function, priority, core});
  Task &made = *tasks.back();
  getcontext(&made.context);
  made.context.uc_stack.ss_sp = made.stack.data();
  made.context.uc_stack.ss_size = made.stack.size();
  made.context.uc_link = nullptr;
  makecontext(&made.context, enter, 0);
  return pdPASS;
}

// 0 lets no task of a lower priority run (tasks.c, vTaskDelay()).
void vTaskDelay(TickType_t ticks) { wait(ticks == 0 ? world.nowUs : (world.nowUs / TickUs + ticks) * TickUs); }

void vTaskDelete(TaskHandle_t) {
  running->isDeleted = true;
  wait(0);
}

BaseType_t xPortGetCoreID() { return running->core; }

// queue.c, xQueueGenericSend(): to be overwritten, it has one place.
QueueHandle_t xQueueCreate(UBaseType_t length, UBaseType_t size) {
  world.crashes += length != 1;
  queue.reset(new Queue{std::vector<uint8_t>(size), false});
  return queue.get();
}

BaseType_t xQueueOverwrite(QueueHandle_t to, const void *item) {
  std::memcpy(to->item.data(), item, to->item.size());
  to->isFull = true;
  return pdPASS;
}

BaseType_t xQueueReceive(QueueHandle_t from, void *item, TickType_t ticks) {
  if (!from->isFull && ticks != 0) {
    wait((world.nowUs / TickUs + ticks) * TickUs, from);
  }
  if (!from->isFull) {
    return pdFALSE;
  }
  std::memcpy(item, from->item.data(), from->item.size());
  from->isFull = false;
  return pdTRUE;
}

TEST_CASE("Tasks: the newest frame sets the throttle; it is closed in failsafe, and 100 ms after the last frame") {
  constexpr uint64_t Settled = 12000, Timeout = 100000;
  for (const Chip &each : {Two, One}) {
    CAPTURE(each.cores);
    start(each);
    CHECK(prints(2 * Second, "172,1", 9));
    fly(100, 1500);
    runTasks(Settled);
    CHECK(prints(900000 + Timeout - 2 * Settled, "1500,0", 4));
    runTasks(2 * Settled);
    CHECK(prints(Second, "172,1", 4));
    fly(100, 1811, sbus::FlagFailsafe);
    CHECK(prints(900000, "172,1", 4));
    fly(100, 1600, sbus::FlagLostFrame);
    runTasks(Settled);
    CHECK(prints(900000 - Settled, "1600,0", 4));
    CHECK(world.crashes == 0);
    CHECK(world.dropped == 0);
  }
}

TEST_CASE("if there is no memory for its tasks, Tasks says so, and does not crash") {
  for (const size_t most : {size_t{1}, size_t{2}}) {
    start({2, most});
    CHECK(printedIn(Second).rfind("There is no memory for queue and tasks.\r\n", 0) == 0);
    CHECK(world.crashes == 0);
  }
}
