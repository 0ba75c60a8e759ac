/// @file
/// All that differs between cores: how a port is opened and read, and what it holds. It names no board: it asks the
/// port's class and the core's macros what they can do. extras/docs/boards.md says what that comes to on each board.
#pragma once

#include <Arduino.h>
#include <stddef.h>

#include "sbus/LineTiming.h"

#if defined(SERIAL_SBUS)
#include <stm32l0_uart.h>  // the option bits that SERIAL_SBUS is made of; Arduino.h does not bring them in
#endif

namespace sbus {

// ---- The format: 8 bits, even parity, 2 stop bits; inverted where a format can say so

/// SERIAL_8E2: a macro, or an enumerator (ESP32, ESP8266). Teensy 3.2 and nRF52832 have only SERIAL_8E1; a receiver
/// takes the second stop bit for a pause.
#if defined(SERIAL_8E1) && !defined(SERIAL_8E2)
constexpr auto EvenConfig = SERIAL_8E1;
#else
constexpr auto EvenConfig = SERIAL_8E2;
#endif

/// "Inverted", in a format that cannot say so. No core uses this bit.
constexpr uint32_t InvertedBit = 0x80000000;

/// How begin() opens a port: inverted, if the port can do that.
#if defined(SERIAL_SBUS)  // STM32L0
constexpr uint32_t PortConfig = SERIAL_SBUS;
#elif defined(SERIAL_8E2_RXINV_TXINV)  // Teensy
constexpr uint32_t PortConfig = SERIAL_8E2_RXINV_TXINV;
#elif defined(SERIAL_8E1_RXINV_TXINV)  // Teensy 3.2
constexpr uint32_t PortConfig = SERIAL_8E1_RXINV_TXINV;
#else
constexpr uint32_t PortConfig = static_cast<uint32_t>(EvenConfig) | InvertedBit;
#endif

/// @cond  Not for sketches.

// ---- The receive buffer, in bytes

// Of a port that nothing is known of: the smallest there is (Pico). A buffer taken for larger than it is mixes frames.
constexpr unsigned SmallestBuffer = 32;

#if defined(UART_RX_BUFFER_SIZE)  // STM32L0
constexpr unsigned CoreBuffer = UART_RX_BUFFER_SIZE;
#elif defined(SERIAL_RX_BUFFER_SIZE)   // AVR, STM32
constexpr unsigned CoreBuffer = SERIAL_RX_BUFFER_SIZE;
#elif defined(SERIAL_BUFFER_SIZE)      // SAMD, SAM, nRF52, Uno R4
constexpr unsigned CoreBuffer = SERIAL_BUFFER_SIZE;
#elif defined(SERIAL_8E1_RXINV_TXINV)  // Teensy, whose headers do not say it
constexpr unsigned CoreBuffer = 64;
#else
constexpr unsigned CoreBuffer = SmallestBuffer;
#endif

// What a port is given that can be given one: 30 ms of a line without pauses.
constexpr unsigned WantedBuffer = 256;

// ---- Overloads

// Of several that fit, the one with the highest number is called.
template <int Number>
struct Choice : Choice<Number - 1> {};
// Fits all.
template <>
struct Choice<0> {};

// A format, as whatever type the begin() of a core wants: 8, 16 or 32 bits, or an enum.
struct Config {
  uint32_t value;  // as the core has it, or PortConfig
  // The line is to be inverted, and the format cannot say so.
  bool inverted() const { return (value & InvertedBit) != 0; }
  // The conversion.
  template <typename Format>
  operator Format() const {
    return static_cast<Format>(value & ~InvertedBit);
  }
};

// An ESP32 hands over 120 characters at once, so whole frames, and no pause is seen for sure. 8 of them, and the two
// idle ones that it waits for, are fewer than LineTiming.h expects. Before 2.0.3 it cannot be told.
template <typename Port>
auto limitBursts(Port &port, Choice<1>) -> decltype(port.setRxFIFOFull(0), void()) {
  port.setRxFIFOFull(8);
}
// Leaves it.
template <typename Port>
void limitBursts(Port &, Choice<0>) {
}

// arduino-pico: a queue of the wanted size.
template <typename Port>
auto enlarge(Port &port, Choice<1>) -> decltype(port.setFIFOSize(0), 0u) {
  port.setFIFOSize(WantedBuffer);
  return WantedBuffer;
}
// Its SerialPIO: the sketch has said the size; it is not known here.
template <typename Port>
unsigned enlarge(Port &, Choice<0>) {
  return SmallestBuffer;
}

// For so many characters a port waits for more before it hands over less than a full burst (LineTiming.h). The STM32L0's
// has an interrupt for an idle line (stm32l0_uart.c); of others nothing is known.
#if defined(SERIAL_SBUS)
template <typename Port>
auto idleCharacters(Port *port, Choice<1>) -> decltype(port->onReceive(nullptr), uint8_t{1}) {
  return 1;
}
#endif
template <typename Port>
uint8_t idleCharacters(Port *, Choice<0>) {
  return MostIdleCharacters;
}

// ---- Pins

// A port keeps its pins, whatever opens and closes it: nothing is passed on (4 bytes of flash less).
struct KeptPins {
  static constexpr bool AreGiven = false;
  template <typename Port>
  using Opened = Stream;
  KeptPins() {}
  KeptPins(int8_t, int8_t) {}
};

// A port that forgets its pins when it is opened or closed.
struct GivenPins {
  static constexpr bool AreGiven = true;
  template <typename Port>
  using Opened = Port;
  GivenPins() {}
  GivenPins(int8_t rx, int8_t tx) : rxPin(rx), txPin(tx) {}
  int8_t rxPin = -1, txPin = -1;  // below 0: the core's
  int8_t wasInverted = -1;        // how begin() has opened the port last; below 0: not yet
};

// ---- Kinds of ports, and how each is opened
//
// Inverts      begin() can invert the line
// BothWays     it can also be opened uninverted afterwards
// Buffer       size of the receive buffer, also of a port that the sketch has opened
// LosesOldest  a full buffer loses its oldest byte, not the newest
// Pins         what is kept for open(), which opens the port, and returns the buffer's size; 0: it stays what it was

struct Kind {
  static constexpr bool LosesOldest = false;
  using Pins = KeptPins;
};

// begin(baud, config), and the format says whether the line is inverted: AVR, SAMD, nRF52, mbed, Uno R4, Teensy,
// STM32L0.
struct ByFormat : Kind {
  static constexpr bool Inverts = (PortConfig & InvertedBit) == 0;
  static constexpr bool BothWays = Inverts;
  static constexpr unsigned Buffer = CoreBuffer;
  template <typename Port, typename Pins>
  static unsigned open(Port &port, unsigned long baud, Config config, Pins) {
    port.begin(baud, config);
    return Buffer;
  }
};

// A format of that type.
template <typename Format>
Format as(Format, Config config) {
  return config;
}

// The same, where two enums fit: SAM.
struct ByEnum : ByFormat {
  template <typename Port, typename Pins>
  static unsigned open(Port &port, unsigned long baud, Config config, Pins) {
    port.begin(baud, as(EvenConfig, config));
    return Buffer;
  }
};

// STM32, whose inversion cannot be taken back. The chips without (F1, F2, F4, L1) ignore it.
struct Stm32 : ByFormat {
#if defined(UART_ADVFEATURE_RXINVERT_INIT)
  static constexpr bool Inverts = true;
#endif
  static constexpr bool BothWays = false;
  template <typename Port, typename Pins>
  static unsigned open(Port &port, unsigned long baud, Config config, Pins pins) {
    if (config.inverted()) {
      port.setRxInvert();
      port.setTxInvert();
    }
    return ByFormat::open(port, baud, config, pins);
  }
};

// arduino-pico. A port takes its settings only while it is closed.
struct Pico : Kind {
  static constexpr bool Inverts = true, BothWays = true;
  static constexpr unsigned Buffer = SmallestBuffer;
  template <typename Port, typename Pins>
  static unsigned open(Port &port, unsigned long baud, Config config, Pins) {
    port.end();
    port.setInvertRX(config.inverted());
    port.setInvertTX(config.inverted());
    const unsigned size = enlarge(port, Choice<1>());
    port.begin(baud, config);
    return size;
  }
};

// ESP32. With another inversion begin() starts the driver again, which loses the pins (core 2.0.15 to 3.0 and later,
// uartEnd() in esp32-hal-uart.c). After end() it takes those that it is given, or the core's, on every core. A port
// that the sketch has opened is closed only if the pins are given: else they are not known.
struct Esp32 : Kind {
  static constexpr bool Inverts = true, BothWays = true;
  static constexpr unsigned Buffer = 128;
  using Pins = GivenPins;
  template <typename Port>
  static unsigned open(Port &port, unsigned long baud, Config config, GivenPins &pins) {
    if (port && (pins.rxPin >= 0 || pins.wasInverted == !config.inverted())) {
      port.end();
    }
    pins.wasInverted = config.inverted();
    const unsigned size = port.setRxBufferSize(WantedBuffer);
    port.begin(baud, config, pins.rxPin, pins.txPin, config.inverted());
    limitBursts(port, Choice<1>());
    return size;
  }
};

// ESP8266: mode 0 is SERIAL_FULL, and 1 the pin that sends. begin() always goes back to pins 3 and 1.
struct Esp8266 : Kind {
  static constexpr bool Inverts = true, BothWays = true;
  static constexpr unsigned Buffer = 128;
  static constexpr bool LosesOldest = true;  // uart.cpp:149; -DUART_DISCARD_NEWEST reaches the core alone
  using Pins = GivenPins;
  template <typename Port>
  static unsigned open(Port &port, unsigned long baud, Config config, GivenPins &pins) {
    port.begin(baud, config, Config{0}, 1, config.inverted());
    if (pins.rxPin >= 0) {
      port.pins(static_cast<uint8_t>(pins.txPin), static_cast<uint8_t>(pins.rxPin));
    }
    return port.getRxBufferSize();
  }
};

// Any Stream that is no hardware serial port: whoever knows it opens it.
struct OpenAlready : Kind {
  static constexpr bool Inverts = false, BothWays = false;
  static constexpr unsigned Buffer = SmallestBuffer;
  template <typename Port, typename Pins>
  static unsigned open(Port &, unsigned long, Config, Pins) {
    return 0;
  }
};

// The kind of a port; called by no one.
template <typename Port>
auto kindOf(Port *port, HardwareSerial *, Choice<5>) -> decltype(port->begin(0, Config(), -1, -1, true), Esp32());
template <typename Port>
auto kindOf(Port *port, HardwareSerial *, Choice<4>)
    -> decltype(port->begin(0, Config(), Config(), 1, true), Esp8266());
template <typename Port>
auto kindOf(Port *port, HardwareSerial *, Choice<4>) -> decltype(port->setInvertRX(true), Pico());
template <typename Port>
auto kindOf(Port *port, HardwareSerial *, Choice<4>) -> decltype(port->setRxInvert(), Stm32());
template <typename Port>
auto kindOf(Port *port, HardwareSerial *, Choice<3>) -> decltype(port->begin(0, Config()), ByFormat());
template <typename Port>
auto kindOf(Port *port, HardwareSerial *, Choice<2>) -> decltype(port->begin(0, EvenConfig), ByEnum());
template <typename Port>
OpenAlready kindOf(Port *, Stream *, Choice<1>);
// Its type.
template <typename Port>
using KindOf = decltype(kindOf(static_cast<Port *>(nullptr), static_cast<Port *>(nullptr), Choice<5>()));

// That of the ports which HardwareSerial itself describes: an ESP32's, an ESP8266's.
using CoreKind = KindOf<HardwareSerial>;

/// @endcond

/// True if begin() opens this port inverted; false: the line needs an inverter, or whoever opens the port inverts it.
template <typename Port>
constexpr bool inverts(Port &) {
  return KindOf<Port>::Inverts;
}

/// True if begin() opens this port inverted or uninverted, as it is told, and as often as it is told: an ESP32's or
/// ESP8266's on the pins of DecodeSBus's constructor, or on the core's.
template <typename Port>
constexpr bool opensBothWays(Port &) {
  return KindOf<Port>::BothWays;
}

/// @cond

// A port, and what its class can do.
class Port : private CoreKind::Pins {
 public:
  // Of any class.
  template <typename Class>
  explicit Port(Class &port) : Port(port, Pins()) {}

