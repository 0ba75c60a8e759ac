/// @file
/// The kinds of serial ports, recognised by what their classes can do, and how each is opened.
#pragma once

#include <Arduino.h>
#include <stdint.h>

#include "../sbus/Frame.h"
#include "../sbus/LineTiming.h"
#include "../sbus2/FrameEnd.h"
#include "Core.h"

namespace sbus {

// ---- How many bytes a port holds, how many it hands over at once, and how long it holds these back

// The size assumed for an unknown port: the smallest of all cores (Pico). Too large a size would let lost bytes go
// unnoticed.
constexpr unsigned BufferMin = 32;

#if defined(UART_RX_BUFFER_SIZE)  // STM32L0
constexpr unsigned CoreBuffer = UART_RX_BUFFER_SIZE;
#elif defined(SERIAL_RX_BUFFER_SIZE)   // AVR, STM32
constexpr unsigned CoreBuffer = SERIAL_RX_BUFFER_SIZE;
#elif defined(SERIAL_BUFFER_SIZE)      // SAMD, SAM, nRF52, Uno R4
constexpr unsigned CoreBuffer = SERIAL_BUFFER_SIZE;
#elif defined(SERIAL_8E1_RXINV_TXINV)  // Teensy, whose headers do not tell the size
constexpr unsigned CoreBuffer = 64;
#else
constexpr unsigned CoreBuffer = BufferMin;
#endif

// A Teensy 4 also counts the bytes of its FIFO, which came after what its full buffer has lost (cores 7f107ee,
// teensy4/HardwareSerial.cpp:449, 642).
#if defined(SBUS_TEENSY4)
constexpr bool AvailableIncludesFifo = true;
#else
constexpr bool AvailableIncludesFifo = false;
#endif

// The size that begin() asks for where a port lets it: 30 ms of a line without gaps.
constexpr unsigned WantedBuffer = 256;

// The threshold of an ESP32's RX FIFO, characters: the default of 120 hides the gaps between frames. With the two idle
// characters that it waits for, that is less than LineTiming.h assumes.
constexpr uint8_t WantedBurst = 8;

// Returns for how many characters a port waits for more before it hands over less than a burst (LineTiming.h).
constexpr uint8_t idleCharacters(ReceiveNotice notice) {
  return notice == ReceiveNotice::EachCharacter || notice == ReceiveNotice::Fifo ? 0
         : notice == ReceiveNotice::Dma16                                        ? 1
                                                                                 : IdleCharactersMax;
}

// ---- Pins

// For a port that keeps its pins when it is opened and closed: open() needs none (4 bytes of flash less).
struct NoPins {
  static constexpr bool AreGiven = false;
  template <typename Port>
  using Opened = Stream;
  NoPins() {}
  NoPins(int8_t, int8_t) {}
};

// For a port that forgets its pins when it is opened or closed.
struct PinPair {
  static constexpr bool AreGiven = true;
  template <typename Port>
  using Opened = Port;
  PinPair() {}
  PinPair(int8_t rx, int8_t tx) : rxPin(rx), txPin(tx) {}
  int8_t rxPin = -1, txPin = -1;  // -1: the core's pins
  int8_t wasInverted = -1;        // how begin() opened the port last; -1: not yet
};

// ---- The kinds of ports. To add a core, add a kind here, and an overload of kindOf() that recognises its port.
//
// Inverts      open() can invert the line
// BothWays     open() can open the port uninverted afterwards
// Buffer       bytes, the size of the receive buffer of a port that the sketch has opened
// Sends        the port can send
// LosesOldest  a full buffer loses its oldest byte instead of the newest
// Notice       when the port counts a character as waiting
// Pins         what open() needs to remember
// SingleWire   the format for a single inverted wire, TX's, which the port drives only while it sends; 0: it cannot
// open()       opens the port. Returns the size of its receive buffer, or 0 if that has not changed

struct Kind {
  static constexpr bool Sends = true;
  static constexpr bool LosesOldest = false;
  static constexpr ReceiveNotice Notice = ReceiveNotice::Unknown;
  static constexpr uint32_t SingleWire = 0;
  using Pins = NoPins;
};

// AVR, SAMD, mbed, Uno R4, Teensy, STM32L0: begin(baud, config), where the format says whether to invert.
struct BeginWithConfig : Kind {
  static constexpr bool Inverts = (Inverted & InvertedBit) == 0;
  static constexpr bool BothWays = Inverts;
  static constexpr unsigned Buffer = CoreBuffer;
#if defined(SERIAL_RX_BUFFER_SIZE)  // AVR (HardwareSerial_private.h:101), STM32 (uart.c, HAL_UART_Receive_IT of 1)
  static constexpr ReceiveNotice Notice = ReceiveNotice::EachCharacter;
#endif
  template <typename Port, typename Pins>
  static unsigned open(Port &port, unsigned long baud, Config config, Pins) {
    port.begin(baud, config);
    return Buffer;
  }
};

// Returns the format as the type of the first argument.
template <typename Format>
Format as(Format, Config config) {
  return config;
}

#if defined(SBUS_TEENSY4)
// Teensy 4: its interrupt at the end of the last character releases the wire (cores 7f107ee,
// teensy4/HardwareSerial.cpp:700). The other cores have no half duplex, or cannot do this with it:
// extras/docs/answering.md.
struct Teensy4 : BeginWithConfig {
  // available() looks into the FIFO (teensy4/HardwareSerial.cpp:449).
  static constexpr ReceiveNotice Notice = ReceiveNotice::EachCharacter;
  static constexpr uint32_t SingleWire = Inverted | SERIAL_HALF_DUPLEX;
};
#endif

#if defined(SBUS_STM32L0)
// STM32L0: its UART hands over halves of its ring (stm32l0_uart.c:53, 280, 653; variant.cpp,
// stm32l0_usart1_rx_fifo[32]).
struct Stm32L0 : BeginWithConfig {
  static constexpr ReceiveNotice Notice = ReceiveNotice::Dma16;
};
#endif

#if defined(SBUS_NRF52)
// nRF52: begin() takes the nearest rate of a table, 115200 baud, and changes nothing of an open port
// (Adafruit_nRF52_Arduino fa129c2, Uart.cpp:75, 92). The chip's registers take any: bolderflight/sbus#58 and
// arduino/ArduinoCore-mbed#60 received S.Bus this way.
struct Nrf52 : BeginWithConfig {
  template <typename Port, typename Pins>
  static unsigned open(Port &port, unsigned long baud, Config config, Pins pins) {
    constexpr uint32_t Clock = 16000000, Step = 0x1000;  // the registers' known values are multiples of it
    BeginWithConfig::open(port, baud, config, pins);
    NRF_UARTE_Type *const registers = registersOf(port);
    registers->CONFIG = (registers->CONFIG & UARTE_CONFIG_HWFC_Msk) | static_cast<uint16_t>(config);
    registers->BAUDRATE = static_cast<uint32_t>((uint64_t{baud} << 32) / Clock + Step / 2) / Step * Step;
    return Buffer;
  }
  template <typename Port>
  static NRF_UARTE_Type *registersOf(Port &port) {
#if defined(PIN_SERIAL2_RX)
    if (&port == &Serial2) {
      return NRF_UARTE1;
    }
#endif
    static_cast<void>(port);
    return NRF_UARTE0;
  }
};
#endif

// SAM, where two enums fit.
struct BeginWithEnum : BeginWithConfig {
  template <typename Port, typename Pins>
  static unsigned open(Port &port, unsigned long baud, Config config, Pins) {
    port.begin(baud, as(Uninverted, config));
    return Buffer;
  }
};

// STM32: its inversion cannot be undone. F1, F2, F4 and L1 chips cannot invert, and ignore it.
struct Stm32 : BeginWithConfig {
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
    return BeginWithConfig::open(port, baud, config, pins);
  }
};

