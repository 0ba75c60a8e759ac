// The stored calibration: whole or refused, and scaling by it: exact at the three points, over all 2048 values.
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "support/Random.h"
#include "support/ShowArrays.h"
#include "sbus/Calibration.h"

namespace {

using sbus::CalibratedChannel;
using sbus::Calibration;
using sbus::StoredState;

constexpr int Values = 2048;
constexpr unsigned Size = 132;
constexpr unsigned Bits = 8 * Size;
using Stored = std::array<uint8_t, Size>;

constexpr CalibratedChannel Channels[] = {
    {sbus::FrSky, 0},         // what a radio sends that nobody has trimmed
    {sbus::FrSky, 8},         // with the dead zone of a Calibrator
    {sbus::Futaba, 8},        //
    {{78, 1024, 1964}, 20},   // a Futaba's +-140 %
    {{1811, 992, 172}, 8},    // backwards
    {{1800, 700, 100}, 99},   // ... and off its middle
    {{0, 1024, 2047}, 0},     // all that there is
    {{0, 1024, 2047}, 1022},  // ... nearly all of it dead
    {{300, 400, 1900}, 99},   // one side short, and nearly all of it dead
    {{1000, 1001, 1002}, 0},  // as short as can be
    {{2047, 2046, 2045}, 0},  // ... backwards
    {{172, 992, 1811}, 818},  // one count is left above the dead zone, two below
};

CalibratedChannel reversed(CalibratedChannel channel) {
  std::swap(channel.range.low, channel.range.high);
  return channel;
}

// Whatever is not sealed in it is FF.
Calibration empty() {
  Calibration calibration;
  std::memset(&calibration, 0xFF, sizeof calibration);
  std::memset(calibration.channels, 0, sizeof calibration.channels);
  return calibration;
}

Calibration sealedWith(const CalibratedChannel &channel, size_t index = 0) {
  Calibration calibration = empty();
  calibration.channels[index] = channel;
  seal(calibration);
  return calibration;
}

// All kinds of channels, and four that are not calibrated.
Calibration known() {
  Calibration calibration = empty();
  std::copy(std::begin(Channels), std::end(Channels), calibration.channels);
  seal(calibration);
  return calibration;
}

Stored bytesOf(const Calibration &calibration) {
  static_assert(sizeof calibration == Size, "what sketches have stored must be found again");
  Stored bytes;
  std::memcpy(bytes.data(), &calibration, Size);
  return bytes;
}

Calibration read(const Stored &bytes) {
  Calibration calibration;
  std::memcpy(&calibration, bytes.data(), Size);
  return calibration;
}

StoredState stateOf(const Stored &bytes) {
  return sbus::stateOf(read(bytes));
}

// The check value once more, by a table: CRC-16/CCITT-FALSE as catalogues have it.
uint16_t crcOf(const uint8_t *bytes, size_t count) {
  std::array<uint16_t, 256> table;
  for (unsigned i = 0; i < table.size(); i++) {
    unsigned value = i << 8;
    for (unsigned step = 0; step < 8; step++) {
      value = (value & 0x8000) != 0 ? value << 1 ^ 0x1021 : value << 1;
    }
    table[i] = static_cast<uint16_t>(value);
  }
  unsigned crc = 0xFFFF;
  for (size_t i = 0; i < count; i++) {
    crc = (crc << 8 ^ table[(crc >> 8 ^ bytes[i]) & 0xFF]) & 0xFFFF;
  }
  return static_cast<uint16_t>(crc);
}

CalibratedChannel anyNumbers() {
  const auto number = [] {
    return *rc::gen::oneOf(rc::gen::arbitrary<uint16_t>(), rc::gen::inRange<uint16_t>(0, 2050),
                           rc::gen::element<uint16_t>(0, 1, 2047, 2048, 32767, 32768, 65535));
  };
  CalibratedChannel channel;
  channel.range.low = number();
  channel.range.centre = number();
  channel.range.high = number();
  channel.deadZone = number();
  return channel;
}

CalibratedChannel anyPossible() {
  const auto centre = *rc::gen::inRange<int>(1, 2047);
  const auto low = *rc::gen::inRange<int>(0, centre);
  const auto high = *rc::gen::inRange<int>(centre + 1, 2048);
  const auto deadZone = *rc::gen::inRange<int>(0, std::min(centre - low, high - centre));
  const CalibratedChannel channel = {
      {static_cast<uint16_t>(low), static_cast<uint16_t>(centre), static_cast<uint16_t>(high)},
      static_cast<uint16_t>(deadZone)};
  return *rc::gen::arbitrary<bool>() ? reversed(channel) : channel;
}

// As documented, in 64 bits and one rule after the other.
bool possibleByRule(const CalibratedChannel &channel) {
  const int64_t low = channel.range.low;
  const int64_t centre = channel.range.centre;
  const int64_t high = channel.range.high;
  const int64_t dead = channel.deadZone;
  if (low == 0 && centre == 0 && high == 0 && dead == 0) {
    return true;
  }
  const bool forwards = low < centre - dead && centre + dead < high && high <= 2047;
  const bool backwards = high < centre - dead && centre + dead < low && low <= 2047;
  return forwards || backwards;
}

// Two straight lines from either end of the dead zone, in floating point; `step` is what an end differs by.
double onTheLines(int raw, const CalibratedChannel &channel, double step) {
  const int centre = channel.range.centre;
  const int beyond = std::abs(raw - centre) - channel.deadZone;
  if (beyond <= 0) {
    return 0;
  }
  const bool towardsHigh = (raw > centre) == (channel.range.high > centre);
  const int length = std::abs((towardsHigh ? channel.range.high : channel.range.low) - centre) - channel.deadZone;
  return (towardsHigh ? step : -step) * beyond / length;
}

}  // namespace

