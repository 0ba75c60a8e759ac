// The functions and objects of the board's core, built on host::Board.

#include "stm32l0_system.h"
#include "stm32l0_uart.h"

#include "board/Board.h"

// Last: its macros break the C++ library.
#include "Arduino.h"

using host::Board;

namespace {

// Returns the board, after the time to read the clock or poll a port. It must not be 0: otherwise a sketch that waits
// in a loop would never return.
Board &polled() {
  constexpr uint64_t PollUs = 1;
  Board::instance().spend(PollUs);
  return Board::instance();
}

// Waits until a place in the transmit buffer becomes free.
void waitForPlace(const host::BoardTransmitter &transmitter) {
  Board &board = Board::instance();
  const uint64_t nowUs = board.clock().nowUs();
  board.spend(max(transmitter.nextUs(), nowUs + 1) - nowUs);
}

}  // namespace

uint32_t millis() { return polled().clock().millis(); }

uint32_t micros() { return polled().clock().micros(); }

void delay(unsigned long ms) { Board::instance().spend(uint64_t{1000} * static_cast<uint32_t>(ms)); }

void delayMicroseconds(unsigned int us) { Board::instance().spend(us); }

void yield() { polled(); }

// The simulated board does not sleep.
void stm32l0_system_register(stm32l0_system_notify_t *, stm32l0_system_callback_t, void *, uint32_t) {}

void stm32l0_system_unregister(stm32l0_system_notify_t *) {}

void noInterrupts() { Board::instance().enableInterrupts(false); }

void interrupts() { Board::instance().enableInterrupts(true); }

void pinMode(uint32_t pin, uint32_t mode) {
  Board::instance().pins().setMode(pin, static_cast<host::Pins::Mode>(mode));
}

void digitalWrite(uint32_t pin, uint32_t value) { Board::instance().pins().write(pin, value != 0); }

int digitalRead(uint32_t pin) {
  return Board::instance().pulsePins().isHigh(pin) || Board::instance().pins().isHigh(pin) ? 1 : 0;
}

namespace {

int analogBits = 10;

}  // namespace

void analogReadResolution(int bits) {
  if (bits >= 1 && bits <= 12) {
    analogBits = bits;
  }
}

int analogRead(uint32_t) { return 1 << (analogBits - 1); }

void analogWrite(uint32_t pin, uint32_t value) {
  Board::instance().pins().use(host::Pins::Analog, pin, static_cast<int>(value));
}

void tone(uint32_t pin, uint32_t frequency, uint32_t) {
  if (frequency != 0) {
    Board::instance().pins().use(host::Pins::Tone, pin, static_cast<int>(frequency));
  }
}

void noTone(uint32_t) {}

uint32_t pulseIn(uint32_t pin, uint32_t state, uint32_t timeout) {
  const bool high = state != 0;
  const uint32_t startUs = micros();
  // Waits while the pin is, or is not, in that state. Returns false after the timeout.
  const auto passes = [=](bool in) {
    while ((digitalRead(pin) != 0) == (in == high)) {
      if (micros() - startUs >= timeout) {
        return false;
      }
    }
    return true;
  };
  if (!passes(true) || !passes(false)) {
    return 0;
  }
  const uint32_t beginUs = micros();
  return passes(true) ? micros() - beginUs : 0;
}

void attachInterrupt(uint32_t pin, void (*callback)(), uint32_t mode) {
  Board::instance().pulsePins().onEdge(pin, callback, static_cast<host::PulsePins::Edge>(mode));
}

void detachInterrupt(uint32_t pin) { Board::instance().pulsePins().onEdge(pin, nullptr, host::PulsePins::Change); }

Uart Serial1(1);
Uart Serial2(2);
Uart Serial3(3);

Uart::Uart(int number) : _number(number), _uart(&Board::instance().port(number).uart().state()) {}

host::BoardPort &Uart::port() const { return Board::instance().port(_number); }

void Uart::begin(unsigned long baud) { begin(baud, SERIAL_8N1); }

void Uart::begin(unsigned long baud, uint32_t config) { begin(baud, config, nullptr, 0); }

void Uart::begin(unsigned long baud, uint8_t *buffer, size_t size) { begin(baud, SERIAL_8N1, buffer, size); }

void Uart::begin(unsigned long baud, uint32_t config, uint8_t *buffer, size_t size) {
  flush();
  Board::instance().open(_number, host::portSettings(baud, config), buffer, size);
}

void Uart::end() {
  flush();
  port().close();
}

int Uart::available() { return polled().port(_number).uart().available(); }

int Uart::peek() { return polled().port(_number).uart().peek(); }

int Uart::read() { return polled().port(_number).uart().read(); }

int Uart::read(uint8_t *buffer, size_t size) { return polled().port(_number).uart().read(buffer, size); }

int Uart::availableForWrite() { return polled().port(_number).transmitter().availableForWrite(); }

size_t Uart::write(uint8_t value) { return write(&value, 1); }

size_t Uart::write(const uint8_t *buffer, size_t size) {
  Board &board = polled();
  host::BoardTransmitter &transmitter = port().transmitter();
  size_t done = transmitter.write(board.clock().nowUs(), buffer, size);
  while (done < size && transmitter.isOpen() && !board.inCallback()) {
    waitForPlace(transmitter);
    done += transmitter.write(board.clock().nowUs(), buffer + done, size - done);
  }
  return done;
}

void Uart::flush() {
  host::BoardTransmitter &transmitter = port().transmitter();
  while (!transmitter.idle() && !Board::instance().inCallback()) {
    waitForPlace(transmitter);
  }
}

void Uart::onReceive(void (*callback)()) { onReceive(Callback(callback)); }

void Uart::onReceive(Callback callback) {
  port().onReceive([callback] { callback.call(); }, callback.listener());
}

UsbSerial Serial;

void UsbSerial::begin(unsigned long) {
  Board::instance().output().begin();
  Board::instance().input().begin();
}

void UsbSerial::begin(unsigned long baud, uint32_t) { begin(baud); }

int UsbSerial::available() {
  Board &board = polled();
  return board.input().available(board.clock().nowUs());
}

int UsbSerial::peek() {
  Board &board = polled();
  return board.input().peek(board.clock().nowUs());
}

int UsbSerial::read() {
  Board &board = polled();
  return board.input().read(board.clock().nowUs());
}

int UsbSerial::read(uint8_t *buffer, size_t size) {
  Board &board = polled();
  return board.input().read(board.clock().nowUs(), buffer, size);
}

size_t UsbSerial::write(uint8_t value) { return write(&value, 1); }

size_t UsbSerial::write(const uint8_t *buffer, size_t size) { return Board::instance().output().write(buffer, size); }
