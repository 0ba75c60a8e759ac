/// @file
/// Which core this is, where its port's class and its macros do not tell enough. No other file of the library names a
/// core or a chip, except SBusUart.h (boards) and sbus/Text.h (an AVR's flash).
#pragma once

#include <Arduino.h>

#if defined(SERIAL_SBUS)   // STM32L0
#include <stm32l0_system.h>  // what the core tells before it sleeps
#include <stm32l0_uart.h>    // the option bits that SERIAL_SBUS consists of, and the registers; Arduino.h lacks them
#elif defined(__AVR__)
#define SBUS_AVR
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
