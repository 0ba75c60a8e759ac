// What is around the port: the time, the line, what was sent and printed.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "Uart.h"
#include "line/Line.h"

namespace sim {

struct Sent {
  uint64_t beginUs, endUs;
  uint8_t value;
  Settings settings;
};

// A time for which TX of a port drove its pin; while it still does, `untilUs` is World::Never.
struct Driven {
  uint64_t fromUs, untilUs;
};

struct Level {
  uint64_t us;
  bool isHigh;
};

// A library that takes in two frames in one call has finished with the first before it reads the second.
class Reader {
 public:
  virtual void beforeRead() = 0;
};

// The other end of the wire, if it answers to what the board sends.
class Wire {
 public:
  virtual void until(uint64_t us) = 0;  // puts on the line all that ends by then
  virtual void sent(const Sent &sent) = 0;
};

struct World {
  static constexpr uint64_t Never = UINT64_MAX;
  uint64_t nowUs = 1000000;

  // Interrupts come while time passes. The alarm has the lowest priority.
  void pass(uint64_t us);
  unsigned masked = 0;      // no interrupts
  unsigned locked = 0;      // a mutex is held, for which the alarm waits,
  bool alarmWaits = true;   // unless it only looks
  unsigned locks = 0;       // how often that was
  unsigned othersUs = 0;    // how long other interrupts take, every 997 us
  unsigned randomUs = 0;    // the most that they take, at random times instead
  uint64_t othersAtUs = 0;  // the next of them
  uint64_t alarmAtUs = Never;
  bool inAlarm = false;
  uint64_t offFromUs = 0, offUntilUs = 0;  // interrupts were off (Uart::turnOff())
  uint64_t stoodStillUs = 0;               // so long has micros() stood still
  bool inUart = false;  // the alarm may have interrupted the port's own interrupt: the port must not be read
  void (*alarm)() = nullptr;

  // What comes in: characters of even parity, at the pin.
  unsigned long baud = sbus::Baud;
  bool inverted = true;
  int pin = CorePin;
  unsigned error = Parity;  // what is wrong with characters that are bad
  unsigned tickUs = 0;      // how long reading the clock takes
  unsigned clockHz = 0;     // micros() counts these steps; 0: each microsecond
  unsigned lateUs = 0;      // how long an interrupt holds up the next read()
  bool looped = false;      // what was sent comes back, whatever its polarity
  unsigned portUs = 0;      // how long a method of the port takes, where a core locks it

  // A driver like the ESP32's: its interrupt comes late by up to driverLateUs, then has what it has taken out of the
  // FIFO for up to driverUs, and then counts it. All at random.
  unsigned driverLateUs = 0, driverUs = 0;
  unsigned earlyUs = 0;  // how long before its end a character is in the FIFO
  unsigned cacheUs = 0;  // the most that code in flash takes if the cache does not hold it
  std::minstd_rand random{20181};
  unsigned upTo(unsigned most) { return most == 0 ? 0 : static_cast<unsigned>(random() % (most + 1)); }

  // A half duplex port: the interrupt at the end of the last character releases the pin. release() does that if it is
  // time; pass() does so itself.
  std::vector<Driven> driven;
  uint64_t completeAtUs = Never;
  void release();
  // Returns the newest time between these two for which it was driven; null: none.
  const Driven *drivenWithin(uint64_t beginUs, uint64_t endUs) const;
  // The half duplex port hears what it sends.
  bool echoes = false;

  Wire *wire = nullptr;
  std::vector<line::Character> line;
  size_t next = 0;  // of `line`, or of `sent`

  std::vector<Sent> sent;
  std::vector<Level> levels;  // that the sketch has given to pins
  std::string printed;
  unsigned crashes = 0;
  Reader *reader = nullptr;
  unsigned long dropped = 0;  // bytes, because the buffer was full
};

extern World world;

// The alarms of the pico-sdk's microsecond timer, and the core that runs.
struct Alarms {
  static constexpr unsigned Count = 4;
  unsigned claimed = 8;                                 // bits; 3 is the default pool's (pico_time/time.c:84)
  unsigned priority[Count] = {0x80, 0x80, 0x80, 0x80};  // of their interrupts
  void (*callback[Count])(unsigned) = {};
  unsigned core = 0;
};
extern Alarms alarms;

// What calls each millisecond: on a Teensy an IntervalTimer, on a SAMD SysTick, which asks for PendSV.
struct Ticks {
  unsigned free = 4;       // IntervalTimers of a Teensy
  bool isPending = false;  // a SAMD's PendSV
  unsigned priority = 0;   // PendSV's, after a reset
};
extern Ticks ticks;

// Switches the board on.
void startTicks();

}  // namespace sim