  // On these pins.
  template <typename Class>
  Port(Class &port, int8_t rx, int8_t tx) : Port(port, Pins(rx, tx)) {
    static_assert(KindOf<Class>::Pins::AreGiven,
                  "This port's pins cannot be chosen here: extras/docs/boards.md");
  }

  // Opens a hardware serial port. `config` is a format of the core, or PortConfig. Not with a baud that S.Bus never
  // has: cores divide by 0, or wait for 20 s (ESP32).
  void open(unsigned long baud, uint32_t config) {
    const unsigned half = baud > SlowestBaud ? _open(opened(*this), baud, config) : 0;
    if (half != 0) {
      _half = static_cast<uint16_t>(half);
    }
  }

  // Closes a hardware serial port.
  void close() {
    if (_hardware != nullptr) {
      _hardware->end();
    }
  }

  // How many bytes wait.
  int available() { return _stream.available(); }

  // Reads `size` bytes, which are there: never more than available() said, because the STM32L0's core would then write
  // past the end of `buffer`. Returns how many there were.
  __attribute__((always_inline)) int read(uint8_t *buffer, size_t size) {
    return read(_hardware, buffer, size, Choice<1>());
  }

  // Reads a byte that nobody wants.
  void skip() { _stream.read(); }

  // Half of the bytes that may have filled its receive buffer; a core may keep a place free (AVR).
  unsigned half() const { return _half; }

