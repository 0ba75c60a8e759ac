#include "Ticker.h"

#if defined(SBUS_TICKER)

#if defined(SBUS_RP2040)
#include "Alarm.h"
#elif defined(SBUS_ESP32)
#include <esp_timer.h>
#include <freertos/FreeRTOS.h>
#include <freertos/semphr.h>
#elif defined(SBUS_TEENSY)
#include <IntervalTimer.h>
#endif

namespace sbus {

namespace {

// Keeps the timer from reading the list, while it exists.
#if defined(SBUS_AVR)
struct Change {  // an interrupt could come between the two bytes of a pointer
  explicit Change(const PolledByTimer &) { cli(); }
  ~Change() { SREG = state; }
  const uint8_t state = SREG;
};
#elif defined(SBUS_ESP32)
using Change = PolledByTimer::Lock;
#else
struct Change {
  explicit Change(const PolledByTimer &) {}
};
#endif

}  // namespace

PolledByTimer *PolledByTimer::first = nullptr;

bool PolledByTimer::tickAll() {
  bool isDone = true;
  for (PolledByTimer *decoder = first; decoder != nullptr; decoder = decoder->_next) {
    if (decoder->_isLocked) {
      decoder->_wasDue = true;
    } else if (!decoder->_poll(*decoder)) {
      isDone = false;
    }
  }
  return isDone;
}

void PolledByTimer::startPolling(Poll *callback) {
  if (!startTimer()) {
    return;
  }
  const Change change(*this);
  _poll = callback;
  _next = first;
  barrier();
  first = this;
}

void PolledByTimer::stopPolling() {
  const Change change(*this);
  for (PolledByTimer **place = &first; *place != nullptr; place = &(*place)->_next) {
    if (*place == this) {
      *place = _next;
      break;
    }
  }
  if (first == nullptr) {
    stopTimer();
  }
}

#if defined(SBUS_AVR)

// Compare B of timer 0, which counts millis(). It comes once in 256 counts of 64 cycles, 1.024 ms at 16 MHz, wherever
// analogWrite() puts it: no timer is taken. 0, as after a reset, would be the time of the interrupt of millis().
bool PolledByTimer::startTimer() {
  if (OCR0B == 0) {
    OCR0B = 128;
  }
  TIMSK0 |= _BV(OCIE0B);
  return true;
}

void PolledByTimer::stopTimer() { TIMSK0 &= static_cast<uint8_t>(~_BV(OCIE0B)); }

}  // namespace sbus

// Other interrupts may come, since characters come every 120 us; it does not interrupt itself. With `dot_a_linkage` it
// is linked only into sketches that listen in the background.
ISR(TIMER0_COMPB_vect) {
  TIMSK0 &= static_cast<uint8_t>(~_BV(OCIE0B));
  sei();
  sbus::PolledByTimer::tickAll();
  cli();
  TIMSK0 |= _BV(OCIE0B);
}

#elif defined(SBUS_RP2040)

// arduino-pico: an alarm of the microsecond timer. Its interrupt runs on the core that has called begin() first;
// decoders of the other core are not polled.
namespace {

constexpr uint32_t Period = 1000;  // us
constexpr uint32_t Soonest = 20;   // us: loop() goes on meanwhile

bool isRunning = false;
Alarm alarm;
unsigned core;
uint32_t next = Period;  // us, until the next call

// A time that changes from call to call: otherwise the interrupt could stay in step with a loop() that is in a method
// of the port each time.
void elapsed(unsigned) {
  next = PolledByTimer::tickAll() ? Period : next < 2 * Soonest ? next + 1 : Soonest;
  alarm.arm(next);
}

}  // namespace

bool PolledByTimer::startTimer() {
  if (isRunning) {
    return core == get_core_num();
  }
  if (!alarm.claim(elapsed)) {
    return false;
  }
  isRunning = true;
  core = get_core_num();
  alarm.arm(next);
  return true;
}

void PolledByTimer::stopTimer() {
  if (isRunning) {
    alarm.release();
    isRunning = false;
  }
}

}  // namespace sbus

#elif defined(SBUS_ESP32)

