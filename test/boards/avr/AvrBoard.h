// An Arduino board with a sketch on it: its chip, simulated by libsimavr, and what is connected to it. It notes all
// that goes over the S.Bus line, and all that the sketch does.
#pragma once

#include <simavr/avr_acomp.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "SecondLine.h"
#include "UsbHost.h"
#include "line/Line.h"
#include "line/LineSettings.h"
#include "line/uart/UartSampler.h"

namespace avr {

struct Pin {
  char port;
  int bit;
};

// A board: its chip, at 16 MHz, and where its core has what the tests look at.
struct Model {
  const char *name;  // of the folder with its sketches
  const char *chip;
  size_t receiver;  // the USART at the S.Bus line; None: the comparator, pin 7 or 5
  size_t console;   // the USART that prints; None: the USB does, or nothing
  Pin servos[4];    // the pins 2..5
  Pin led;
  Pin inputs[4];  // of PwmIn
  size_t eepromBytes;
};

constexpr size_t None = 4;  // a chip has at most four

constexpr Model Mega = {"mega",
                        "atmega2560",
                        1,
                        0,
                        {{'E', 4}, {'E', 5}, {'G', 5}, {'E', 3}},
                        {'B', 7},
                        {{'E', 4}, {'E', 5}, {'D', 1}, {'D', 0}},
                        4096};
constexpr Model Uno = {"uno", "atmega328p", None, 0, {{'D', 2}, {'D', 3}, {'D', 4}, {'D', 5}}, {'B', 5}, {}, 1024};
constexpr Model Leonardo = {"leonardo", "atmega32u4", 1,   None, {{'D', 1}, {'D', 0}, {'D', 4}, {'C', 6}},
                            {'C', 7},   {},           1024};

// Returns the board with the S.Bus line at its comparator instead.
constexpr Model atComparator(Model model) {
  model.receiver = None;
  return model;
}

// Returns the board with the line at its USART 0, which then prints nothing.
constexpr Model atPort(Model model) {
  model.receiver = 0;
  model.console = None;
  return model;
}

constexpr size_t SBusInput = 4;

// A level that comes to a pin from outside, one of Model::inputs, or SBusInput: a comparator's.
struct Level {
  double us;
  size_t pin;
  bool isHigh;
};

// The line at RX. In front of the pin, and after each TX pin, there is an inverter. A comparator has none.
struct Line {
  std::unique_ptr<line::Line> source;  // null: a wire from TX
  uint64_t cutUs = UINT64_MAX;         // when it falls silent
  bool isShared = false;               // TX is at the same wire, through a diode behind the inverter
  std::vector<Level> levels;           // at other pins, in the order of their times
  std::unique_ptr<line::Line> second;  // at another USART; null: there is none
  size_t secondUsart = 2;
};

// All times in us, as the sketch's micros() counts.
struct Printed {
  uint64_t us;  // when its first character begins
  std::string text;
};
struct Sent {
  uint64_t us;  // it begins
  uint8_t byte;
};
struct Report {
  uint64_t us;  // the PC takes it
  std::vector<uint8_t> bytes;
};
struct Pulse {
  uint64_t us;  // it begins
  double widthUs;
  double exactUs;  // when it begins
};

class AvrBoard {
 public:
  static constexpr size_t OC1A = 4, Led = 5;  // pins, beside 0..3

  // Runs the sketch of that board for `seconds`. The EEPROM begins with `eeprom`. Throws std::runtime_error if the
  // sketch has not been built, or crashes.
  AvrBoard(const Model &model, const std::string &sketch, Line line, double seconds, std::vector<uint8_t> eeprom = {});
  ~AvrBoard();
  AvrBoard(const AvrBoard &) = delete;  // libsimavr has been given its address
  AvrBoard &operator=(const AvrBoard &) = delete;

