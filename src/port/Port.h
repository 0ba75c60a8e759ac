/// @file
/// Reads and writes a serial port of any class.
#pragma once

#include <Arduino.h>
#include <stddef.h>
#include <stdint.h>

#include "DmaSender.h"
#include "PortKind.h"

namespace sbus {

#if defined(SBUS_PIN)
// Closes `port` if it is an SBusPin. Null in a sketch without one, which pays 26 bytes for it if it calls end(),
// else 6.
__attribute__((weak)) void closePin(Stream &port);
#endif

// A serial port of any class.
class Port : private CoreKind::Pins {
 public:
  // An SBusPin announces a byte that it does not hand over where it has lost some; a sensor cannot have one, as it
  // sends.
#if defined(SBUS_PIN)
  static constexpr bool TellsLoss = true;
#else
  static constexpr bool TellsLoss = false;
#endif

  // Remembers `port`.
  template <typename Class>
  explicit Port(Class &port) : Port(port, Pins()) {}

  // Remembers `port` and its pins.
  template <typename Class>
  Port(Class &port, int8_t rx, int8_t tx) : Port(port, Pins(rx, tx)) {
    static_assert(KindOf<Class>::Pins::AreGiven,
                  "This version of the core cannot choose this port's pins: extras/docs/boards.md");
  }

  // Opens a hardware serial port. `config` is a format of the core, or Inverted. Ignores a baud rate far below S.Bus:
  // cores would divide by 0, or wait for 20 s (ESP32).
  void open(unsigned long baud, uint32_t config) {
    flush();
    const unsigned halfCapacity = baud > SlowestBaud ? _open(opened(*this), baud, config) : 0;
    if (halfCapacity != 0) {
      _half = static_cast<uint16_t>(halfCapacity);
    }
  }

  // From now on open() opens `port` on a single wire, TX's, and always inverted, whatever its format.
  template <typename Class>
  void onSingleWire(Class &) {
    static_assert(KindOf<Class>::SingleWire != 0, "This port has no single wire: a diode, extras/docs/answering.md");
    _open = openSingleWire<Class>;
  }

  // Closes an SBusPin, or a hardware serial port once it has sent what it holds.
  void close() {
    if (_hardware != nullptr) {
      flush();
#if defined(SBUS_END_CUTS)
      _hardware->flush();
#endif
      _hardware->end();
    }
#if defined(SBUS_PIN)
    if (closePin != nullptr) {
      closePin(_stream);
    }
#endif
  }

  // Returns how many bytes wait; if bytes may have been lost between them, only those before the loss.
  int available() {
    const int waiting = _stream.available();
    const int most = 2 * _half + 1;
    return AvailableIncludesFifo && _hardware != nullptr && waiting > most ? most : waiting;
  }

  // Reads up to `size` bytes, at most what available() returned: the STM32L0's core would write past the end of
  // `buffer`. Returns how many it has read.
  __attribute__((always_inline)) int read(uint8_t *buffer, size_t size) {
    return read(_hardware, buffer, size, Rank<1>());
  }

  // Returns the time that polls are told by, us.
  static uint32_t now() { return micros(); }

  // Returns the port.
  Stream &stream() { return _stream; }

  // Returns half of the bytes that fill the receive buffer. A core may keep one place free (AVR).
  unsigned halfCapacity() const { return _half; }

  // Returns true if a full buffer loses the newest byte, false if the oldest.
  bool losesNewest() const { return !CoreKind::LosesOldest || _hardware == nullptr; }

  // Returns true if this port tells what it has lost: an SBusPin, or another Stream.
  bool tellsLoss() const { return TellsLoss && _hardware == nullptr; }

  // Returns true if bytes may have been lost before the `waiting` ones.
  bool mayHaveLostOldest(unsigned waiting) const { return !losesNewest() && waiting + ArrivesMeanwhile > 2u * _half; }

  // Returns for how many characters the port waits for more before it hands over less than a burst, or seems to wait,
  // as the clock counts.
  uint8_t idleCharacters(unsigned long baud) const {
    return static_cast<uint8_t>(_idleCharacters + (ClockStep != 0 ? ClockStep * (baud / 1000) / 12000 + 1 : 0));
  }