  // A full buffer loses what comes; or, of some cores, what has waited longest.
  bool losesNewest() const { return !CoreKind::LosesOldest || _hardware == nullptr; }

  // If so many wait, bytes before them may have been lost.
  bool mayHaveLostOldest(unsigned waiting) const { return !losesNewest() && waiting > 2u * _half - Late; }

  // So long it waits for more before it hands over what has come.
  uint8_t idleCharacters() const { return _idleCharacters; }

  // How many bytes it says that it takes at once; many cores say 0, whatever they take.
  int room() { return room(_stream, Choice<1>()); }

  // Writes them all; may wait.
  void write(const uint8_t *bytes, size_t size) { _stream.write(bytes, size); }

 private:
  using Pins = CoreKind::Pins;
  // Returns what half() is then; 0: as before.
  using Opened = Pins::Opened<Port>;
  using Open = unsigned(Opened &opened, unsigned long baud, uint32_t config);

  // So many bytes may come between available() and read(): 3.8 ms of interrupts at 100000 baud.
  static constexpr unsigned Late = 32;

  template <typename Class>
  Port(Class &port, Pins pins)
      : Pins(pins),
        _stream(port),
        _hardware(hardware(&port)),
        _open(open<Class>),
        _half(static_cast<uint16_t>(half(KindOf<Class>::Buffer))),
        _idleCharacters(sbus::idleCharacters(&port, Choice<1>())) {}

