/// @file
/// How long after its end the port reports a character: needed to find gaps, and to tell an S.BUS2 sensor when a frame
/// ended.
#pragma once

#include <Arduino.h>
#include <stdint.h>

#include "../sbus/Frame.h"
#include "Core.h"

namespace sbus {

// Half of the STM32L0's ring, characters: the port hands over a half at once (variant.cpp, stm32l0_usart1_rx_fifo[32]).
constexpr unsigned HalfRing = 16;

// The moment at which a port counts a character as waiting.
enum class ReceiveNotice : uint8_t {
  Unknown,        // at an unknown time: a sensor does not answer there (except on an ESP32: below)
  EachCharacter,  // by an interrupt for each, in its first stop bit
  Fifo,           // in its first stop bit, even while interrupts are off
  Dma16,          // with the sixteenth (HalfRing) since the last time, or when the line was idle for a character
};

// The time from the end of a character's last stop bit until it waits, us.
struct NoticeDelay {
  int16_t least, most;
};

// Returns the lag of a character when the port has handed over `found` characters at once.
inline NoticeDelay noticeDelayOf(ReceiveNotice notice, unsigned found) {
  constexpr int16_t Early = -15;  // the middle of the first of two stop bits
  constexpr int16_t Late = 10;    // an interrupt comes late by so much while others run
  constexpr int16_t Shown = -10;  // the end of the first stop bit
  const int16_t idle = notice == ReceiveNotice::Dma16 && found % HalfRing != 0 ? CharacterTime : 0;
  return {static_cast<int16_t>(idle + Early),
          static_cast<int16_t>(notice == ReceiveNotice::Fifo ? Shown : idle + Late)};
}

// The bounds of the time at which a frame ended, us.
struct FrameEnd {
  uint32_t earliest, latest;
};

// Returns when a frame ended if its end was among the `found` characters of a poll at `by`, but not of one at `before`.
inline FrameEnd frameEndOf(ReceiveNotice notice, unsigned found, uint32_t before, uint32_t by) {
  if (notice == ReceiveNotice::Unknown) {
    return {by - UINT16_MAX, by};
  }
  const NoticeDelay lag = noticeDelayOf(notice, found);
  return {before - static_cast<uint32_t>(lag.most), by - static_cast<uint32_t>(lag.least)};
}

// Returns when a frame ended, for a port that calls back at once: it did at `before` and at `by`, with `found`
// characters between the two. Other interrupts may delay a callback, so both must agree on the end, and it is no later
// than the earlier of the two says.
inline FrameEnd frameEndOfCallback(ReceiveNotice notice, unsigned found, uint32_t before, uint32_t by) {
  constexpr int32_t MostHeldUp = 40;  // us
  const uint32_t end = by - (notice == ReceiveNotice::Dma16 && found % HalfRing != 0 ? CharacterTime : 0);
  const uint32_t same = before + found * CharacterTime;
  const int32_t heldUp = static_cast<int32_t>(end - same);
  if (notice == ReceiveNotice::Unknown || heldUp > MostHeldUp || heldUp < -MostHeldUp) {
    return {by - UINT16_MAX, by};
  }
  const uint32_t latest = heldUp > 0 ? same : end;
  return {latest - MostHeldUp, latest};
}

#if defined(SBUS_STM32L0)  // stm32l0_uart.c:53, 280, 653
template <typename Port>
auto noticeOf(Port *port, HardwareSerial *, Rank<2>) -> decltype(port->onReceive(nullptr), ReceiveNotice()) {
  return ReceiveNotice::Dma16;
}
#elif defined(SERIAL_RX_BUFFER_SIZE)  // AVR (HardwareSerial_private.h:101), STM32 (uart.c, HAL_UART_Receive_IT of 1)
template <typename Port>
ReceiveNotice noticeOf(Port *, HardwareSerial *, Rank<1>) {
  return ReceiveNotice::EachCharacter;
}
#elif defined(SBUS_TEENSY4)  // whose available() looks into the FIFO (cores 7f107ee, teensy4/HardwareSerial.cpp:449)
inline ReceiveNotice noticeOf(HardwareSerialIMXRT *, HardwareSerial *, Rank<1>) { return ReceiveNotice::EachCharacter; }
#endif
// arduino-pico: its available() looks into the FIFO. Its UART does not check the second stop bit (RP2040 datasheet,
// 4.2.2).
template <typename Port>
auto noticeOf(Port *port, HardwareSerial *, Rank<2>) -> decltype(port->setInvertRX(true), ReceiveNotice()) {
  return ReceiveNotice::Fifo;
}
// An SBusPin shows a character from its first stop bit on.
template <typename Port>
auto noticeOf(Port *, Stream *, Rank<1>) -> decltype(typename Port::PortKind(), ReceiveNotice()) {
  return ReceiveNotice::EachCharacter;
}
// For an ESP32 no bound is known, whatever setRxFIFOFull() and setRxTimeout() say. The driver's interrupt takes
// characters out of the FIFO, notes no time, and lies in flash, since Arduino's libraries do not set
// CONFIG_UART_ISR_IN_IRAM: it waits while flash is written, for milliseconds, and for other interrupts, and available()
// shows nothing meanwhile. onReceive() is called later still, by a task. So SlotTimer looks at the FIFO itself
// (FifoWatch.h). Core 3: esp-idf 01b912a, components/driver/uart/uart.c:32, arduino-esp32 8edd529,
// HardwareSerial.cpp:19; core 2: esp-idf 002cd29, components/driver/uart.c:40.
template <typename Port>
ReceiveNotice noticeOf(Port *, Stream *, Rank<0>) {
  return ReceiveNotice::Unknown;
}

}  // namespace sbus