  // Returns how many bytes the port reports it takes at once. Many cores report 0 always.
  int room() {
#if defined(SBUS_DMA_SENDER)
    if (DmaSender::knows(_hardware)) {
      return static_cast<int>(DmaSender::room(_hardware));
    }
#endif
    return room(_stream, Rank<1>());
  }

  // Writes all bytes, and may wait. Returns false if it sends nothing.
  bool write(const uint8_t *bytes, size_t size) {
#if defined(SBUS_DMA_SENDER)
    if (DmaSender::knows(_hardware)) {
      return DmaSender::send(_hardware, bytes, size);
    }
#endif
    _stream.write(bytes, size);
    return true;
  }

 private:
  using Pins = CoreKind::Pins;
  using Opened = Pins::Opened<Port>;
  // Returns the new halfCapacity(), or 0 if that has not changed.
  using Open = unsigned(Opened &opened, unsigned long baud, uint32_t config);

  // Bytes that may come between available() and read(): 3.8 ms of interrupts at 100000 baud.
  static constexpr unsigned ArrivesMeanwhile = 32;

  template <typename Class>
  Port(Class &port, Pins pins)
      : Pins(pins),
        _stream(port),
        _hardware(hardware(&port)),
        _open(open<Class>),
        _half(static_cast<uint16_t>(halfCapacity(KindOf<Class>::Buffer))),
        _idleCharacters(sbus::idleCharacters(KindOf<Class>::Notice)) {}

  // Waits until the frame that any object has given to the port has gone out; a core waits only for its own write().
  // In a sketch that sends nothing DmaSender::flush() is null, and the sender and the board's other ports are not
  // linked: 580 bytes of flash and 780 of RAM less, for these 20 bytes (real core, example AllChannels).
  void flush() const {
#if defined(SBUS_DMA_SENDER)
    if (DmaSender::flush != nullptr) {
      DmaSender::flush(_hardware);
    }
#endif
  }

  static HardwareSerial *hardware(HardwareSerial *port) { return port; }
  static HardwareSerial *hardware(Stream *) { return nullptr; }

  Stream &opened(NoPins &) { return _stream; }
  Port &opened(PinPair &) { return *this; }
  static Stream &stream(Stream &port) { return port; }
  static Stream &stream(Port &port) { return port._stream; }
  static NoPins pins(Stream &) { return NoPins(); }
  static Pins &pins(Port &port) { return port; }

  static constexpr unsigned halfCapacity(size_t buffer) {
    return buffer != 0 ? static_cast<unsigned>(buffer / 2 - 1) : 0;
  }

  template <typename Class>
  static unsigned open(Opened &opened, unsigned long baud, uint32_t config) {
    return halfCapacity(KindOf<Class>::open(static_cast<Class &>(stream(opened)), baud, Config{config}, pins(opened)));
  }

  template <typename Class>
  static unsigned openSingleWire(Opened &opened, unsigned long baud, uint32_t) {
    return open<Class>(opened, baud, KindOf<Class>::SingleWire);
  }

  // Reads in one call, where HardwareSerial can.
  template <typename Hardware>
  __attribute__((always_inline)) auto read(Hardware *port, uint8_t *buffer, size_t size, Rank<1>)
      -> decltype(static_cast<int>(port->read(buffer, size))) {
    return port != nullptr ? static_cast<int>(port->read(buffer, size)) : read(port, buffer, size, Rank<0>());
  }
  // Not inlined: that would cost a poll of the STM32L0 24 cycles.
  template <typename Hardware>
  __attribute__((noinline)) int read(Hardware *, uint8_t *buffer, size_t size, Rank<0>) {
    uint8_t *next = buffer;
    for (int byte; size != 0 && (byte = _stream.read()) >= 0; size--) {
      *next++ = static_cast<uint8_t>(byte);
    }
    return static_cast<int>(next - buffer);
  }

  template <typename Class>
  static auto room(Class &port, Rank<1>) -> decltype(port.availableForWrite()) {
    return port.availableForWrite();
  }
  template <typename Class>
  static int room(Class &, Rank<0>) {  // SAM
    return 0;
  }

  Stream &_stream;
  HardwareSerial *const _hardware;  // null for any other Stream
  Open *_open;
  uint16_t _half;
  const uint8_t _idleCharacters;
};

}  // namespace sbus
