// A simulated UART for the port class of a core: Facts and Settings hold what differs between cores. C++11, since the
// stand-ins' Arduino.h includes it.
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace sim {

// Calls that crash a core: on a closed port, or begin(0). Bits of Facts::faults.
enum : unsigned { End = 1, Available = 2, Write = 4, Room = 8, NoBaud = 16 };
// Characters with such an error never reach a buffer. Bits of Facts::discarded.
enum : unsigned { Parity = 1, Framing = 2 };
// The pins on which a core's port receives and sends if it is given none.
constexpr int CorePin = 3, CoreTxPin = 4;

struct Facts {
  unsigned buffer;       // bytes that wait to be read
  unsigned burst;        // they come this many at once, or when the line has been idle
  unsigned idle;         // ... for this many characters
  unsigned transmitter;  // bytes that write() takes at once; 0: it waits until each has been sent
  unsigned faults;
  bool ring;  // the bursts end at places of a ring, so gaps do not move them
  unsigned discarded;
};

// What a full buffer loses. Fifo: bytes that do not fit are stashed, later ones wait in a FIFO, and when that is full,
// all of it is lost (esp-idf v5.1.4, components/driver/uart/uart.c:923 and 982).
enum Drops { Newest, Oldest, Fifo };

struct Settings {
  unsigned long baud;
  unsigned evenStops;  // stop bits of 8 bits with even parity; 0: another format
  bool rxInverted, txInverted;
};

// Converts `config` to Settings::evenStops.
template <typename Config>
unsigned evenStops(Config config, Config e1, Config e2) {
  return config == e2 ? 2 : config == e1 ? 1 : 0;
}

class Uart {
 public:
  // Not wired: receives nothing, and what it sends is printed().
  explicit Uart(const Facts &facts, Drops drops = Newest, bool wired = true);

  // Opens with an empty buffer. Half duplex: TX is the wire; it is driven only while the port sends, and not heard
  // then.
  void open(const Settings &settings, bool isHalfDuplex = false);
  void change(const Settings &settings);  // of an open port, or opens it
  void close();
  void cut();                           // closes it, without waiting for what is to be sent
  void attach(int pin) { _pin = pin; }  // below 0: nothing is attached
  bool isOpen() const { return _open; }
  void crash() const;
  const Settings &settings() const { return _settings; }
  bool discards(unsigned error) const { return (_facts.discarded & error) != 0; }
  void setBuffer(size_t size) { _size = static_cast<unsigned>(size); }
  unsigned size() const { return _size; }
  void setBurst(unsigned burst) { _burst = burst; }
  unsigned burst() const { return _burst; }
  // While interrupts are off, this many characters are kept, and later ones are lost. micros() is made of interrupts
  // that come every `overflowUs`, of which one is kept; 0: it runs on.
  void keep(unsigned characters, unsigned overflowUs = 0) {
    _keeps = characters;
    _overflowUs = overflowUs;
  }
  void turnOff(uint64_t us);                 // interrupts, for this time
  void lookIntoFifo() { _seesFifo = true; }  // available() counts what waits for a burst, and read() takes it
  bool isHalfDuplex() const { return _isHalfDuplex; }
  unsigned behind() const { return _drops == Fifo ? FifoSize + _burst : 0; }  // bytes that wait behind a full buffer

  int available();
  int peek() { return available() > 0 ? _count > 0 ? _buffer[_first] : _fifo[0] : -1; }
  int read();
  int read(uint8_t *buffer, size_t size);

  unsigned fifo();           // characters that the driver has not taken
  unsigned pending() const;  // bytes that have not been sent
  int room();                // free bytes of the transmitter
  size_t write(uint8_t byte);
  void flush();

 private:
  static constexpr unsigned Largest = 512, FifoSize = 128;

  static constexpr uint64_t Never = UINT64_MAX;

  void receive();
  void handOver();
  void raise(uint64_t us);
  void interrupts(uint64_t us);
  bool hears() const;
  void drive(bool drives) const;
  bool isDeaf(uint64_t beginUs, uint64_t endUs, uint8_t &value) const;
  void fault(unsigned what) const;

  const Facts _facts;
  const Drops _drops;
  const bool _wired;
  Settings _settings = {};
  bool _open = false, _isHalfDuplex = false, _seesFifo = false;
  int _pin = CorePin;
  uint64_t _openedUs = 0, _lastUs = 0, _freeNs = 0;
  unsigned _size, _burst;
  uint8_t _buffer[Largest] = {}, _fifo[Largest] = {};
  unsigned _keeps = 0, _overflowUs = 0;
  unsigned _first = 0, _count = 0, _filled = 0, _stashed = 0, _position = 0;
  unsigned _taken = 0;                           // of _filled, by a late driver
  uint64_t _takesUs = Never, _countsUs = Never;  // when it takes them, and when it counts them
};

void print(char c);  // what a sketch says over USB
void inPort();       // takes as long as a method of the port, where a core locks it

// What the tests expect of a core.
struct Known {
  bool inverts;      // its ports can invert
  unsigned stops;    // stop bits that it sends
  unsigned waitsUs;  // EncodeSBus::write(), every 9 ms
  bool counts;       // it says how much it takes: then write() never waits
};

}  // namespace sim