// arduino-esp32 2.0 and later: a one-shot of esp_timer, whose task polls. Tasks of a higher priority (WiFi) and writes
// to flash hold it up.
namespace {

constexpr uint32_t Period = 1000;  // us

StaticSemaphore_t mutexMemory;
SemaphoreHandle_t mutex = nullptr;
esp_timer_handle_t timer = nullptr;
volatile bool isRunning = false;
volatile bool wasDue = false;

void elapsed(void *) {
  if (!isRunning) {
    return;
  }
  if (xSemaphoreTake(mutex, 0) == pdTRUE) {
    PolledByTimer::tickAll();
    xSemaphoreGive(mutex);
  } else {
    wasDue = true;
  }
  esp_timer_start_once(timer, Period);
}

}  // namespace

PolledByTimer::Lock::Lock(const PolledByTimer &) {
  if (mutex != nullptr) {
    xSemaphoreTake(mutex, portMAX_DELAY);
  }
}

PolledByTimer::Lock::~Lock() {
  if (wasDue) {
    wasDue = false;
    tickAll();
  }
  if (mutex != nullptr) {
    xSemaphoreGive(mutex);
  }
}

bool PolledByTimer::startTimer() {
  if (timer == nullptr) {
    esp_timer_create_args_t settings = {};
    settings.callback = elapsed;
    settings.name = "DecodeSBus";
    if (esp_timer_create(&settings, &timer) != ESP_OK) {
      return false;
    }
    mutex = xSemaphoreCreateMutexStatic(&mutexMemory);
  }
  if (!isRunning) {
    isRunning = true;
    esp_timer_start_once(timer, Period);  // fails if one from before stop() is still to come
  }
  return true;
}

// One that is still to come finds the list empty.
void PolledByTimer::stopTimer() { isRunning = false; }

}  // namespace sbus

#elif defined(SBUS_TEENSY)

namespace {

constexpr int Period = 1000;     // us
constexpr uint8_t Lowest = 255;  // priority

IntervalTimer timer;
bool isRunning = false;

// A Teensy 4 has one interrupt for all IntervalTimers, with the highest of their priorities
// (teensy4/IntervalTimer.h:84). If the sketch has one above the UART's, the UART's interrupt may be the one that this
// one interrupts; both read the FIFO (HardwareSerial.cpp:551, 622). So it only interrupts loop().
bool isInPort() {
#if defined(SBUS_IMXRT)
  constexpr uint32_t ReturnsToBase = 1 << 11;  // RETTOBASE: no other interrupt is active
  return (SCB_ICSR & ReturnsToBase) == 0;
#else
  return false;
#endif
}

void elapsed() {
  if (!isInPort()) {
    PolledByTimer::tickAll();
  }
}

}  // namespace

bool PolledByTimer::startTimer() {
  if (!isRunning) {
    timer.priority(Lowest);
    isRunning = timer.begin(elapsed, Period);
  }
  return isRunning;
}

void PolledByTimer::stopTimer() {
  timer.end();
  isRunning = false;
}

}  // namespace sbus

#elif defined(SBUS_SAMD)

namespace {

volatile bool isRunning = false;

}  // namespace

// The core's tick of a millisecond, SysTick, asks for PendSV, which polls: no timer is taken. The lowest priority, as
// the SERCOMs have it (SERCOM.h, SERCOM_NVIC_PRIORITY): neither interrupts the other. SysTick's is above them
// (wiring.c:66), and PendSV's is the highest of all after a reset.
bool PolledByTimer::startTimer() {
  NVIC_SetPriority(PendSV_IRQn, (1 << __NVIC_PRIO_BITS) - 1);
  isRunning = true;
  return true;
}

void PolledByTimer::stopTimer() { isRunning = false; }

}  // namespace sbus

extern "C" {

// The core calls this each millisecond (cortex_handlers.c:172). 0: millis() goes on.
int sysTickHook() {
  if (sbus::isRunning) {
    SCB->ICSR = SCB_ICSR_PENDSVSET_Msk;
  }
  return 0;
}

// Weak in the core, as sysTickHook() is. (Its pendSVHook() is never called.)
void PendSV_Handler() { sbus::PolledByTimer::tickAll(); }
}

#endif

#endif