// arduino-pico: its port takes settings only while it is closed. available() looks into the FIFO, and the UART does not
// check the second stop bit (RP2040 datasheet, 4.2.2).
struct Pico : Kind {
  static constexpr bool Inverts = true, BothWays = true;
  static constexpr unsigned Buffer = BufferMin;
  static constexpr ReceiveNotice Notice = ReceiveNotice::Fifo;
  template <typename Port, typename Pins>
  static unsigned open(Port &port, unsigned long baud, Config config, Pins) {
    port.end();
    port.setInvertRX(config.inverted());
    port.setInvertTX(config.inverted());
    const unsigned size = enlarge(port, Rank<1>());
    port.begin(baud, config);
    return size;
  }
  // Returns the size that the port has then. A SerialPIO keeps the size that the sketch gave it, which is unknown here.
  template <typename Port>
  static auto enlarge(Port &port, Rank<1>) -> decltype(port.setFIFOSize(0), 0u) {
    port.setFIFOSize(WantedBuffer);
    return WantedBuffer;
  }
  template <typename Port>
  static unsigned enlarge(Port &, Rank<0>) {
    return BufferMin;
  }
};

// ESP32. If the inversion changes, begin() restarts the driver, which loses the pins (core 2.0.15 to 3.0 and later,
// uartEnd() in esp32-hal-uart.c). After end() every core takes the pins that it is given, or its own. A port that the
// sketch has opened is closed only if the pins are given, because otherwise they are unknown.
//
// No bound of its Notice is known, whatever setRxFIFOFull() and setRxTimeout() say. The driver's interrupt takes
// characters out of the FIFO, notes no time, and lies in flash, since Arduino's libraries do not set
// CONFIG_UART_ISR_IN_IRAM: it waits while flash is written, for milliseconds, and for other interrupts, and available()
// shows nothing meanwhile. onReceive() is called later still, by a task. Core 3: esp-idf 01b912a,
// components/driver/uart/uart.c:32, arduino-esp32 8edd529, HardwareSerial.cpp:19; core 2: esp-idf 002cd29,
// components/driver/uart.c:40.
struct Esp32 : Kind {
  static constexpr bool Inverts = true, BothWays = true;
  static constexpr unsigned Buffer = 128;
  using Pins = PinPair;
  template <typename Port>
  static unsigned open(Port &port, unsigned long baud, Config config, PinPair &pins) {
    if (port && (pins.rxPin >= 0 || pins.wasInverted == !config.inverted())) {
      port.end();
    }
    pins.wasInverted = config.inverted();
    const unsigned size = port.setRxBufferSize(WantedBuffer);
    port.begin(baud, config, pins.rxPin, pins.txPin, config.inverted());
    limitBursts(port, WantedBurst, Rank<1>());
    return size;
  }
  // Sets how many characters make a burst. Cores before 2.0.3 cannot.
  template <typename Port>
  static auto limitBursts(Port &port, uint8_t burst, Rank<1>) -> decltype(port.setRxFIFOFull(0), void()) {
    port.setRxFIFOFull(burst);
  }
  template <typename Port>
  static void limitBursts(Port &, uint8_t, Rank<0>) {}
};

