/// @file
/// Which core this is, where its port's class and its macros do not tell enough, and how it names the format of an
/// S.Bus line: 8 data bits, even parity, 2 stop bits, inverted. No other file of the library names a core or a chip,
/// except SBusBoard.h (boards) and sbus/Text.h (an AVR's flash).
#pragma once

#include <Arduino.h>
#include <stdint.h>

#if defined(ARDUINO_ARCH_stm32l0)  // ArduinoCore-stm32l0 0.0.9 and later; ArduinoCore-stm32wb also has SERIAL_SBUS
#define SBUS_STM32L0
#include <stm32l0_system.h>  // what the core tells before it sleeps
#include <stm32l0_uart.h>    // the option bits, and the registers; Arduino.h lacks them
#elif defined(__AVR__)
#define SBUS_AVR
// The pin of the analog comparator that can capture a line (SBusPin.h): AIN1, beside timer 1. A 32U4 has none.
#if F_CPU == 16000000
#if defined(__AVR_ATmega328P__) || defined(__AVR_ATmega328__) || defined(__AVR_ATmega328PB__) || \
    defined(__AVR_ATmega168__) || defined(__AVR_ATmega168P__)
#define SBUS_PIN 7
#elif defined(__AVR_ATmega2560__) || defined(__AVR_ATmega1280__)
#define SBUS_PIN 5
#elif defined(__AVR_ATmega1284P__) || defined(__AVR_ATmega644P__)
#define SBUS_PIN 3  // PB3, as MightyCore counts
#endif
#endif
#elif defined(ARDUINO_ARCH_RP2040) && !defined(ARDUINO_ARCH_MBED) && !defined(__FREERTOS) && PICO_SDK_VERSION_MAJOR >= 2
#define SBUS_RP2040  // arduino-pico from 4.0 on; with FreeRTOS loop() is a task that may change its core
#elif defined(ARDUINO_ARCH_ESP32) && defined(ESP_ARDUINO_VERSION_MAJOR)
#define SBUS_ESP32  // arduino-esp32 from 2.0 on
#elif defined(CORE_TEENSY)
#define SBUS_TEENSY  // 3, LC or 4
#if defined(__IMXRT1062__)
#define SBUS_IMXRT  // 4
#endif
#elif defined(ARDUINO_ARCH_SAMD)
#define SBUS_SAMD
#elif defined(ARDUINO_ARCH_NRF52)
#define SBUS_NRF52  // Adafruit's core, and Seeed's copy of it
#endif

#if defined(SERIAL_HALF_DUPLEX) && defined(__IMXRT1062__)
#define SBUS_TEENSY4
// The port of a Teensy 4, by this name from November 2023 on (cores 70d3da9), when half duplex had just got a pull-down
// for inverted lines instead of a pull-up (99d2922).
class HardwareSerialIMXRT;
#endif

// The end() of these cores cuts off what the port is sending: arduino-pico 387294c, SerialUART.cpp:319;
// ArduinoCore-samd 993398c, Uart.cpp:79; Adafruit_nRF52_Arduino fa129c2, Uart.cpp:163; ArduinoCore-renesas 99f8ee4,
// Serial.cpp:307, while the last character is under way (133); core 3 of arduino-esp32, esp32-hal-uart.c, uartEnd(),
// which detaches the pins.
#if defined(SBUS_RP2040) || defined(SBUS_ESP32) || defined(SBUS_SAMD) || defined(SBUS_NRF52) || \
    defined(ARDUINO_ARCH_RENESAS)
#define SBUS_END_CUTS
#endif

namespace sbus {

// The steps in which micros() counts, us, if they are longer than a character. An nRF52's is the tick of FreeRTOS, of
// 1/1024 s (Adafruit_nRF52_Arduino fa129c2, delay.h:60).
#if defined(SBUS_NRF52)
constexpr uint32_t ClockStep = 977;
#else
constexpr uint32_t ClockStep = 0;
#endif

// Orders overloads: of those that compile, the one with the highest number is called.
template <int Number>
struct Rank : Rank<Number - 1> {};
template <>
struct Rank<0> {};

/// The core's SERIAL_8E2, a macro or an enumerator (ESP32, ESP8266). Teensy 3.2 and nRF52832 have only SERIAL_8E1: they
/// see the second stop bit as an idle line.
#if defined(SERIAL_8E1) && !defined(SERIAL_8E2)
constexpr auto Uninverted = SERIAL_8E1;
#else
constexpr auto Uninverted = SERIAL_8E2;
#endif

/// Marks an inverted line in a format that has no bit for it. No core uses this bit.
constexpr uint32_t InvertedBit = 0x80000000;

/// The format that begin() opens a port with: inverted, if the port can invert.
#if defined(SBUS_STM32L0)
constexpr uint32_t Inverted = SERIAL_8E2 | STM32L0_UART_OPTION_RX_INVERT | STM32L0_UART_OPTION_TX_INVERT;
#elif defined(SERIAL_8E2_RXINV_TXINV)  // Teensy
constexpr uint32_t Inverted = SERIAL_8E2_RXINV_TXINV;
#elif defined(SERIAL_8E1_RXINV_TXINV)  // Teensy 3.2
constexpr uint32_t Inverted = SERIAL_8E1_RXINV_TXINV;
#else
constexpr uint32_t Inverted = static_cast<uint32_t>(Uninverted) | InvertedBit;
#endif

// A format that converts to the type of the core's begin(): 8, 16 or 32 bits, or an enum.
struct Config {
  uint32_t value;  // a format of the core, or Inverted
  // Returns true if the port must be told separately to invert the line.
  bool inverted() const { return (value & InvertedBit) != 0; }
  // Returns the core's format.
  template <typename Format>
  operator Format() const {
    return static_cast<Format>(value & ~InvertedBit);
  }
};

}  // namespace sbus
