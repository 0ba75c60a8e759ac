#include "SlotTimer.h"

#if defined(SBUS_SLOT_TIMER)

#if defined(SBUS_STM32L0)
#include <stm32l0_timer.h>

#include "DmaSender.h"
#elif defined(SBUS_RP2040)
#include "Alarm.h"
#elif defined(SBUS_ESP32)
#include <esp_attr.h>
#include <hal/uart_ll.h>
#endif

namespace sbus {

namespace {

#if defined(SBUS_STM32L0)
using Sender = Uart;
#elif defined(SBUS_RP2040)
using Sender = SerialUART;
#else
using Sender = HardwareSerial;
#endif

// The only sensor that the timer calls.
Sender *sender = nullptr;  // its port; null: the timer is free
void *sensor;
void (*dueCallback)(void *);

bool take(Sender &port, void (*due)(void *), void *context) {
  sensor = context;
  dueCallback = due;
  sender = &port;
  return true;
}

bool isOf(const void *context) { return sender != nullptr && sensor == context; }

}  // namespace

#if defined(SBUS_STM32L0)

namespace {

constexpr unsigned Priority = 1;       // as the UARTs' interrupts: neither interrupts the other
constexpr uint32_t LongestUs = 60000;  // the timer has 16 bits

stm32l0_timer_t timer;

void elapsed(void *, uint32_t) { dueCallback(sensor); }

}  // namespace

// The prescaler counts from the first elapsed period on (stm32l0_timer.c:294 sets no UG): so the first period is too
// short, and due() comes too early.
bool SlotTimer::start(Uart &port, void (*due)(void *), void *context) {
  if (sender != nullptr || !stm32l0_timer_create(&timer, STM32L0_TIMER_INSTANCE_TIM7, Priority, 0)) {
    return isOf(context);
  }
  if (!stm32l0_timer_enable(&timer, stm32l0_timer_clock(&timer) / 1000000 - 1, 0, elapsed, nullptr,
                            STM32L0_TIMER_EVENT_PERIOD)) {
    stm32l0_timer_destroy(&timer);
    return false;
  }
  return take(port, due, context);
}

void SlotTimer::stop(void *context) {
  if (isOf(context)) {
    stm32l0_timer_stop(&timer);
    stm32l0_timer_disable(&timer);
    stm32l0_timer_destroy(&timer);
    sender = nullptr;
  }
}

void SlotTimer::callIn(uint32_t us) { stm32l0_timer_start(&timer, us < 1 ? 1 : us > LongestUs ? LongestUs : us, true); }

bool SlotTimer::cameAtOnce() { return DmaSender::cameAtOnce(sender); }

bool SlotTimer::isLineIdle(Port &, int) { return !DmaSender::hears(sender); }

bool SlotTimer::send(const uint8_t *characters, size_t size) { return DmaSender::send(sender, characters, size); }

#elif defined(SBUS_AVR)

namespace {

constexpr uint32_t Divider = 64;  // of the clock: a tick is 4 us at 16 MHz, 5.3 us at 12 MHz
constexpr uint8_t Soonest = 3;    // ticks
constexpr uint8_t Latest = 150;
constexpr uint8_t MostLate = 64;  // ticks: micros() stops from 256 on

uint8_t ticks;         // until the next call
uint8_t modeA, modeB;  // what the core had set: the PWM of analogWrite()

// Reads UCSRnA of a port, for which the port has no public method.
struct Status : HardwareSerial {
  static const volatile uint8_t *of(const HardwareSerial &port) { return port.*(&Status::_ucsra); }
};

}  // namespace

volatile bool FlagLock::isLocked = false;
bool SlotTimer::_isLate = false;

bool SlotTimer::start(HardwareSerial &port, void (*due)(void *), void *context) {
  if (sender != nullptr) {
    return isOf(context);
  }
  modeA = TCCR2A;
  modeB = TCCR2B;
  take(port, due, context);
  TCCR2A = 0;
  TCCR2B = _BV(CS22);
  TIMSK2 |= _BV(OCIE2B);
  return true;
}

void SlotTimer::stop(void *context) {
  if (isOf(context)) {
    TIMSK2 &= static_cast<uint8_t>(~_BV(OCIE2B));
    TCCR2A = modeA;
    TCCR2B = modeB;
    sender = nullptr;
  }
}

// Called by due() only, in the interrupt.
void SlotTimer::callIn(uint32_t us) {
  const uint32_t wanted = us * (F_CPU / 1000000) / Divider;
  ticks = static_cast<uint8_t>(wanted < Soonest ? Soonest : wanted > Latest ? Latest : wanted);
}

// The port's own interrupt would write the third character while loop() may have disabled interrupts. This waits 120 us
// for it, with interrupts, of which none may take longer: then the characters are cut short, and do not come apart.
bool SlotTimer::send(const uint8_t *characters, size_t size) {
  const volatile uint8_t *const status = Status::of(*sender);
  for (size_t i = 0; i < size; i++) {
    const uint8_t from = TCNT2;
    while ((*status & _BV(UDRE0)) == 0 && static_cast<uint8_t>(TCNT2 - from) < MostLate) {
    }
    cli();
    const bool isApart = i > 0 && (*status & _BV(TXC0)) != 0;
    if (!isApart) {
      sender->write(characters[i]);
    }
    sei();
    if (isApart) {
      break;
    }
  }
  return true;
}

// Others may interrupt it, since characters come every 120 us; it does not interrupt itself. Compare A shows that it
// comes very late.
void SlotTimer::tick() {
  TIMSK2 &= static_cast<uint8_t>(~_BV(OCIE2B));
  _isLate = (TIFR2 & _BV(OCF2A)) != 0;
  sei();
  dueCallback(sensor);
  cli();
  OCR2B = static_cast<uint8_t>(TCNT2 + ticks);
  OCR2A = static_cast<uint8_t>(OCR2B + MostLate);
  TIFR2 = _BV(OCF2B) | _BV(OCF2A);
  TIMSK2 |= _BV(OCIE2B);
}

#elif defined(SBUS_RP2040)

namespace {

constexpr uint32_t Soonest = 10;  // us: loop() goes on meanwhile

Alarm alarm;
uint32_t next;  // us, until the next call

// Returns a time that changes from call to call: otherwise the interrupt could stay in step with a loop() that is in a
// method of the port each time.
uint32_t soon() { return next >= Soonest && next < 2 * Soonest ? next + 1 : Soonest; }

// If the sketch was interrupted within a method of the port, all of them return 0 here (CoreMutex.cpp:47): a poll would
// find nothing, and seem to know that the frame has not ended. So it comes again.
void elapsed(unsigned) {
  if (sender->availableForWrite() > 0) {
    dueCallback(sensor);
  } else {
    next = soon();
  }
  alarm.arm(next);
}

}  // namespace

volatile bool FlagLock::isLocked = false;

bool SlotTimer::start(SerialUART &port, void (*due)(void *), void *context) {
  if (sender != nullptr) {
    return isOf(context);
  }
  if (!alarm.claim(elapsed)) {
    return false;
  }
  next = Soonest;
  take(port, due, context);
  alarm.arm(next);
  return true;
}

void SlotTimer::stop(void *context) {
  if (isOf(context)) {
    alarm.release();
    sender = nullptr;
  }
}

// Called by due() only, in the interrupt.
void SlotTimer::callIn(uint32_t us) { next = us < Soonest ? soon() : us; }

// The UART's FIFO takes 32.
bool SlotTimer::send(const uint8_t *characters, size_t size) { return sender->write(characters, size) == size; }

#elif defined(SBUS_ESP32)

namespace {

constexpr uint32_t Soonest = 20;    // us: others have the task meanwhile
constexpr uint8_t HalfAFrame = 13;  // characters

StaticSemaphore_t mutexMemory;
esp_timer_handle_t timer = nullptr;
uint8_t number;  // of the UART
uint32_t next;   // us, until the next call

// Reads the number of a port, for which the port has no public method.
struct Number : HardwareSerial {
  static uint8_t of(const HardwareSerial &port) { return port.*(&Number::_uart_nr); }
};

void elapsed(void *) {
  const SlotTimer::Lock lock;
  if (sender != nullptr) {
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
  if (sender != nullptr) {
    return isOf(context);
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
  Esp32::limitBursts(port, HalfAFrame, Rank<1>());
  number = Number::of(port);
  take(port, due, context);
  esp_timer_start_once(timer, Soonest);
  return true;
}

// Waits for a call that has begun. One that is still to come finds the timer free.
void SlotTimer::stop(void *context) {
  const Lock lock;
  if (isOf(context)) {
    sender = nullptr;
  }
}

// Called by due() only, in the task.
void SlotTimer::callIn(uint32_t us) { next = us < Soonest ? Soonest : us; }

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
  if (!uart_ll_is_tx_idle(uart) || clock() - _looked > LongestSend) {
    return false;
  }
  uart_ll_write_txfifo(uart, characters, static_cast<uint32_t>(size));
  return true;
}

#endif

}  // namespace sbus

#if defined(SBUS_AVR)
// With `dot_a_linkage` it is linked only into sketches that have an SBus2Sensor.
ISR(TIMER2_COMPB_vect) { sbus::SlotTimer::tick(); }
#endif

#endif
