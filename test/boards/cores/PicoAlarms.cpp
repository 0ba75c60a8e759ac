// The alarms of the pico-sdk, World's alarm.
#include <hardware/irq.h>
#include <hardware/sync.h>
#include <hardware/timer.h>
#include <pico.h>

#include "World.h"

namespace sim {

Alarms alarms;

}  // namespace sim

using sim::alarms;
using sim::world;

namespace {

constexpr uint64_t LookUs = 1;  // what reading the clock takes; otherwise a loop that waits would never end
unsigned set;                   // the alarm to which world.alarmAtUs belongs

}  // namespace

int hardware_alarm_claim_unused(bool) {
  for (unsigned i = 0; i < sim::Alarms::Count; i++) {
    if ((alarms.claimed >> i & 1) == 0) {
      alarms.claimed |= 1u << i;
      return static_cast<int>(i);
    }
  }
  return -1;
}

void hardware_alarm_unclaim(uint alarm) { alarms.claimed &= ~(1u << alarm); }

// :184
void hardware_alarm_set_callback(uint alarm, hardware_alarm_callback_t callback) {
  world.crashes += (alarms.claimed >> alarm & 1) == 0;
  alarms.callback[alarm] = callback;
  if (callback == nullptr) {
    world.alarmAtUs = sim::World::Never;
  }
}

// :216: a time that has passed is not set. An alarm above the priority of the UART's interrupt would wait forever for a
// mutex that this interrupt holds (SerialUART.cpp:352).
bool hardware_alarm_set_target(uint alarm, absolute_time_t target) {
  if (time_us_64() >= target) {
    return true;
  }
  world.crashes += alarms.callback[alarm] == nullptr || alarms.priority[alarm] < PICO_DEFAULT_IRQ_PRIORITY;
  set = alarm;
  world.alarmAtUs = target;
  world.alarm = [] { alarms.callback[set](set); };
  return false;
}

void hardware_alarm_cancel(uint) { world.alarmAtUs = sim::World::Never; }

uint hardware_alarm_get_irq_num(uint alarm) { return alarm; }

void irq_set_priority(unsigned number, uint8_t priority) { alarms.priority[number] = priority; }

unsigned get_core_num() { return alarms.core; }

uint64_t time_us_64() {
  world.pass(LookUs);
  return world.nowUs;
}

uint32_t time_us_32() { return static_cast<uint32_t>(time_us_64()); }

void busy_wait_us_32(uint32_t us) {
  for (const uint64_t endUs = world.nowUs + us; world.nowUs < endUs;) {
    world.pass(LookUs);
  }
}

uint32_t save_and_disable_interrupts() { return world.masked++; }

void restore_interrupts(uint32_t status) { world.masked = status; }