  static HardwareSerial *hardware(HardwareSerial *port) { return port; }
  static HardwareSerial *hardware(Stream *) { return nullptr; }

  Stream &opened(KeptPins &) { return _stream; }
  Port &opened(GivenPins &) { return *this; }
  static Stream &stream(Stream &port) { return port; }
  static Stream &stream(Port &port) { return port._stream; }
  static KeptPins pins(Stream &) { return KeptPins(); }
  static Pins &pins(Port &port) { return port; }

  static constexpr unsigned half(size_t buffer) { return buffer != 0 ? static_cast<unsigned>(buffer / 2 - 1) : 0; }

  template <typename Class>
  static unsigned open(Opened &opened, unsigned long baud, uint32_t config) {
    return half(KindOf<Class>::open(static_cast<Class &>(stream(opened)), baud, Config{config}, pins(opened)));
  }

  // In one call, where HardwareSerial can.
  template <typename Hardware>
  __attribute__((always_inline)) auto read(Hardware *port, uint8_t *buffer, size_t size, Choice<1>)
      -> decltype(static_cast<int>(port->read(buffer, size))) {
    return port != nullptr ? static_cast<int>(port->read(buffer, size)) : read(port, buffer, size, Choice<0>());
  }
  // Out of line: in line it would cost a poll of the STM32L0 24 cycles.
  template <typename Hardware>
  __attribute__((noinline)) int read(Hardware *, uint8_t *buffer, size_t size, Choice<0>) {
    size_t count = 0;
    for (int byte; count < size && (byte = _stream.read()) >= 0; count++) {
      buffer[count] = static_cast<uint8_t>(byte);
    }
    return static_cast<int>(count);
  }

  template <typename Class>
  static auto room(Class &port, Choice<1>) -> decltype(port.availableForWrite()) {
    return port.availableForWrite();
  }
  template <typename Class>
  static int room(Class &, Choice<0>) {  // SAM
    return 0;
  }

  Stream &_stream;
  HardwareSerial *const _hardware;  // null: any Stream
  Open *const _open;
  uint16_t _half;
  const uint8_t _idleCharacters;
};

/// @endcond

}  // namespace sbus
