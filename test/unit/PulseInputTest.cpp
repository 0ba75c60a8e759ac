// How the example PwmIn measures a channel: which pulses count, what spikes do, and when a value is too old.
#include <doctest/doctest.h>

#include <cstdint>
#include <initializer_list>

#include "../../examples/PwmIn/PulseInput.h"

namespace {

// A pin with pulses; `fromUs` is near the clock's end in one test.
struct Pin {
  PulseInput input;
  uint32_t us;

  explicit Pin(uint32_t fromUs = 100000) : us(fromUs) {}

  Pin &wait(uint32_t time) {
    us += time;
    input.update(us);
    return *this;
  }
  Pin &change(bool isHigh, uint32_t after) {
    us += after;
    input.change(isHigh, us);
    return *this;
  }
  // LOW for 10 ms, and then HIGH for this time.
  Pin &pulse(uint32_t width) { return change(true, 10000).change(false, width); }
  uint16_t widthAfter(uint32_t time) {
    wait(time);
    return input.width();
  }
};

}  // namespace

TEST_CASE("a pulse of 800..2200 us counts 2 ms after its end; others are rejected, and the pulse before stays") {
  for (const uint32_t width : {0u, 1u, 300u, 799u, 800u, 801u, 1500u, 2199u, 2200u, 2201u, 3000u, 67036u, 5000000u}) {
    CAPTURE(width);
    Pin pin;
    CHECK(pin.pulse(1234).widthAfter(1999) == 0);
    CHECK(pin.widthAfter(1) == 1234);
    pin.pulse(width);
    CHECK(pin.widthAfter(1999) == 1234);
    CHECK(pin.widthAfter(1) == (width >= 800 && width <= 2200 ? width : 1234));
  }
}

TEST_CASE("the next pulse proves the one before; at 200 Hz each pulse counts, and closer than 2 ms none does") {
  const struct {
    uint32_t low;
    bool counts;
  } rows[] = {{18500, true}, {2800, true}, {2000, true}, {1999, false}, {800, false}};
  for (const auto &row : rows) {
    CAPTURE(row.low);
    Pin pin;
    for (uint32_t width = 1000; width < 1100; width++) {
      pin.change(true, row.low).change(false, width);
      CHECK(pin.input.width() == (row.counts && width > 1000 ? width - 1 : 0));
    }
  }
}

// A spike that is not seen is over before its interrupt looks at the pin.
TEST_CASE("a spike in a pulse, or less than 2 ms from it, costs that pulse and no other, seen or not") {
  constexpr uint32_t Begin = 4000, End = 5500;  // of the pulse
  const struct {
    const char *what;
    uint32_t beginsAt, endsAt;  // of the spike; 0: its width away from the other
    uint32_t width;             // of the newest pulse; 1111: of the one before
  } rows[] = {
      {"3 ms before", 0, Begin - 3000, 1500},        {"2 ms before", 0, Begin - 2000, 1500},
      {"1.999 ms before", 0, Begin - 1999, 1111},    {"1 us before", 0, Begin - 1, 1111},
      {"1 us behind its begin", Begin + 1, 0, 1111}, {"in it", Begin + 700, 0, 1111},
      {"1 us before its end", 0, End - 1, 1111},     {"1 us behind", End + 1, 0, 1111},
      {"1.99 ms behind", End + 1990, 0, 1111},       {"2 ms behind", End + 2000, 0, 1500},
      {"3 ms behind", End + 3000, 0, 1500},
  };
  for (const auto &row : rows) {
    for (const uint32_t width : {1u, 5u, 50u, 500u}) {
      for (const bool isSeen : {true, false}) {
        if (!isSeen && width > 5) {
          continue;
        }
        INFO(doctest::String(row.what), ", width ", width, ", isSeen ", isSeen);
        const uint32_t at = row.endsAt == 0 ? row.beginsAt : row.endsAt - width;
        Pin pin;
        pin.pulse(1111).wait(8000);
        bool was = false;
        for (uint32_t us = 0; us <= 9600; us++) {
          const bool isPulse = us >= Begin && us < End;
          const bool isSpike = us >= at && us < at + width;
          const bool is = isPulse != (isSpike && isSeen);
          if (is != was || (us == at + width && !isSeen)) {
            pin.input.change(is, pin.us + us);
            was = is;
          }
        }
        pin.us += 9600;
        CHECK(pin.widthAfter(0) == row.width);
        pin.pulse(1222);
        CHECK(pin.widthAfter(2000) == 1222);
      }
    }
  }
}

TEST_CASE("a pulse grows old from its end on, and stays old when the clock wraps after 71 minutes") {
  for (const uint32_t from : {100000u, 0xFFFFF000u}) {
    CAPTURE(from);
    Pin pin(from);
    CHECK(pin.input.age() == PulseInput::Oldest);
    CHECK(pin.pulse(1500).input.age() == PulseInput::Oldest);
    pin.wait(2000);
    CHECK(pin.input.age() == 2000);
    pin.wait(298000);
    CHECK(pin.input.age() == 300000);
    for (unsigned minute = 0; minute < 300; minute++) {
      pin.wait(60000000);
      CHECK(pin.input.age() >= PulseInput::Oldest);
    }
    CHECK(pin.input.width() == 1500);
    pin.pulse(1600).wait(2500);
    CHECK(pin.input.age() == 2500);
  }
}

TEST_CASE("a line that is HIGH from the start, or stays HIGH, brings no pulse") {
  Pin pin;
  CHECK(pin.change(false, 700).widthAfter(5000) == 0);  // the end of a pulse that began before
  pin.pulse(1500).wait(2000);
  pin.change(true, 10000).wait(2000000);
  CHECK(pin.input.age() >= PulseInput::Oldest);
  CHECK(pin.input.width() == 1500);
}

TEST_CASE(
    "if pins change at once, the first interrupt sees all; later ones change nothing, unless a pin has changed again") {
  Pin pin;
  pin.pulse(1111).wait(8000);
  pin.input.look(true, pin.us, false);
  pin.input.look(true, pin.us + 20, true);
  pin.input.look(true, pin.us + 500, false);
  pin.input.look(false, pin.us + 1500, false);
  pin.input.look(false, pin.us + 1520, true);
  pin.us += 1500;
  CHECK(pin.widthAfter(2000) == 1500);
  pin.wait(8000);
  pin.input.look(true, pin.us, true);
  pin.input.look(true, pin.us + 700, true);  // a spike
  pin.input.look(false, pin.us + 1300, true);
  pin.us += 1300;
  CHECK(pin.widthAfter(2000) == 1500);
}
