/// @file
/// Who polls: loop(), or the port's receive callback, with a guard that keeps it from interrupting a poll in progress.
#pragma once

#include <Arduino.h>
#include <stdint.h>

#include "../sbus/Barrier.h"
#include "Port.h"

namespace sbus {

#if defined(SBUS_STM32L0)

// Returns the core's state of a port, which its class keeps to itself.
stm32l0_uart_t *uartOf(Uart &port);
// Returns null: another Stream does not tell when its line was idle.
inline stm32l0_uart_t *uartOf(Stream &) { return nullptr; }

// The STM32L0's port calls back at PendSV level, which interrupts loop(): at once, and then not until bytes have been
// read (Uart.cpp: 385, stm32l0_uart.c:99, 1171). An event that finds no callback, or no place in PendSV's queue, loses
// all later ones until bytes are read: any method that finds the newest frame old reads them.
class CallbackPort : public Port {
 public:
  static constexpr bool HasCallback = true;  // some ports call back

  // Remembers `port`, and whether a port of this class calls back.
  template <typename Class>
  explicit CallbackPort(Class &port) : Port(port), _set(setterOf(&port, Rank<1>())) {}
  // Remembers `port` and its pins.
  template <typename Class>
  CallbackPort(Class &port, int8_t rx, int8_t tx) : Port(port, rx, tx), _set(setterOf(&port, Rank<1>())) {}
  CallbackPort(const CallbackPort &) = delete;
  CallbackPort &operator=(const CallbackPort &) = delete;
  // The port must not call an object that is gone.
  ~CallbackPort() {
    if (!_isBusy) {
      stop();
    }
  }

  // Returns true if wasIdle() and isIdle() know: from start() on. (A constant on the board: 300 bytes less. There
  // another Stream shows no gaps.)
#if defined(DMA1_Channel2)
  static constexpr bool tellsIdle() { return true; }
#else
  bool tellsIdle() const { return _uart != nullptr; }
#endif
  // Returns true if the port has just called because half of its ring was full, and no method runs.
  bool isAtHalf() const { return _uart != nullptr && _uart->rx_index % HalfRing == 0 && !_isBusy; }
  // Lets the port call again though nothing was read, as a read of no bytes does (stm32l0_uart.c:1171).
  void rearm() {
    wasIdle();
    _uart->rx_event = true;
  }
  // Returns how many bytes wait.
  unsigned waiting() const { return static_cast<unsigned>(_uart->rx_count); }
  // Returns true if the line was idle after the newest byte that waits or was read: the port hands over halves of its
  // ring, and less only if the line was idle for a character (stm32l0_uart.c:653), or the next character was wrong
  // (:529). Where no call has found the half before, masked interrupts may have delayed it: that proves nothing. Call
  // it whenever bytes are found.
  __attribute__((noinline)) bool wasIdle() {
    if (_uart == nullptr) {
      return false;
    }
    const unsigned at = _uart->rx_index;
    if (at != _foundAt) {
      _foundIdle = at % HalfRing != 0 && ((at ^ _foundAt) & HalfRing) == 0;
      _foundAt = static_cast<uint8_t>(at);
    }
    return _foundIdle;
  }
  // Returns true if it was idle after the newest byte that was read.
  bool isIdle() {
    if (!wasIdle()) {
      return false;
    }
    barrier();  // an interrupt may hand over more: it changes rx_index first
    return waiting() == 0;
  }

  // Returns true if start() makes the port call.
  bool callsBack() const { return _set != nullptr; }
  // From now on the port calls this method. Returns false if it cannot call back.
  template <typename Object>
  bool start(void (Object::*method)(), Object *object) {
    if (_set != nullptr) {
      _uart = _set(stream(), Callback(method, object));
      wasIdle();  // begin() has restarted the ring
    }
    return callsBack();
  }
  // Stops these calls.
  void stop() {
    if (_set != nullptr) {
      _set(stream(), Callback());
    }
  }

