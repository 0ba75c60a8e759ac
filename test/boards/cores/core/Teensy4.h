// github.com/PaulStoffregen/cores 7f107ee: teensy4/HardwareSerial.h and .cpp. Characters with errors are kept
// (.cpp:638), begin() clears what waits (130), end() of a closed port does nothing (259). (Its uint32_t is an unsigned
// long.)
//
// Half duplex: RX is the TX pin (221), which has a pull-down if the format inverts TX (217), otherwise a pull-up (156).
// Each begin() decides on it (144), and releases the pin (224). write() drives the pin (578), before it waits for room;
// the interrupt at the end of the last character releases it (700), so it is driven on while interrupts are off, and
// end() waits for that (260). Whether the port hears itself then the core does not say: both are tried.
#pragma once

#include "../Stream.h"

#define CORE_TEENSY
#define __IMXRT1062__
#define SERIAL_8N1 0x00
#define SERIAL_8E1 0x06
#define SERIAL_8E2 0x106
#define SERIAL_8E1_RXINV_TXINV 0x36
#define SERIAL_8E2_RXINV_TXINV 0x136
#define SERIAL_HALF_DUPLEX 0x200

class HardwareSerial : public Stream {
 public:
  virtual void begin(unsigned long baud, uint16_t format = 0) = 0;
  virtual void end() = 0;
  virtual int availableForWrite() = 0;
  using Print::write;
  virtual operator bool() = 0;
};
class HardwareSerialIMXRT : public Simulated<HardwareSerial> {
 public:
  // 64 places, of which one stays free. An interrupt empties the FIFO when it holds more than 2 (199), or when the line
  // was idle; available() and read() look into it before (449, 533). Behind the transmitter's 63 places stands a FIFO
  // of 4, and what is being sent (685). A closed port has no clock.
  HardwareSerialIMXRT() : Simulated<HardwareSerial>({63, 3, 1, 63 + 4 + 1, sim::Available | sim::Write, false, 0}) {
    uart.lookIntoFifo();
    uart.keep(4 + 1, 1000);  // the FIFO, and the shift register; micros() goes on by 1 ms (delay.c:118)
  }
  void begin(unsigned long baud, uint16_t format = 0) override {
    const unsigned stops = (format & 0x100) != 0 ? 2 : 1;
    uart.open({baud, (format & 0xF) == SERIAL_8E1 ? stops : 0, (format & 0x10) != 0, (format & 0x20) != 0},
              (format & SERIAL_HALF_DUPLEX) != 0);
  }
  void end() override { uart.close(); }
  int availableForWrite() override { return uart.room() < 63 ? uart.room() : 63; }
  operator bool() override { return true; }
};
extern HardwareSerialIMXRT Serial1, Serial2;

extern uint32_t SCB_ICSR;

// The counter of cycles runs on while micros() stands still. (Uart.cpp)
uint32_t cycleCount();
#define F_CPU_ACTUAL 600000000u
#define ARM_DWT_CYCCNT cycleCount()

constexpr sim::Known Core = {true, 2, 0, true};
