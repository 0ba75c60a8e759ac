#include "SlotTimer.h"

#if defined(SBUS_ESP32)

#include <esp_attr.h>
#include <hal/uart_ll.h>

#include "Buffer.h"

namespace sbus {

namespace {

constexpr uint32_t Soonest = 20;    // us: others have the task meanwhile
constexpr uint8_t HalfAFrame = 13;  // characters

StaticSemaphore_t mutexMemory;
esp_timer_handle_t timer = nullptr;
bool isFree = true;
uint8_t number;  // of the UART
void *sensor;
void (*dueCallback)(void *);
uint32_t next;  // us, until the next call

// Reads the number of a port, for which the port has no public method.
struct Number : HardwareSerial {
  static uint8_t of(const HardwareSerial &port) { return port.*(&Number::_uart_nr); }
};

void elapsed(void *) {
  const SlotTimer::Lock lock;
  if (!isFree) {
    dueCallback(sensor);
    esp_timer_start_once(timer, next);
  }
}

}  // namespace

SemaphoreHandle_t SlotTimer::_mutex = nullptr;
portMUX_TYPE SlotTimer::_lock = portMUX_INITIALIZER_UNLOCKED;
uint32_t SlotTimer::_looked;
FifoWatch SlotTimer::_watch;

// The driver takes the first half of a frame out of the FIFO while the second comes, so that the end is seen to come
// even if its interrupt is a millisecond late.
bool SlotTimer::start(HardwareSerial &port, void (*due)(void *), void *context) {
  if (!isFree) {
    return sensor == context;
  }
  if (timer == nullptr) {
    esp_timer_create_args_t settings = {};
    settings.callback = elapsed;
    settings.name = "SBus2Sensor";
    if (esp_timer_create(&settings, &timer) != ESP_OK) {
      return false;
    }
    _mutex = xSemaphoreCreateMutexStatic(&mutexMemory);
  }
  const Lock lock;
  limitBursts(port, HalfAFrame, Rank<1>());
  number = Number::of(port);
  sensor = context;
  dueCallback = due;
  isFree = false;
  esp_timer_start_once(timer, Soonest);
  return true;
}

// Waits for a call that has begun. One that is still to come finds the timer free.
void SlotTimer::stop(void *context) {
  const Lock lock;
  isFree = isFree || sensor == context;
}

// Called by due() only, in the task.
void SlotTimer::at(uint32_t us) {
  next = us < Soonest ? Soonest : us;
}

void SlotTimer::polled(unsigned found, uint32_t by) {
  const uint32_t from = clock();
  const unsigned fill = uart_ll_get_rxfifo_len(UART_LL_GET_HW(number));
  _watch.poll(found, by, from, fill, clock());
}

int IRAM_ATTR SlotTimer::waiting(Port &) {
  return static_cast<int>(uart_ll_get_rxfifo_len(UART_LL_GET_HW(number)));
}

// The driver may have taken all characters out of the FIFO meanwhile.
bool IRAM_ATTR SlotTimer::isQuiet(Port &port, int waiting) {
  const int now = SlotTimer::waiting(port);
  return now == waiting || (now == 0 && waiting > 0);
}

// Does not use the driver's methods: they take a mutex, which is not allowed while interrupts are off.
bool IRAM_ATTR SlotTimer::send(const uint8_t *characters, size_t size) {
  uart_dev_t *const uart = UART_LL_GET_HW(number);
  if (!uart_ll_is_tx_idle(uart) || clock() - _looked > LongestSend) {
    return false;
  }
  uart_ll_write_txfifo(uart, characters, static_cast<uint32_t>(size));
  return true;
}

}  // namespace sbus

#endif
