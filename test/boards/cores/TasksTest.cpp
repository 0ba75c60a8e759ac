// The example Tasks on the FreeRTOS of an ESP32: the newest frame sets the throttle, which closes when none comes.
#include <string>

#include "Cores.h"
#include "Tasks.h"

HardwareSerial Serial1, Serial2;
Console Serial;

using namespace cores;

namespace {

constexpr uint64_t Second = 1000000;
constexpr sim::Chip Two = {2, 100}, One = {1, 100};

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
  sim::runTasks(us);
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

void start(const sim::Chip &chip) {
  switchOn();
  world.pin = 16;
  sim::startTasks(chip);
}

// A task of the test, beside the sketch's.
void crashes(TaskFunction_t function, uint64_t us = Second) {
  start(Two);
  sim::runTasks(1);
  xTaskCreatePinnedToCore(function, "test", 4096, nullptr, 1, nullptr, 0);
  CHECK(world.crashes == 0);
  sim::runTasks(us);
  CHECK(world.crashes >= 1);
}

}  // namespace

TEST_CASE("Tasks: the newest frame sets the throttle; it is closed in failsafe, and 100 ms after the last frame") {
  constexpr uint64_t Settled = 12000, Timeout = 100000;
  for (const sim::Chip &chip : {Two, One}) {
    CAPTURE(chip.cores);
    start(chip);
    CHECK(prints(Second, "172,1", 4));
    fly(100, 1500);
    sim::runTasks(Settled);
    CHECK(prints(900000 + Timeout - 2 * Settled, "1500,0", 4));
    sim::runTasks(2 * Settled);
    CHECK(prints(Second, "172,1", 4));
    fly(100, 1811, sbus::FlagFailsafe);
    CHECK(prints(900000, "172,1", 4));
    fly(100, 1600, sbus::FlagLostFrame);
    sim::runTasks(Settled);
    CHECK(prints(900000 - Settled, "1600,0", 4));
    CHECK(world.crashes == 0);
    CHECK(world.dropped == 0);
  }
}

TEST_CASE("if there is no memory for its tasks, Tasks says so, and does not crash") {
  for (const unsigned most : {1u, 2u}) {
    start({2, most});
    CHECK(printedIn(Second).rfind("There is no memory for queue and tasks.\r\n", 0) == 0);
    CHECK(world.crashes == 0);
  }
}

TEST_CASE("the stand-in asserts what FreeRTOS asserts") {
  crashes([](void *) {}, 1000);
  crashes([](void *) { xQueueOverwrite(nullptr, "x"); });
  crashes([](void *) { xQueueOverwrite(xQueueCreate(2, 1), "x"); });
  crashes([](void *) { xTaskCreatePinnedToCore([](void *) {}, "", 4096, nullptr, configMAX_PRIORITIES, nullptr, 0); });
  crashes([](void *) { xTaskCreatePinnedToCore([](void *) {}, "", 4096, nullptr, 1, nullptr, 2); });
  crashes([](void *) { xTaskCreatePinnedToCore([](void *) {}, "", 512, nullptr, 1, nullptr, 0); });
  crashes(
      [](void *) {
        for (;;)
          vTaskDelay(0);
      },
      6 * Second);  // its watchdog bites
}