  const std::vector<line::Character> &characters() const { return _characters; }  // on the line
  const std::vector<line::Character> &secondCharacters() const { return _second->characters(); }
  const std::vector<uint64_t> &opened() const { return _opened; }   // when the line's port was
  const std::vector<Printed> &printed() const { return _printed; }  // lines on Serial, or over USB, without their ends
  const std::vector<Sent> &sent() const { return _sent; }           // on the ports that do not print
  const std::vector<Pulse> &pulses(size_t pin) const { return _pulses[pin]; }  // 0..3: the pins 2..5; OC1A; Led
  const std::vector<Report> &reports() const { return _reports; }              // of the joystick, over USB
  std::vector<uint8_t> eeprom() const;

  // What the line says about a board that shares it.
  std::string report() const { return _line.source->report(); }

  // Returns how many bytes lay always between variables and stack.
  size_t unusedRam() const;

  // Returns what was wrong with the ports, "USART1: baud rate, format", and with the memory; empty if nothing was.
  std::string mistakes() const;

 private:
  static uint8_t dataRead(avr_t *avr, avr_io_addr_t address, void *board);
  static avr_cycle_count_t shifted(avr_t *avr, avr_cycle_count_t when, void *transmitter);
  static avr_cycle_count_t levelChanges(avr_t *avr, avr_cycle_count_t when, void *board);
  static avr_cycle_count_t edgeComes(avr_t *avr, avr_cycle_count_t when, void *board);
  static avr_cycle_count_t characterThrough(avr_t *avr, avr_cycle_count_t when, void *board);

  uint64_t clockUs(avr_cycle_count_t cycle) const;
  avr_irq_t *port(const Pin &pin) const;
  avr_irq_t *written(avr_io_addr_t address) const;
  void on(avr_irq_t *irq, std::function<void(uint32_t)> callback);
  void run(double seconds);
  void load(const std::string &sketch);
  void findUsarts();
  void mendTimers();
  avr_acomp_t *addComparator();
  void mendComparator();
  void compare(uint8_t control);
  void setLine(bool isHigh);
  void draw(const line::Character &character);
  line::LineSettings settings(size_t number) const;
  void control(size_t number, uint32_t value);
  void open();
  bool next(line::Character &character);
  void receive(const line::Character &character);
  void showReceived();
  void send(size_t number, uint8_t byte);
  void print(uint8_t byte);
  void edge(size_t pin, bool high);

  // A shift register, and UDR behind it.
  struct Transmitter {
    avr_uart_t *usart;
    avr_cycle_count_t character;  // cycles
    bool isSending, hasNext;
  };

  const Model _model;
  avr_t *_avr;
  avr_uart_t *_usarts[None] = {};  // null: the chip has no such
  avr_uart_t *_usart = nullptr;    // the receiver
  Transmitter _transmitters[None] = {};
  UsbHost _usb;
  std::deque<std::function<void(uint32_t)>> _callbacks;  // libsimavr has been given their addresses
  avr_cycle_count_t _clockZero = 0;                      // micros() counts from here, some before setup()

  size_t _variablesEnd = 0;  // address

  Line _line;
  std::deque<line::Character> _wire;  // sent by TX, and on its way
  uint64_t _wireUs = 0;               // when the last of them is complete
  line::Character _next;              // on its way,
  bool _isComing = false;             // if there is one
  line::UartSampler _sampler;
  std::deque<line::Character> _received;  // and not yet read
  bool _isOpen = false;
  line::LineSettings _settings;  // then
  avr_acomp_t *_comparator = nullptr;
  avr_acomp_t _added = {};
  bool _isHigh = false;  // its output
  struct Edge {
    avr_cycle_count_t cycle;
    bool isHigh;
  };
  std::deque<Edge> _edges;  // that come to it
  size_t _nextLevel = 0;
  std::unique_ptr<SecondLine> _second;
  avr_cycle_count_t _rose[6] = {};
  Printed _row{};  // printed so far

  std::vector<line::Character> _characters;
  std::vector<uint64_t> _opened;
  std::vector<Printed> _printed;
  std::vector<Sent> _sent;
  std::vector<Report> _reports;
  std::vector<Pulse> _pulses[6];
  std::string _mismatch[None];  // of the ports' settings, when characters came or were sent
  size_t _lost = 0;             // characters that were not read in time
};

}  // namespace avr
