/// @file
/// Names this board's S.Bus port, so that the examples run on every board unchanged. No other file of the library knows
/// boards; extras/docs/boards.md has the table. A sketch that names its port itself does not need this header.
///
///     #include <SBusBoard.h>
///     DecodeSBus dSBus(SBUS_UART);
#pragma once

#include <Arduino.h>

/// @def SBUS_UART
/// The arguments of the constructors of DecodeSBus and EncodeSBus: the port, and RX and TX where pins must be named,
/// such as `Serial1, 16, 17`. To choose others, define it before this header.

/// @def SBUS_SECOND_UART
/// Likewise another port, for a second receiver; not defined where the board has none. To choose another, define it
/// before this header.

/// @def SBUS_SECOND_TAKES_USB
/// 1 if SBUS_SECOND_UART is the port that Serial prints on, as on an Uno: it is then defined only for a sketch that has
/// defined SBUS_MAY_TAKE_USB, and must not print. Otherwise 0.

/// @def SBUS_FREE_PINS
/// Four pins that SBUS_UART leaves free. To choose others, define it before this header.

/// @def SBUS_TAKES_USB
/// 1 if SBUS_UART is also the port that Serial prints on: an ESP8266 cannot both print and receive.
/// Then this header rejects the sketch, unless the sketch has defined SBUS_MAY_TAKE_USB before; it must then not print.
/// Otherwise 0.

/// @def SBUS_TAKES_TIMER
/// 1 if SBUS_UART is an SBusPin, which takes timer 1: the library Servo does not work beside it. Otherwise 0.

#include "port/Core.h"

#if !defined(SBUS_UART)
#if defined(ARDUINO_ARCH_NRF52840) || defined(ARDUINO_ARDUINO_NANO33BLE) || defined(ARDUINO_ARCH_CH32V) || \
    defined(ARDUINO_ARCH_CH32)
#error "DecodeSBus: this board's core cannot receive S.Bus. Choose a board of the first table in extras/docs/boards.md"
#define SBUS_UART Serial1

#elif defined(ESP8266)
#define SBUS_UART Serial, 13, 15  // Serial1 only sends
#define SBUS_TAKES_USB 1

#elif defined(ESP32)
#if defined(ARDUINO_NANO_ESP32)
#define SBUS_UART Serial1, D0, D1
#elif defined(ARDUINO_XIAO_ESP32C3) || defined(ARDUINO_XIAO_ESP32C6) || defined(ARDUINO_XIAO_ESP32S3)
#define SBUS_UART Serial1, D7, D6
#elif defined(CONFIG_IDF_TARGET_ESP32C3)
#define SBUS_UART Serial1, 10, 3  // 11 to 17 belong to the flash
#elif defined(CONFIG_IDF_TARGET_ESP32C6) || defined(CONFIG_IDF_TARGET_ESP32H2)
#define SBUS_UART Serial1, 10, 11  // 15 and more of an H2 belong to the flash, 16 and 17 of a C6 to Serial
#elif defined(CONFIG_IDF_TARGET_ESP32S2) || defined(CONFIG_IDF_TARGET_ESP32S3)
#define SBUS_UART Serial1, 16, 17
#elif defined(CONFIG_IDF_TARGET_ESP32) || !defined(ESP_ARDUINO_VERSION_MAJOR)  // core 1 has no other chip
#if defined(BOARD_HAS_PSRAM) || defined(ARDUINO_ESP32_PICO) || defined(ARDUINO_M5Stick_C)
#define SBUS_UART Serial1, 25, 26  // a WROVER has its PSRAM on 16 and 17, and a PICO-D4 its flash
#else
#define SBUS_UART Serial1, 16, 17
#endif
#else
#error "DecodeSBus: write '#define SBUS_UART Serial1, RX, TX' first, with two free pins: extras/docs/boards.md"
#define SBUS_UART Serial1
#endif

#elif defined(SBUS_PIN) && !defined(HAVE_HWSERIAL1)  // Uno R3, Nano, Pro Mini: the only port prints
#include "SBusPin.h"
#define SBUS_UART sbus::Shared<SBusPin>::port
#define SBUS_TAKES_TIMER 1

// AVR, Nano Every and STM32duino say which ports exist; for DxCore and megaTinyCore the chip does (USART1).
#elif defined(NRF52832_XXAA) || \
    (defined(ARDUINO_ARCH_AVR) || defined(ARDUINO_ARCH_MEGAAVR)) && !defined(HAVE_HWSERIAL1) && !defined(USART1)
