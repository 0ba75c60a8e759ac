// What calls each millisecond on a Teensy 4 and a SAMD: World's alarm.
#include <Arduino.h>

#include "World.h"

namespace sim {

Ticks ticks;

}  // namespace sim

using sim::ticks;
using sim::world;

#if defined(CORE_TEENSY)

#include <IntervalTimer.h>

uint32_t SCB_ICSR = 1 << 11;  // no other interrupt is active

namespace {

constexpr unsigned UartPriority = 64;  // teensy4/HardwareSerial1.cpp:40
constexpr uint32_t ReturnsToBase = 1 << 11;

struct Channel {
  void (*function)();
  uint64_t us, nextUs;
  unsigned priority;
};
constexpr unsigned Count = 4;
Channel channels[Count];

// A Teensy 4 has one interrupt for all channels, with the highest priority of them (IntervalTimer.cpp:61).
unsigned priorityOf(const Channel &channel) {
  unsigned top = channel.priority;
  for (const Channel &each : channels) {
    top = each.function != nullptr && each.priority < top ? each.priority : top;
  }
  return top;
}

void set();

// A flag is raised while its interrupt waits, and not counted: a period that nothing has served is lost.
void elapsed() {
  for (Channel &channel : channels) {
    if (channel.function != nullptr && channel.nextUs <= world.nowUs) {
      channel.nextUs += (world.nowUs - channel.nextUs) / channel.us * channel.us + channel.us;
      world.inUart = priorityOf(channel) <= UartPriority && world.upTo(2) == 0;
      SCB_ICSR = world.inUart ? 0 : ReturnsToBase;
      channel.function();
      world.inUart = false;
    }
  }
  set();
}

void set() {
  world.alarm = elapsed;
  world.alarmAtUs = sim::World::Never;
  for (const Channel &channel : channels) {
    if (channel.function != nullptr && channel.nextUs < world.alarmAtUs) {
      world.alarmAtUs = channel.nextUs;
    }
  }
}

}  // namespace

bool IntervalTimer::begin(void (*function)(), int us) {
  for (unsigned i = 0; i < ticks.free && _channel < 0; i++) {
    _channel = channels[i].function == nullptr ? static_cast<int>(i) : -1;
  }
  if (_channel < 0) {
    return false;
  }
  channels[_channel] = {function, static_cast<uint64_t>(us), world.nowUs + static_cast<uint64_t>(us), _priority};
  set();
  return true;
}

void IntervalTimer::priority(uint8_t level) {
  _priority = level;
  if (_channel >= 0) {
    channels[_channel].priority = level;
  }
}

void IntervalTimer::end() {
  if (_channel >= 0) {
    channels[_channel] = Channel();
    _channel = -1;
    set();
  }
}

void sim::startTicks() {
  ticks = Ticks();
  set();
}

#elif defined(ARDUINO_ARCH_SAMD)

namespace {

constexpr unsigned Lowest = (1 << __NVIC_PRIO_BITS) - 1;  // SERCOM.h:31, SERCOM_NVIC_PRIORITY
uint64_t nextUs;

// SysTick may interrupt a SERCOM's interrupt; PendSV follows after both (cortex_handlers.c:170). A tick that nothing
// has served is lost.
void sysTick() {
  nextUs += (world.nowUs - nextUs) / 1000 * 1000 + 1000;
  world.inUart = true;
  sysTickHook();
  world.inUart = ticks.priority != Lowest;
  if (ticks.isPending) {
    ticks.isPending = false;
    PendSV_Handler();
  }
  world.inUart = false;
  world.alarmAtUs = nextUs;
}

}  // namespace

sim::Icsr &sim::Icsr::operator=(uint32_t bits) {
  ticks.isPending = (bits & SCB_ICSR_PENDSVSET_Msk) != 0;
  return *this;
}

void NVIC_SetPriority(IRQn_Type number, uint32_t priority) {
  ticks.priority = number == PendSV_IRQn ? priority : ticks.priority;
}

// hooks.c:43, cortex_handlers.c:42.
extern "C" __attribute__((weak)) int sysTickHook() { return 0; }
extern "C" __attribute__((weak)) void PendSV_Handler() { world.crashes++; }

sim::Scb *sim::scb() {
  static Scb only;
  return &only;
}

void sim::startTicks() {
  ticks = Ticks();
  world.alarm = sysTick;
  world.alarmAtUs = nextUs = world.nowUs + 613;
}

#endif
