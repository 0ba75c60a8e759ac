#include "../Core.h"

#if defined(SBUS_ESP32)

#include <esp_attr.h>
#include <hal/uart_ll.h>

#include "PolledByTimer.h"
#include "SlotTimer.h"

namespace sbus {

SemaphoreHandle_t TaskLock::mutex = nullptr;

namespace {

StaticSemaphore_t mutexMemory;

// A one-shot of esp_timer.
struct OneShot {
  esp_timer_handle_t handle;  // null: not created

  // Creates it and the lock, once. Returns false if it cannot.
  bool create(esp_timer_cb_t elapsed, const char *name) {
    if (handle == nullptr) {
      esp_timer_create_args_t settings = {};
      settings.callback = elapsed;
      settings.name = name;
      if (esp_timer_create(&settings, &handle) != ESP_OK) {
        return false;
      }
    }
    if (TaskLock::mutex == nullptr) {
      TaskLock::mutex = xSemaphoreCreateMutexStatic(&mutexMemory);
    }
    return true;
  }
  // Calls once, in `us`. Fails if a call is still to come.
  void callIn(uint32_t us) const { esp_timer_start_once(handle, us); }
};

}  // namespace

// ---- DecodeSBusBackground: the task, which others also need, never blocks on loop()

namespace {

constexpr uint32_t Period = 1000;  // us

OneShot ticks;
volatile bool isRunning = false;
volatile bool wasDue = false;

void tick(void *) {
  if (!isRunning) {
    return;
  }
  if (xSemaphoreTake(TaskLock::mutex, 0) == pdTRUE) {
    PolledByTimer::pollDecoders();
    xSemaphoreGive(TaskLock::mutex);
  } else {
    wasDue = true;
  }
  ticks.callIn(Period);
}

}  // namespace

PolledByTimer::Lock::~Lock() {
  if (wasDue) {
    wasDue = false;
    pollDecoders();
  }
}

bool PolledByTimer::startTimer() {
  if (!ticks.create(tick, "DecodeSBus")) {
    return false;
  }
  if (!isRunning) {
    isRunning = true;
    ticks.callIn(Period);  // one from before stopTimer() may be still to come
  }
  return true;
}

// One that is still to come finds the list empty.
void PolledByTimer::stopTimer() { isRunning = false; }

// ---- SBus2Sensor

namespace {

constexpr uint32_t DelayMin = 20;   // us: others have the task meanwhile
constexpr uint8_t HalfAFrame = 13;  // characters

TimedSensor<HardwareSerial> timed;
OneShot slots;
uint8_t number;  // of the UART
uint32_t next;   // us, until the next call

// Reads the number of a port, for which the port has no public method.
struct Number : HardwareSerial {
  static uint8_t of(const HardwareSerial &port) { return port.*(&Number::_uart_nr); }
};

void slot(void *) {
  const TaskLock lock;
  if (timed.port != nullptr) {
    timed.call();
    slots.callIn(next);
  }
}

}  // namespace

portMUX_TYPE SlotTimer::_lock = portMUX_INITIALIZER_UNLOCKED;
uint32_t SlotTimer::_looked;
FifoWatch SlotTimer::_watch;

// The driver takes the first half of a frame out of the FIFO while the second comes, so that the end is seen to come
// even if its interrupt is a millisecond late.
bool SlotTimer::start(HardwareSerial &port, void (*due)(void *), void *context) {
  if (timed.port != nullptr) {
    return timed.isOf(context);
  }
  if (!slots.create(slot, "SBus2Sensor")) {
    return false;
  }
  const TaskLock lock;
  Esp32::limitBursts(port, HalfAFrame, Rank<1>());
  number = Number::of(port);
  timed.claim(port, due, context);
  slots.callIn(DelayMin);
  return true;
}

// Waits for a call that has begun. One that is still to come finds the timer free.
void SlotTimer::stop(void *context) {
  const TaskLock lock;
  if (timed.isOf(context)) {
    timed.port = nullptr;
  }
}

// Called by due() only, in the task.
void SlotTimer::callIn(uint32_t us) { next = us < DelayMin ? DelayMin : us; }

void SlotTimer::polled(unsigned found, uint32_t by) {
  const uint32_t from = clock();
  const unsigned fill = uart_ll_get_rxfifo_len(UART_LL_GET_HW(number));
  _watch.poll(found, by, from, fill, clock());
}

int IRAM_ATTR SlotTimer::waiting(Port &) { return static_cast<int>(uart_ll_get_rxfifo_len(UART_LL_GET_HW(number))); }

// The driver may have taken all characters out of the FIFO meanwhile.
bool IRAM_ATTR SlotTimer::isLineIdle(Port &port, int waiting) {
  const int now = SlotTimer::waiting(port);
  return now == waiting || (now == 0 && waiting > 0);
}

// Does not use the driver's methods: they take a mutex, which is not allowed while interrupts are off.
bool IRAM_ATTR SlotTimer::send(const uint8_t *characters, size_t size) {
  uart_dev_t *const uart = UART_LL_GET_HW(number);
  if (!uart_ll_is_tx_idle(uart) || clock() - _looked > SendMax) {
    return false;
  }
  uart_ll_write_txfifo(uart, characters, static_cast<uint32_t>(size));
  return true;
}

}  // namespace sbus

#endif