#define SBUS_UART Serial
#define SBUS_TAKES_USB 1

#elif defined(ARDUINO_ARCH_STM32) && !defined(HAVE_HWSERIAL1)
#error "DecodeSBus: the sketch must make this board's Serial1: extras/docs/boards.md, 'STM32: a port that is not there'"
#define SBUS_UART Serial

#elif defined(ARDUINO_ARCH_STM32) && SERIAL_UART_INSTANCE == 1 && !defined(HAVE_SERIALUSB)
#define SBUS_UART Serial1  // Serial is the same port
#define SBUS_TAKES_USB 1

#else
#define SBUS_UART Serial1
#endif
#endif

#if !defined(SBUS_TAKES_TIMER)
#define SBUS_TAKES_TIMER 0
#endif

#if !defined(SBUS_SECOND_UART)
#if defined(ARDUINO_NANO_ESP32) || defined(ARDUINO_XIAO_ESP32S3)
#define SBUS_SECOND_UART Serial2, D8, D9
#elif defined(CONFIG_IDF_TARGET_ESP32S3)
#define SBUS_SECOND_UART Serial2, 18, 8
#elif defined(CONFIG_IDF_TARGET_ESP32) || defined(ESP32) && !defined(ESP_ARDUINO_VERSION_MAJOR)
#define SBUS_SECOND_UART Serial2, 32, 33
#elif defined(HAVE_HWSERIAL2) || defined(CORE_TEENSY) || defined(ARDUINO_ARCH_stm32l0) || defined(ARDUINO_ARCH_SAM) || \
    (defined(ARDUINO_ARCH_RP2040) && !defined(ARDUINO_ARCH_MBED))
#define SBUS_SECOND_UART Serial2
#elif SBUS_TAKES_TIMER && defined(SBUS_MAY_TAKE_USB)
#define SBUS_SECOND_UART Serial
#define SBUS_SECOND_TAKES_USB 1
#endif
#endif

#if !defined(SBUS_SECOND_TAKES_USB)
#define SBUS_SECOND_TAKES_USB 0
#endif

#if !defined(SBUS_TAKES_USB)
#define SBUS_TAKES_USB 0
#elif !defined(SBUS_MAY_TAKE_USB)
#error "DecodeSBus: one port cannot receive and print. Take the example Led or Servos: extras/docs/boards.md, One port"
#endif

#if !defined(SBUS_FREE_PINS)
#if defined(ESP8266)
#define SBUS_FREE_PINS 4, 5, 12, 14
#elif defined(ARDUINO_NANO_ESP32)
#define SBUS_FREE_PINS D2, D3, D4, D5
#elif defined(ARDUINO_XIAO_ESP32C3) || defined(ARDUINO_XIAO_ESP32C6) || defined(ARDUINO_XIAO_ESP32S3)
#define SBUS_FREE_PINS D1, D2, D3, D4
#elif defined(CONFIG_IDF_TARGET_ESP32C6)
#define SBUS_FREE_PINS 20, 21, 22, 23
#elif defined(CONFIG_IDF_TARGET_ESP32H2)
#define SBUS_FREE_PINS 1, 4, 5, 12
#elif defined(CONFIG_IDF_TARGET_ESP32C3) || defined(CONFIG_IDF_TARGET_ESP32S2) || defined(CONFIG_IDF_TARGET_ESP32S3)
#define SBUS_FREE_PINS 4, 5, 6, 7
#elif defined(ESP32)
#define SBUS_FREE_PINS 18, 19, 21, 22
#elif defined(MEGATINYCORE)
#define SBUS_FREE_PINS 0, 1, 2, 3  // 4 and 5 are RX and TX of a chip with 14 pins
#elif defined(ADAFRUIT_FEATHER_M0) || defined(ADAFRUIT_FEATHER_M0_EXPRESS) || defined(ADAFRUIT_FEATHER_M4_EXPRESS)
#define SBUS_FREE_PINS 5, 6, 10, 11  // a Feather has no 2 and 3
#else
#define SBUS_FREE_PINS 2, 3, 4, 5
#endif
#endif

namespace sbus {

/// @cond  For SBUS_UART.

// One object of a class of ports, for all files of a sketch. A sketch that does not use it has none.
template <typename Port>
struct Shared {
  static Port port;
};
template <typename Port>
Port Shared<Port>::port;

/// @endcond

/// Returns the port of SBUS_UART, without the pins.
template <typename Port, typename... Pins>
constexpr Port &portOf(Port &port, Pins...) {
  return port;
}

}  // namespace sbus
