// The example Joystick on cores with a USB joystick: what the PC gets, read by the report's descriptor.
#include <map>

#include "Cores.h"
#include "Usb.h"

#if defined(CORE_TEENSY) || defined(ARDUINO_ARCH_RP2040)
StandInJoystick Joystick;
#endif

sim::Usb sim::usb;

// Includes the sketch as the IDE does; its globals come before main().
#include "../../../examples/Joystick/Joystick.ino"

#if defined(ESP32)
USBHIDDevice *USBHID::added;
uint16_t USBHID::length;
ESPUSB USB;
#endif
decltype(Serial1) Serial1, Serial2;
Console Serial;

using sim::usb;
using sim::world;

namespace {

#if defined(CORE_TEENSY) || defined(ARDUINO_ARCH_RP2040)

// -1000..1000
int part(int value) {
#if defined(CORE_TEENSY)
  return value == 512 ? 0 : (value * 2000 + 511) / 1023 - 1000;
#else
  return value * 1000 / 32767;
#endif
}

std::vector<int> shown() {
  std::vector<int> values;
  for (const int axis : usb.axes) {
    values.push_back(part(axis));
  }
  values.push_back(static_cast<int>(usb.buttons));
  return values;
}

#else

// Reads the newest report by the items of its descriptor (HID 1.11, 6.2.2): six axes and all buttons.
std::vector<int> shown() {
  struct Field {
    unsigned bit, bits;
    int low, high;
  };
  std::map<unsigned, Field> fields;  // by page and usage
  int page = 0, low = 0, high = 0, bits = 0, count = 0, id = 0, first = 0, depth = 0;
  const std::map<unsigned, int *> numbers = {{0x04, &page},  {0x14, &low}, {0x24, &high}, {0x74, &bits},
                                             {0x94, &count}, {0x84, &id},  {0x18, &first}};
  unsigned at = 0;
  const sim::Bytes &items = usb.descriptor;
  for (size_t i = 0; i < items.size();) {
    const unsigned tag = items[i] & 0xFC, size = items[i] & 3;
    const int number = size == 0   ? 0
                       : size == 1 ? static_cast<int8_t>(items[i + 1])
                                   : static_cast<int16_t>(items[i + 1] | items[i + 2] << 8);
    i += 1 + size;
    if (numbers.count(tag) != 0) {
      *numbers.at(tag) = number;
    } else if (tag == 0x28) {  // the last usage
      CHECK((depth != 1 || number - first + 1 >= 8));
    } else if (tag == 0x80) {  // input
      for (int n = 0; n < count; n++, at += static_cast<unsigned>(bits)) {
        fields[static_cast<unsigned>(page << 16 | (first + n))] = {at, static_cast<unsigned>(bits), low, high};
      }
    } else {
      depth += (tag == 0xA0) - (tag == 0xC0);  // collections
    }
  }
  const sim::Bytes &report = usb.reports.back();
  CHECK(depth == 0);
  REQUIRE(report.size() == 1 + at / 8);
  CHECK(int{report[0]} == id);
  const auto read = [&](unsigned usage) {
    const Field &field = fields.at(usage);
    unsigned value = 0;
    for (unsigned n = 0; n < field.bits; n++) {
      const unsigned bit = field.bit + n;
      value |= (report[1 + bit / 8] >> bit % 8 & 1u) << n;
    }
    const int number = field.bits == 16 ? static_cast<int16_t>(value) : static_cast<int>(value);
    CHECK(number >= field.low);
    CHECK(number <= field.high);
    return number;
  };
  std::vector<int> values;
  for (unsigned usage = 0x30; usage < 0x36; usage++) {
    values.push_back(read(1 << 16 | usage));
  }
  unsigned buttons = 0;
  for (unsigned button = 1; button <= 16; button++) {
    buttons |= static_cast<unsigned>(read(9 << 16 | button)) << (button - 1);
  }
  CHECK(fields.count(1 << 16 | 0x37) == 1);  // the dial
  values.push_back(static_cast<int>(buttons));
  return values;
}

#endif

void put(const Channels &channels, bool failsafe) {
  Frame frame = writeBitByBit(channels);
  frame[23] = static_cast<uint8_t>(frame[23] | (failsafe ? sbus::FlagFailsafe : 0));
  uint64_t us = world.nowUs + 5000;
  for (const uint8_t byte : frame) {
    us += 120;
    world.line.push_back({us, byte});
  }
}

void loopFor(uint64_t us) {
  for (const uint64_t endUs = world.nowUs + us; world.nowUs < endUs; world.nowUs += 1000) {
    loop();
  }
}

// Puts three frames with these channels on the line: the first may wait for the next.
std::vector<int> after(const Channels &channels, bool failsafe = false) {
  for (int i = 0; i < 3; i++) {
    put(channels, failsafe);
    loopFor(9000);
  }
  return shown();
}

const std::vector<int> Rest = {0, 0, -1000, 0, 0, 0, 0};

}  // namespace

TEST_CASE("the PC gets the channels, and a closed throttle without a link") {
  cores::switchOn();
  world.inverted = Core.inverts;
#if defined(ESP32)
  world.pin = 16;  // as src/SBusBoard.h has it
#else
  usb.isAttached = true;
#endif
  setup();
  CHECK(usb.isAttached);
  loopFor(100000);
  REQUIRE(!usb.reports.empty());
  CHECK(shown() == Rest);
  Channels channels;
  channels.fill(992);
  channels[16] = channels[17] = 0;
  CHECK(after(channels) == std::vector<int>{0, 0, 0, 0, 0, 0, 0});
  channels[0] = 172;
  channels[1] = 1811;
  channels[2] = 2047;
  channels[3] = 0;
  channels[4] = 1402;  // 501
  channels[5] = 582;   // -500
  channels[8] = 1402;
  channels[9] = 1401;
  channels[15] = 1811;
  channels[17] = 1;
  const std::vector<int> wanted = {-1000, 1000, 1000, -1000, 501, -500, 0x281};
  const std::vector<int> seen = after(channels);
  REQUIRE(seen.size() == wanted.size());
  for (size_t i = 0; i < 6; i++) {
    CHECK(std::abs(seen[i] - wanted[i]) <= (usb.descriptor.empty() ? 1 : 0));  // a Teensy has 10 bits
  }
  CHECK(seen[6] == wanted[6]);
  CHECK(after(channels, true) == Rest);
  CHECK(after(channels)[0] == -1000);
  loopFor(80000);  // the wire is cut, for less than 100 ms
  CHECK(shown()[0] == -1000);
  loopFor(80000);
  CHECK(shown() == Rest);
  const size_t before = usb.reports.size();
  loopFor(1000000);
  CHECK(usb.reports.size() - before == 20);
}
