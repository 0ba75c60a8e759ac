// github.com/esp8266/Arduino 3.2.0-dev (f946290): cores/esp8266/HardwareSerial.h and .cpp, uart.cpp. Serial1 only
// sends, so the receiver is on Serial. Characters with errors are kept (uart.cpp:432). begin() ends an open port
// (HardwareSerial.cpp:46) and goes back to pin 3 (uart.cpp:638); end() of a closed one does nothing (726).
#pragma once

#include "../Stream.h"

#define ESP8266
#define ARDUINO_ARCH_ESP8266
#define EEPROM_EMULATED
#define SBUS_PORT Serial
#define PINS_GIVEN 13, 15
enum SerialConfig { SERIAL_8N1 = 0x1c, SERIAL_8E1 = 0x1e, SERIAL_8E2 = 0x3e };
enum SerialMode { SERIAL_FULL, SERIAL_RX_ONLY, SERIAL_TX_ONLY };

class HardwareSerial : public Simulated<Stream> {
 public:
  // One place stays free (uart.cpp:155); a full buffer loses its oldest byte (149). available() sees the FIFO (229).
  explicit HardwareSerial(int number = 0)
      : Simulated<Stream>({255, 1, 1, 128, sim::NoBaud, false, 0}, sim::Oldest, number == 0) {}
  void begin(unsigned long baud) { begin(baud, SERIAL_8N1, SERIAL_FULL, 1, false); }
  void begin(unsigned long baud, SerialConfig config) { begin(baud, config, SERIAL_FULL, 1, false); }
  void begin(unsigned long baud, SerialConfig config, SerialMode mode) { begin(baud, config, mode, 1, false); }
  void begin(unsigned long baud, SerialConfig config, SerialMode mode, uint8_t pin) {
    begin(baud, config, mode, pin, false);
  }
  void begin(unsigned long baud, SerialConfig config, SerialMode mode, uint8_t, bool invert) {
    const unsigned stops = sim::evenStops(config, SERIAL_8E1, SERIAL_8E2);
    uart.open({baud, mode == SERIAL_FULL ? stops : 0, invert, invert});
    _rx = 3;
    uart.attach(_rx);
  }
  void end() { uart.close(); }
  bool swap() { return pins(_rx == 3 ? 15 : 1, _rx == 3 ? 13 : 3); }
  bool pins(uint8_t tx, uint8_t rx) {  // uart.cpp:854
    if (!uart.isOpen() || !((rx == 13 && tx == 15) || (rx == 3 && (tx == 1 || tx == 2)))) {
      return false;
    }
    _rx = rx;
    uart.attach(rx);
    return true;
  }
  unsigned getRxBufferSize() { return 256; }  // their size_t has 32 bits
  using Simulated<Stream>::read;
  int read(uint8_t *buffer, size_t size) { return uart.read(buffer, size); }
  int availableForWrite() override { return uart.room(); }
  operator bool() const { return uart.isOpen(); }

 private:
  uint8_t _rx = 3;
};
extern HardwareSerial Serial, Serial1;
#define Serial2 Serial1  // it has no third one

constexpr sim::Known Core = {true, 2, 0, true};