  // Returns true if the port is open here, and no other caller is between tryLock() and unlock(). Otherwise this
  // interrupts that caller, and its unlock() returns true. An object that was never begun, or was ended, takes no
  // bytes.
  bool tryLock() {
    if (_isBusy) {
      _wasCalled = true;
      return false;
    }
    _isBusy = true;
    _polls = static_cast<uint8_t>(_polls + 1);
    barrier();
    return true;
  }
  // Lets no caller in, as after end(), until unlock(): loop() calls this, which no caller of its own can have
  // interrupted.
  void hold() {
    _isBusy = true;
    barrier();
  }
  // Returns how often tryLock() has returned true, modulo 256.
  uint8_t polls() const { return _polls; }
  // Returns true if tryLock() has returned false meanwhile: bytes have come.
  bool unlock() {
    barrier();
    _isBusy = false;
    barrier();
    const bool wasCalled = _wasCalled;
    _wasCalled = false;
    return wasCalled;
  }

 private:
  using State = volatile stm32l0_uart_t;
  // Returns the core's state of the port. (A constructor may run before the port's.)
  using Set = State *(Stream &port, const Callback &callback);

  // A port that calls back, and has a buffer of its own. (USB calls back, too, but its bytes come in packets, late.)
  template <typename Class>
  static auto setterOf(Class *port, Rank<1>)
      -> decltype(port->onReceive(Callback()), port->begin(0, 0, static_cast<uint8_t *>(nullptr), 0),
                  static_cast<Set *>(nullptr)) {
    return set<Class>;
  }
  template <typename Class>
  static Set *setterOf(Class *, Rank<0>) {
    return nullptr;
  }

  // A callback is two words: an interrupt between the two would call the new function with the old object.
  template <typename Class>
  static State *set(Stream &port, const Callback &callback) {
    const uint32_t masked = __get_PRIMASK();
    __disable_irq();
    static_cast<Class &>(port).onReceive(callback);
    __set_PRIMASK(masked);
    return uartOf(static_cast<Class &>(port));
  }

  Set *const _set;               // null: the port cannot call back
  State *_uart = nullptr;        // null: the port does not tell when its line was idle
  volatile bool _isBusy = true;  // until the first unlock(), and from end() on
  volatile bool _wasCalled = false;
  volatile uint8_t _polls = 0;
  uint8_t _foundAt = 0;  // in the ring
  bool _foundIdle = false;
};

#else

// No port calls back: loop() polls.
class CallbackPort : public Port {
 public:
  static constexpr bool HasCallback = false;
  static constexpr bool callsBack() { return false; }
  static constexpr bool tellsIdle() { return false; }
  static constexpr bool isIdle() { return false; }
  static constexpr bool wasIdle() { return false; }
  static constexpr bool isAtHalf() { return false; }
  static void rearm() {}
  static constexpr unsigned waiting() { return 0; }
  template <typename Class>
  explicit CallbackPort(Class &port) : Port(port) {}
  template <typename Class>
  CallbackPort(Class &port, int8_t rx, int8_t tx) : Port(port, rx, tx) {}
  template <typename Object>
  bool start(void (Object::*)(), Object *) const {
    return false;
  }
  void stop() const {}
  // An object that is not open takes bytes only if the sketch polls it. (Checked here, it would cost an AVR's sensor a
  // tenth of its answers.)
  static constexpr bool tryLock() { return true; }
  static void hold() {}
  static constexpr uint8_t polls() { return 0; }
  static constexpr bool unlock() { return false; }
};

#endif

// loop() polls, or the port calls back. PolledByTimer does by a timer instead (timer/PolledByTimer.h), and has the same
// members.
struct PolledByLoop {
  // Keeps other contexts from polling, while it exists.
  struct Lock {
    explicit Lock(const PolledByLoop &) {}
  };

  // Fails to compile if a port of this class cannot be polled in this way.
  template <typename Port>
  static void check() {}

  template <typename Decoder>
  static void startPolling(Decoder &) {}
  static void stopPolling() {}
};

}  // namespace sbus