// ESP8266: mode 0 is SERIAL_FULL, and 1 is the TX pin. begin() always returns to pins 3 and 1.
struct Esp8266 : Kind {
  static constexpr bool Inverts = true, BothWays = true;
  static constexpr unsigned Buffer = 128;
  static constexpr bool LosesOldest = true;  // uart.cpp:149; -DUART_DISCARD_NEWEST reaches the core alone
  using Pins = PinPair;
  template <typename Port>
  static unsigned open(Port &port, unsigned long baud, Config config, PinPair &pins) {
    port.begin(baud, config, Config{0}, 1, config.inverted());
    if (pins.rxPin >= 0) {
      port.pins(static_cast<uint8_t>(pins.txPin), static_cast<uint8_t>(pins.rxPin));
    }
    return port.getRxBufferSize();
  }
};

// Any Stream that is no hardware serial port: the sketch opens it.
struct SketchOpens : Kind {
  static constexpr bool Inverts = false, BothWays = false;
  static constexpr unsigned Buffer = BufferMin;
  template <typename Port, typename Pins>
  static unsigned open(Port &, unsigned long, Config, Pins) {
    return 0;
  }
};

// Declared only: its return type is the kind of a port. A class that has one itself names it.
template <typename Port>
auto kindOf(Port *, Stream *, Rank<2>) -> typename Port::PortKind;
template <typename Port>
auto kindOf(Port *port, HardwareSerial *, Rank<5>) -> decltype(port->begin(0, Config(), -1, -1, true), Esp32());
template <typename Port>
auto kindOf(Port *port, HardwareSerial *, Rank<4>) -> decltype(port->begin(0, Config(), Config(), 1, true), Esp8266());
template <typename Port>
auto kindOf(Port *port, HardwareSerial *, Rank<4>) -> decltype(port->setInvertRX(true), Pico());
template <typename Port>
auto kindOf(Port *port, HardwareSerial *, Rank<4>) -> decltype(port->setRxInvert(), Stm32());
template <typename Port>
auto kindOf(Port *port, HardwareSerial *, Rank<3>) -> decltype(port->begin(0, Config()), BeginWithConfig());
template <typename Port>
auto kindOf(Port *port, HardwareSerial *, Rank<2>) -> decltype(port->begin(0, Uninverted), BeginWithEnum());
template <typename Port>
SketchOpens kindOf(Port *, Stream *, Rank<1>);
#if defined(SBUS_STM32L0)
template <typename Port>
auto kindOf(Port *port, HardwareSerial *, Rank<4>)
    -> decltype(port->onReceive(nullptr), port->begin(0, Config()), Stm32L0());
#endif
#if defined(SBUS_TEENSY4)
Teensy4 kindOf(HardwareSerialIMXRT *port, HardwareSerial *, Rank<5>);
#endif
#if defined(SBUS_NRF52)
Nrf52 kindOf(Uart *port, HardwareSerial *, Rank<5>);
#endif
// The kind of a port of this class.
template <typename Port>
using KindOf = decltype(kindOf(static_cast<Port *>(nullptr), static_cast<Port *>(nullptr), Rank<5>()));

// The kind of the core's own ports.
using CoreKind = KindOf<HardwareSerial>;

}  // namespace sbus
