// Runs a sketch as a FreeRTOS on two cores does: setup() and loop() in a task of their own, beside the tasks they make.
#pragma once

#include <cstdint>

namespace sim {

struct Chip {
  unsigned cores;      // 1: ESP32-S2, C3, C6
  unsigned mostTasks;  // for which there is memory
};

// Forgets all tasks, and starts setup() and loop().
void startTasks(const Chip &chip);
void runTasks(uint64_t us);

}  // namespace sim
