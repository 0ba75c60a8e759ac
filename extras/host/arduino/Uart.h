// Uart: the board's serial ports. The program around the sketch decides what a port receives and where its bytes go
// (board/BoardPort.h).
#pragma once

#include "Callback.h"
#include "HardwareSerial.h"

// The receive buffer's size, under the core's name.
#define UART_RX_BUFFER_SIZE 64

namespace host {
class BoardPort;
}
struct _stm32l0_uart_t;

class Uart : public HardwareSerial {
 public:
  explicit Uart(int number);

  // Like flush(), begin() and end() wait until all written bytes have been sent.
  void begin(unsigned long baud) override;
  void begin(unsigned long baud, uint32_t config) override;
  void begin(unsigned long baud, uint8_t *buffer, size_t size);
  // Opens the port with the sketch's own receive buffer instead of the 64 bytes; with less than 16 bytes the port stays
  // closed.
  void begin(unsigned long baud, uint32_t config, uint8_t *buffer, size_t size);
  void end() override;
  int available() override;
  int peek() override;
  int read() override;
  int read(uint8_t *buffer, size_t size) override;

  // The transmit buffer has 64 places. write() waits for free places and returns the number of
  // bytes taken: all, or 0 if the port is closed; in an onReceive() callback it does not wait, and takes what fits. The
  // bytes are sent at the port's rate to --wire and --sent, or nowhere.
  int availableForWrite() override;  // free places; 0 if the port is closed
  void flush() override;             // in an onReceive() callback it does not wait
  size_t write(uint8_t byte) override;
  size_t write(const uint8_t *buffer, size_t size) override;
  using HardwareSerial::write;
  operator bool() override { return true; }

  // `callback` runs when received bytes have been handed over: once, then again after the next read. On the board this
  // happens at PendSV level, at any moment; here whenever the sketch asks for the time or polls a port.
  void onReceive(void (*callback)());
  void onReceive(Callback callback);

 private:
  host::BoardPort &port() const;

  const int _number;
  struct _stm32l0_uart_t *_uart;  // the core's state of the port, as on the board
};

extern Uart Serial1;
extern Uart Serial2;
extern Uart Serial3;