TEST_CASE("the test's own check value is the one of the catalogues") {
  const uint8_t digits[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  CHECK(crcOf(digits, 9) == 0x29B1);
}

TEST_CASE("what is sealed is good: empty, known, or whatever can be") {
  CHECK(sbus::stateOf(sealedWith({{0, 0, 0}, 0})) == StoredState::Good);
  CHECK(sbus::stateOf(known()) == StoredState::Good);
  for (size_t index = 0; index < 16; index++) {
    for (const CalibratedChannel &channel : Channels) {
      REQUIRE(sbus::stateOf(sealedWith(channel, index)) == StoredState::Good);
    }
  }
  CHECK(rc::check("stateOf(seal(possible)) == Good, through 132 bytes", [] {
    Calibration calibration = empty();
    for (CalibratedChannel &channel : calibration.channels) {
      channel = anyPossible();
      RC_ASSERT(sbus::isPossible(channel));
    }
    seal(calibration);
    RC_ASSERT(stateOf(bytesOf(calibration)) == StoredState::Good);
  }));
}

TEST_CASE("the 132 bytes are the version, 16 times low, centre, high, dead zone, and the check value, low byte first") {
  Calibration calibration = empty();
  for (size_t i = 0; i < 16; i++) {
    calibration.channels[i] = {{static_cast<uint16_t>(0x0100 + i), 0x0300, static_cast<uint16_t>(0x0500 + i)}, 8};
  }
  seal(calibration);
  const Stored bytes = bytesOf(calibration);
  CHECK(bytes[0] == 1);
  CHECK(bytes[1] == 0);
  for (size_t i = 0; i < 16; i++) {
    const auto index = static_cast<uint8_t>(i);
    const std::array<uint8_t, 8> expected = {index, 0x01, 0x00, 0x03, index, 0x05, 0x08, 0x00};
    std::array<uint8_t, 8> found;
    std::copy_n(bytes.begin() + 2 + static_cast<int>(8 * i), 8, found.begin());
    CHECK(found == expected);
  }
  // By Python's binascii.crc_hqx(bytes, 0xFFFF).
  CHECK(bytes[130] == 0xDA);
  CHECK(bytes[131] == 0x9C);
}

TEST_CASE("the check value is CRC-16/CCITT-FALSE of the 130 bytes before it, whatever they are") {
  CHECK(rc::check("checkValue == crc(bytes)", [] {
    Calibration calibration;
    for (CalibratedChannel &channel : calibration.channels) {
      channel = anyNumbers();
    }
    calibration.version = *rc::gen::arbitrary<uint16_t>();
    calibration.checkValue = *rc::gen::arbitrary<uint16_t>();
    seal(calibration);
    RC_ASSERT(calibration.version == sbus::CalibrationVersion);
    RC_ASSERT(calibration.checkValue == crcOf(bytesOf(calibration).data(), 130));
    const Calibration once = calibration;
    seal(calibration);
    RC_ASSERT(bytesOf(calibration) == bytesOf(once));
  }));
}

TEST_CASE("each of the 1056 bits is guarded: whichever is changed, the calibration is refused") {
  for (const Calibration &calibration : {known(), sealedWith({{0, 0, 0}, 0})}) {
    Stored bytes = bytesOf(calibration);
    for (unsigned bit = 0; bit < Bits; bit++) {
      CAPTURE(bit);
      bytes[bit / 8] = static_cast<uint8_t>(bytes[bit / 8] ^ 1u << bit % 8);
      REQUIRE(stateOf(bytes) == (bit < 16 ? StoredState::OtherVersion : StoredState::Damaged));
      bytes[bit / 8] = static_cast<uint8_t>(bytes[bit / 8] ^ 1u << bit % 8);
    }
    REQUIRE(stateOf(bytes) == StoredState::Good);
  }
}

TEST_CASE("two changed bits are always refused, and any change within two neighbouring bytes") {
  const Stored good = bytesOf(known());
  Random random(20181);
  for (unsigned round = 0; round < 4000; round++) {
    Stored bytes = good;
    const unsigned one = random.below(Bits);
    const unsigned other = (one + 1 + random.below(Bits - 1)) % Bits;
    for (const unsigned bit : {one, other}) {
      bytes[bit / 8] = static_cast<uint8_t>(bytes[bit / 8] ^ 1u << bit % 8);
    }
    CAPTURE(one);
    CAPTURE(other);
    REQUIRE(stateOf(bytes) != StoredState::Good);
  }
  for (unsigned round = 0; round < 4000; round++) {
    Stored bytes = good;
    const unsigned at = random.below(Size - 1);
    const unsigned change = 1 + random.below(0xFFFF);
    bytes[at] = static_cast<uint8_t>(bytes[at] ^ change);
    bytes[at + 1] = static_cast<uint8_t>(bytes[at + 1] ^ change >> 8);
    CAPTURE(at);
    CAPTURE(change);
    REQUIRE(stateOf(bytes) != StoredState::Good);
  }
}

TEST_CASE("of 10000 changes of any two bytes none is missed: 16 bits would miss one in 65536") {
  const Stored good = bytesOf(known());
  Random random(7);
  unsigned missed = 0;
  for (unsigned round = 0; round < 10000; round++) {
    Stored bytes = good;
    const unsigned one = random.below(Size);
    const unsigned other = (one + 1 + random.below(Size - 1)) % Size;
    bytes[one] = static_cast<uint8_t>(bytes[one] ^ (1 + random.below(255)));
    bytes[other] = static_cast<uint8_t>(bytes[other] ^ (1 + random.below(255)));
    missed += stateOf(bytes) == StoredState::Good;
  }
  CHECK(missed == 0);
}

TEST_CASE("a calibration that was half written over by another is refused, wherever the power went") {
  const Stored old = bytesOf(known());
  Calibration next = known();
  std::reverse(std::begin(next.channels), std::end(next.channels));
  seal(next);
  const Stored whole = bytesOf(next);
  for (size_t written = 0; written <= Size; written++) {
    CAPTURE(written);
    Stored bytes = old;
    std::copy_n(whole.begin(), written, bytes.begin());
    CHECK(stateOf(bytes) == (bytes == old || bytes == whole ? StoredState::Good : StoredState::Damaged));
  }
}

TEST_CASE("storage that nobody has written to holds no calibration: all 00, all FF, or the same byte all over") {
  for (unsigned value = 0; value < 256; value++) {
    CAPTURE(value);
    Stored bytes;
    bytes.fill(static_cast<uint8_t>(value));
    CHECK(stateOf(bytes) == StoredState::OtherVersion);
  }
}

TEST_CASE("of 65536 versions one is ours, even if the check value is right for the others") {
  Stored bytes = bytesOf(known());
  unsigned others = 0;
  for (unsigned version = 0; version < 0x10000; version++) {
    bytes[0] = static_cast<uint8_t>(version);
    bytes[1] = static_cast<uint8_t>(version >> 8);
    others += stateOf(bytes) == StoredState::OtherVersion;
  }
  CHECK(others == 0xFFFF);
  for (const uint16_t version : {uint16_t{0}, uint16_t{2}, uint16_t{0x0100}, uint16_t{0xFFFF}}) {
    CAPTURE(version);
    Calibration calibration = known();
    calibration.version = version;
    calibration.checkValue = crcOf(bytesOf(calibration).data(), 130);
    CHECK(sbus::stateOf(calibration) == StoredState::OtherVersion);
  }
}

TEST_CASE("a channel can be or cannot be, rule by rule, on either side of its limit") {
  const struct {
    const char *rule;
    CalibratedChannel channel;
    bool possible;
  } rows[] = {
      {"not calibrated", {{0, 0, 0}, 0}, true},
      {"not calibrated, but a dead zone", {{0, 0, 0}, 1}, false},
      {"not calibrated, but a centre", {{0, 1, 0}, 0}, false},
      {"no length, anywhere", {{992, 992, 992}, 0}, false},
      {"no length, the centre elsewhere", {{172, 992, 172}, 0}, false},
      {"low == centre", {{172, 172, 1811}, 0}, false},
      {"low just below centre", {{172, 173, 1811}, 0}, true},
      {"centre == high", {{172, 1811, 1811}, 0}, false},
      {"centre just below high", {{172, 1810, 1811}, 0}, true},
      {"centre below both", {{172, 171, 1811}, 0}, false},
      {"centre above both", {{172, 1812, 1811}, 0}, false},
      {"backwards, low == centre", {{1811, 1811, 172}, 0}, false},
      {"backwards, low just above centre", {{1811, 1810, 172}, 0}, true},
      {"backwards, centre == high", {{1811, 172, 172}, 0}, false},
      {"backwards, centre just above high", {{1811, 173, 172}, 0}, true},
      {"backwards, centre below both", {{1811, 171, 172}, 0}, false},
      {"backwards, centre above both", {{1811, 1812, 172}, 0}, false},
      {"high at its highest", {{0, 1, 2047}, 0}, true},
      {"high above", {{0, 1, 2048}, 0}, false},
      {"high far above", {{0, 1, 65535}, 0}, false},
      {"low at its highest", {{2047, 1, 0}, 0}, true},
      {"low above", {{2048, 1, 0}, 0}, false},
      {"low far above", {{65535, 1, 0}, 0}, false},
      {"all three above", {{3000, 4000, 5000}, 0}, false},
      {"dead zone ends before low", {{992 - 9, 992, 1811}, 8}, true},
      {"dead zone ends at low", {{992 - 8, 992, 1811}, 8}, false},
      {"dead zone ends before high", {{172, 992, 992 + 9}, 8}, true},
      {"dead zone ends at high", {{172, 992, 992 + 8}, 8}, false},
      {"backwards, dead zone ends before high", {{1811, 992, 992 - 9}, 8}, true},
      {"backwards, dead zone ends at high", {{1811, 992, 992 - 8}, 8}, false},
      {"backwards, dead zone ends before low", {{992 + 9, 992, 172}, 8}, true},
      {"backwards, dead zone ends at low", {{992 + 8, 992, 172}, 8}, false},
      {"dead zone as large as can be", {{0, 1024, 2047}, 1022}, true},
      {"... and one more", {{0, 1024, 2047}, 1023}, false},
      {"dead zone beyond all", {{0, 1024, 2047}, 65535}, false},
  };
  for (const auto &row : rows) {
    CAPTURE(row.rule);
    CHECK(sbus::isPossible(row.channel) == row.possible);
    CHECK(possibleByRule(row.channel) == row.possible);
    for (const size_t index : {size_t{0}, size_t{9}, size_t{15}}) {
      CAPTURE(index);
      CHECK(sbus::stateOf(sealedWith(row.channel, index)) ==
            (row.possible ? StoredState::Good : StoredState::Impossible));
    }
  }
}

TEST_CASE("a channel is calibrated if its range has a length") {
  CHECK_FALSE(sbus::isCalibrated({{0, 0, 0}, 0}));
  CHECK_FALSE(sbus::isCalibrated({{992, 992, 992}, 0}));
  CHECK(sbus::isCalibrated({sbus::FrSky, 0}));
  CHECK(sbus::isCalibrated({{1811, 992, 172}, 8}));
}

TEST_CASE("whatever numbers a channel has, it is judged as the rules say") {
  CHECK(rc::check("isPossible(channel) == rules(channel)", [] {
    const CalibratedChannel channel = anyNumbers();
    RC_ASSERT(sbus::isPossible(channel) == possibleByRule(channel));
    RC_ASSERT((sbus::stateOf(sealedWith(channel)) == StoredState::Good) == possibleByRule(channel));
  }));
}

TEST_CASE("the three points are exactly -1000, 0, +1000 and 988, 1500, 2012 us, backwards and with any dead zone") {
  const auto isExact = [](const CalibratedChannel &channel) {
    const sbus::Range &range = channel.range;
    return channel.toNormalised(range.low) == -1000 && channel.toNormalised(range.centre) == 0 &&
           channel.toNormalised(range.high) == 1000 && channel.toMicroseconds(range.low) == 988 &&
           channel.toMicroseconds(range.centre) == 1500 && channel.toMicroseconds(range.high) == 2012;
  };
  for (const CalibratedChannel &channel : Channels) {
    CAPTURE(channel.range.low);
    CAPTURE(channel.deadZone);
    CHECK(isExact(channel));
    CHECK(isExact(reversed(channel)));
  }
  CHECK(rc::check("exact at the three points", [isExact] { RC_ASSERT(isExact(anyPossible())); }));
}

TEST_CASE("all 2048 values lie within half a thousandth and half a microsecond of the lines behind the dead zone") {
  for (const CalibratedChannel &channel : Channels) {
    CAPTURE(channel.range.low);
    CAPTURE(channel.deadZone);
    for (int raw = 0; raw < Values; raw++) {
      CAPTURE(raw);
      const double thousandths = onTheLines(raw, channel, 1000);
      const double us = 1500 + onTheLines(raw, channel, 512);
      const auto value = static_cast<uint16_t>(raw);
      REQUIRE(std::abs(channel.toNormalised(value) - std::clamp(thousandths, -32767.0, 32767.0)) <= 0.5);
      REQUIRE(std::abs(channel.toMicroseconds(value) - std::clamp(us, -32767.0, 32767.0)) <= 0.5);
    }
  }
}

TEST_CASE("all 2048 values rise from low to high, are 0 in the dead zone, and no count makes more than its part") {
  for (const CalibratedChannel &channel : Channels) {
    CAPTURE(channel.range.low);
    CAPTURE(channel.deadZone);
    const int direction = channel.range.low < channel.range.high ? 1 : -1;
    const int centre = channel.range.centre;
    const int shorter = std::min(std::abs(channel.range.low - centre), std::abs(channel.range.high - centre));
    const int most = 1000 / (shorter - channel.deadZone) + 1;
    int last = channel.toNormalised(0);
    int lastUs = channel.toMicroseconds(0);
    int zeros = 0;
    for (int raw = 0; raw < Values; raw++) {
      CAPTURE(raw);
      const int value = channel.toNormalised(static_cast<uint16_t>(raw));
      const int us = channel.toMicroseconds(static_cast<uint16_t>(raw));
      REQUIRE((value - last) * direction >= 0);
      REQUIRE((value - last) * direction <= most);
      REQUIRE((us - lastUs) * direction >= 0);
      REQUIRE((us - lastUs) * direction <= most);
      if (std::abs(raw - centre) <= channel.deadZone) {
        REQUIRE(value == 0);
        REQUIRE(us == 1500);
        zeros++;
      }
      last = value;
      lastUs = us;
    }
    CHECK(zeros == 2 * channel.deadZone + 1);
  }
}

TEST_CASE("a channel reversed has all 2048 values reversed") {
  for (const CalibratedChannel &channel : Channels) {
    CAPTURE(channel.range.low);
    CAPTURE(channel.deadZone);
    for (int raw = 0; raw < Values; raw++) {
      CAPTURE(raw);
      const auto value = static_cast<uint16_t>(raw);
      REQUIRE(reversed(channel).toNormalised(value) == -channel.toNormalised(value));
      const int us = channel.toMicroseconds(value);
      if (std::abs(us) < 29000) {  // beyond, they come to the end of 16 bits
        REQUIRE(reversed(channel).toMicroseconds(value) - 1500 == 1500 - us);
      }
    }
  }
}

TEST_CASE("sides of the same length have the same values, with other signs") {
  const CalibratedChannel channel = {sbus::Futaba, 8};
  for (int distance = 0; distance <= 1023; distance++) {
    CAPTURE(distance);
    const auto above = static_cast<uint16_t>(1024 + distance);
    const auto below = static_cast<uint16_t>(1024 - distance);
    REQUIRE(channel.toNormalised(above) == -channel.toNormalised(below));
    REQUIRE(channel.toMicroseconds(above) - 1500 == 1500 - channel.toMicroseconds(below));
  }
}

TEST_CASE("without a dead zone a channel is scaled as its range is") {
  CHECK(rc::check("the same as by the range", [] {
    CalibratedChannel channel = anyPossible();
    channel.deadZone = 0;
    for (int raw = 0; raw < Values; raw += 3) {
      const auto value = static_cast<uint16_t>(raw);
      RC_ASSERT(channel.toNormalised(value) == sbus::toNormalised(value, channel.range));
      RC_ASSERT(channel.toMicroseconds(value) == sbus::toMicroseconds(value, channel.range));
    }
  }));
}

TEST_CASE("a channel that is not calibrated is at its centre, whatever comes") {
  const CalibratedChannel channel = {{0, 0, 0}, 0};
  bool centred = true;
  for (unsigned raw = 0; raw < 0x10000; raw++) {
    const auto value = static_cast<uint16_t>(raw);
    centred = centred && channel.toNormalised(value) == 0 && channel.toMicroseconds(value) == 1500;
  }
  CHECK(centred);
}

TEST_CASE("no value and no channel, however odd, is undefined, or further than 32767") {
  const CalibratedChannel odd[] = {
      {{65535, 65535, 65535}, 65535},
      {{65535, 0, 65535}, 0},
      {{0, 65535, 0}, 65534},
      {{0, 65535, 1}, 65535},
      {{65535, 32768, 0}, 32767},
      {{32767, 32768, 32769}, 0},
      {{1, 0, 65535}, 1},
      {{500, 1000, 700}, 65535},
      {{0, 1, 0}, 0},
  };
  for (const CalibratedChannel &channel : odd) {
    CAPTURE(channel.range.low);
    bool inside = true;
    for (unsigned raw = 0; raw < 0x10000; raw++) {
      const auto value = static_cast<uint16_t>(raw);
      inside = inside && channel.toNormalised(value) >= -32767 && channel.toMicroseconds(value) >= -32767;
    }
    CHECK(inside);
  }
  CHECK(rc::check("any channel, any value", [] {
    const CalibratedChannel channel = anyNumbers();
    for (unsigned raw = 0; raw < 0x10000; raw += 97) {
      const auto value = static_cast<uint16_t>(raw);
      RC_ASSERT(channel.toNormalised(value) >= -32767 && channel.toMicroseconds(value) >= -32767);
    }
  }));
}
