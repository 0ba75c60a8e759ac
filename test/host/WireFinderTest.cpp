// Finds the signal of a capture that carries S.Bus, its polarity and baud rate; or says why a signal is not S.Bus.
#include <tuple>

#include "support/Decoded.h"

namespace {

// Two inverted wires, A and B, in one capture.
std::string vcdOf(const TestWire &a, const TestWire &b) {
  std::string vcd =
      "$timescale 1 ns $end\n$var wire 1 a A $end\n$var wire 1 b B $end\n$enddefinitions $end\n#0\n0a\n0b\n";
  for (size_t i = 0, k = 0; i < a.edges.size() || k < b.edges.size();) {
    const bool isA = k == b.edges.size() || (i < a.edges.size() && a.edges[i] <= b.edges[k]);
    vcd += isA ? printed("#%.0f\n%da\n", a.edges[i], i % 2 == 0) : printed("#%.0f\n%db\n", b.edges[k], k % 2 == 0);
    (isA ? i : k)++;
  }
  return vcd + printed("#%.0f\n", std::fmax(a.ns, b.ns));
}

}  // namespace

TEST_CASE("of several signals, the one with S.Bus is decoded, or the one that --signal names") {
  for (const TestFormat format : {TestFormat::Vcd, TestFormat::Saleae, TestFormat::PulseView}) {
    const std::string text = textOf(wireOf(), format, true);
    INFO("format ", static_cast<int>(format));
    CHECK(Decoded(text).signal == "RX");
    CHECK(Decoded(text).bytes() == All);
    CHECK(Decoded(text, "RX").bytes() == All);
    CHECK(holds(Decoded(text, "TX").failure, "there is no signal TX: one of "));
  }
  const std::string failure = Decoded(textOf(wireOf(), TestFormat::PulseView, true), "CLK").failure;
  CHECK(holds(failure, "signal CLK is not S.Bus: its shortest pulses last 3.0 us, as bits of 333333 baud do"));
  CHECK_FALSE(holds(failure, "signal RX"));
  CHECK(Decoded("Time [s],A,B,C,D,E,F,G,H,I\n0,0,0,0,0,0,0,0,0,0\n1,0,0,0,0,0,0,0,0,1\n", "X").failure ==
        "there is no signal X: one of A, B, C, D, E, F, G, H, ... is expected");
}

TEST_CASE(
    "a signal without frames is never taken for S.Bus, whatever other signals there are and however clean its "
    "characters") {
  TestWire bytes = wireOf();  // also 8E2 at 100000 baud
  bytes.edges.clear();
  bytes.ns = 2000000;
  for (int i = 0; i < 200; i++) {
    bytes.byte(static_cast<uint8_t>(i));
  }
  TestWire damaged = wireOf();  // one frame is whole
  for (const size_t edge : {9u, 60u, 100u}) {
    damaged.edges[edge] += 10000;
  }
  std::vector<TestWire> others = {bytes};
  const double endNs = wireOf().ns;
  for (const double halfPeriodNs : {500, 5000, 10000, 15000, 20000, 25000, 35000, 45000}) {
    TestWire clock;
    for (clock.ns = 1000; clock.ns < endNs; clock.ns += halfPeriodNs) {
      clock.edges.push_back(clock.ns);
    }
    others.push_back(clock);
  }
  for (const TestWire &other : others) {
    for (const TestWire &wire : {wireOf(), damaged}) {
      for (const bool otherFirst : {false, true}) {
        INFO("edges ", other.edges[0], " ", other.edges[1], ", first: ", otherFirst);
        const std::string both = otherFirst ? vcdOf(other, wire) : vcdOf(wire, other);
        CHECK(Decoded(both).signal == (otherFirst ? "B" : "A"));
        CHECK(Decoded(both).others.empty());
        CHECK(Decoded(both).wire.frames >= 1);
      }
    }
    const std::string alone = vcdOf(other, other);
    CHECK(Decoded(alone).signal == "");
    CHECK(holds(Decoded(alone).failure, "No signal has a frame of S.Bus: a frame is 25 characters"));
    CHECK(Decoded(alone, "A").wire.frames == 0);
  }
  CHECK(Decoded(vcdOf(bytes, bytes), "B").characters.size() == 200);  // since it was named
}

TEST_CASE(
    "of two signals with frames, the one with more frames is decoded, though its first characters have more errors") {
  TestWire few;
  few.bytes(Neutral.bytes);
  few.gap(30000000);
  TestWire more = wireOf();
  more.edges[3] += 10000;
  CHECK(Decoded(vcdOf(few, more)).signal == "B");
  CHECK(Decoded(vcdOf(few, more)).others == std::vector<std::string>{"A"});
}

TEST_CASE("a sender with one stop bit is read, and named: 8E1") {
  for (const unsigned stopBits : {1u, 2u}) {
    for (const double bitNs : {9750.0, 10000.0, 5125.0}) {
      for (const bool inverted : {true, false}) {
        CAPTURE(stopBits);
        TestWire wire;
        wire.stopBits = stopBits;
        wire.bitNs = bitNs;
        wire.inverted = inverted;
        for (int i = 0; i < 5; i++) {
          wire.bytes(Neutral.bytes);
          wire.gap(4000000);
        }
        const Decoded decoded(textOf(wire, TestFormat::Vcd));
        CHECK(decoded.wire.frames == 5);
        CHECK(decoded.wire.settings.format.stopBits == stopBits);
        CHECK(holds(text(decoded.wire.settings), stopBits == 1 ? "baud, 8E1" : "baud, 8E2"));
      }
    }
  }
}

TEST_CASE("options overrule what was found") {
  const std::string samples = sampled(wireOf(), 1000);
  const std::string noRate = samples.substr(samples.find('\n') + 1);
  const std::string fast = textOf(wireOf(9400), TestFormat::Saleae);  // 6 % off
  const std::string volts = textOf(wireOf(), TestFormat::Scope);
  const auto overrides = [](unsigned long baud, double periodNs, std::optional<double> volt) {
    line::Overrides told;
    told.baud = baud;
    told.periodNs = periodNs;
    told.threshold = volt;
    return told;
  };
  const struct {
    std::string what, text;
    line::Overrides told;
    bool right;
  } rows[] = {
      {"6 % too fast", fast, overrides(0, 0, {}), false},
      {"6 % too fast, but told so", fast, overrides(106000, 0, {}), true},
      {"the other baud rate", fast, overrides(200000, 0, {}), false},
      {"no rate", noRate, overrides(0, 0, {}), false},
      {"a rate", noRate, overrides(0, 1000, {}), true},
      {"the file's rate is wrong", replaced(samples, "1000000.0", "1500000.0"), overrides(0, 1000, {}), true},
      {"the file's times are wrong", replaced(volts, "(ms)", "(s)"), overrides(0, 1000, {}), true},
      {"a threshold on the slope", volts, overrides(0, 0, 1.2), true},
      {"a threshold above it all", volts, overrides(0, 0, 5), false},
  };
  for (const auto &row : rows) {
    INFO(row.what);
    const Decoded decoded(row.text, row.told);
    CHECK((decoded.wire.frames > 0) == row.right);
    CHECK((decoded.characters.size() == All.size() && decoded.bytes() == All) == row.right);
  }
  CHECK(Decoded(textOf(wireOf(), TestFormat::Vcd), overrides(0, 1000, {})).error ==
        "has times of its own: leave out --sample-rate");
  CHECK(Decoded(textOf(wireOf(), TestFormat::Saleae), overrides(0, 0, 1.5)).error ==
        "has no voltages: leave out --threshold");
  TestWire zeros;  // all of its pulses are ten bits long: nothing shows how long one bit is
  zeros.bytes(Bytes(5, 0));
  zeros.gap(1e6);
  CHECK(Decoded(textOf(zeros, TestFormat::Saleae)).characters.empty());
  CHECK(Decoded(textOf(zeros, TestFormat::Saleae), overrides(100000, 0, {})).bytes() == Bytes(5, 0));
}

TEST_CASE("of two signals that carry S.Bus, the one with fewer errors is decoded, and the other is named") {
  TestWire good = wireOf();
  TestWire worse = wireOf();
  worse.edges[9] += 10000;
  const struct {
    const TestWire &a, &b;
    std::string signal, other;
  } rows[] = {{good, worse, "A", "B"}, {worse, good, "B", "A"}, {good, good, "A", "B"}};
  for (const auto &row : rows) {
    const std::string vcd = vcdOf(row.a, row.b);
    CHECK(Decoded(vcd).signal == row.signal);
    CHECK(Decoded(vcd).others == std::vector<std::string>{row.other});
  }
}

TEST_CASE("S.Bus that begins after a million edges of noise is decoded without a missing byte") {
  TestWire wire;
  uint32_t random = 1;
  for (int i = 0; i < 1000524; i++) {  // fewer than fill the sample: S.Bus fills the other half
    random = random * 1664525 + 1013904223;
    wire.ns += 1000 + (random >> 16);
    wire.edges.push_back(wire.ns);
  }
  wire.gap(1e6);
  for (int i = 0; i < 20; i++) {
    wire.bytes(PaperLow.bytes);
    wire.gap(6e6);
  }
  const std::vector<WireCharacter> characters = Decoded(textOf(wire, TestFormat::Saleae)).characters;
  REQUIRE(characters.size() >= 500);
  for (size_t i = 0; i < 500; i++) {
    CHECK(characters[characters.size() - 500 + i].value == PaperLow.bytes[i % 25]);
  }
}

TEST_CASE("a signal that is not S.Bus is rejected with the reason") {
  TestWire uart;  // 115200 baud
  uart.bitNs = 8680;
  uart.bytes(All);
  TestWire silent;
  silent.gap(1e6);
  TestWire other;  // 100000 baud and 2 % less, but odd parity
  other.bitNs = 10200;
  for (const uint8_t byte : All) {
    unsigned ones = 0;
    for (unsigned i = 0; i < 8; i++) {
      ones += byte >> i & 1u;
    }
    other.character(byte | (1 - (ones & 1)) << 8 | 3u << 9);
  }
  TestWire brief;  // three characters
  brief.bytes(part(All, 0, 3));
  brief.gap(1e6);
  TestWire glitch = uart;
  glitch.edges.push_back(glitch.ns + 1000);
  glitch.edges.push_back(glitch.ns + 1500);
  TestWire noParity;  // 8N1; each character is followed by a third stop bit
  noParity.stopBits = 1;
  for (int i = 0; i < 20; i++) {
    for (const uint8_t byte : PaperLow.bytes) {
      noParity.character(byte | 7u << 8);
    }
    noParity.gap(6e6);
  }
  TestWire iBus;  // 8N1, uninverted
  iBus.bitNs = 8680;
  iBus.stopBits = 1;
  iBus.inverted = false;
  for (int i = 0; i < 20; i++) {
    for (int k = 0; k < 32; k++) {
      const uint8_t ends[] = {0x20, 0x40, 0x51, 0xF3};
      iBus.character((k < 2 || k > 29 ? ends[k % 28 % 4] : k % 2 == 0 ? 0xDCu : 0x05u) | 7u << 8);
    }
    iBus.gap(4e6);
  }
  TestWire ppm, servo, clock;
  for (int i = 0; i < 90; i++) {
    for (const auto &[wire, us, pulseUs] : {std::tuple{&ppm, i % 9 == 8 ? 9000 : 1000 + 10 * i, 300},
                                            std::tuple{&servo, 20000, 1000 + 10 * i}, std::tuple{&clock, 1000, 500}}) {
      wire->edges.insert(wire->edges.end(), {wire->ns, wire->ns + 1e3 * pulseUs});
      wire->gap(1e3 * us);
    }
  }
  const struct {
    std::string text, failure;
  } rows[] = {
      {textOf(noParity, TestFormat::Vcd),
       "signal RX has frames, but without parity: the sender has 8N1 or 8N2, and S.Bus has 8E2. No"},
      {textOf(iBus, TestFormat::Saleae),
       "signal RX is not S.Bus: the receiver sends i-BUS, FlySky's protocol. Set the receiver's output"},
      {textOf(ppm, TestFormat::Saleae), "signal RX carries PPM: set the receiver's port to S.BUS, not to CPPM. No"},
      {textOf(ppm, TestFormat::Scope), "carries PPM: set"},
      {textOf(servo, TestFormat::Vcd),
       "signal RX carries a servo's pulses: use the receiver's S.BUS port, or set this one to S.BUS. No"},
      {textOf(clock, TestFormat::Vcd),
       "signal RX is not S.Bus: its shortest pulses last 500.0 us, as bits of 2000 baud do"},
      {textOf(glitch, TestFormat::Saleae),
       "signal RX is not S.Bus: its shortest pulses last 8.7 us, as bits of 115207 baud do"},
      {textOf(wireOf(10400), TestFormat::Saleae),
       "its shortest pulses last 10.4 us, as bits of 96153 baud do: 10 us or 5 us are expected, within 3 %"},
      {textOf(brief, TestFormat::Saleae),
       "signal RX has 3 good characters at 100000 baud, 8E2, inverted, but no frame. No signal has a frame of S.Bus: a "
       "frame is 25 characters"},
      {textOf(silent, TestFormat::Saleae), "signal RX has no pulses: is the probe on S-BUS_OUT, and the receiver on?"},
      {textOf(silent, TestFormat::Saleae, true),
       "no signal has pulses: is the probe on S-BUS_OUT, and the receiver on? No signal has a frame"},
      {textOf(uart, TestFormat::Vcd),
       "signal RX is not S.Bus: its shortest pulses last 8.7 us, as bits of 115207 baud do: 10 us or 5 us are "
       "expected, within 3 %. No"},
      {textOf(silent, TestFormat::Scope), "has no pulses"},  // noise alone
      {textOf(uart, TestFormat::Saleae),
       "signal RX is not S.Bus: its shortest pulses last 8.7 us, as bits of 115207 baud do"},
      {textOf(other, TestFormat::Saleae),
       "have a wrong parity or stop bit: 8 data bits, even parity and 2 stop bits are expected"},
  };
  for (const auto &row : rows) {
    INFO(row.failure);
    CHECK_MESSAGE(holds(Decoded(row.text).failure, row.failure), Decoded(row.text).failure);
    CHECK(Decoded(row.text).characters.empty());
  }
}

TEST_CASE("four samples a bit are enough; fewer are reported, but still decoded down to a little more than two") {
  const struct {
    double bitNs, periodNs;
    bool right;
    const char *tooSlow;
  } rows[] = {
      {10000, 1000, true, ""},
      {10000, 2500, true, ""},
      {10000, 2600, true, "was sampled every 2.6 us, but a bit lasts 10.0 us: at least 4 samples a bit are expected"},
      {10000, 4500, true, "was sampled every 4.5 us, but a bit lasts 10.0 us"},
      {10000, 8000, false, "was sampled every 8.0 us, but a bit lasts 10.0 us"},
      {5000, 1250, true, ""},
      {5000, 1300, true, "was sampled every 1.3 us, but a bit lasts 5.0 us"},
      {5000, 2250, true, "was sampled every 2.3 us, but a bit lasts 5.0 us"},
      {5000, 4000, false, "was sampled every 4.0 us, but a bit lasts 10.0 us"},
      {8680, 2500, false, ""},  // no S.Bus at all
      {8680, 2600, false, "was sampled every 2.6 us, but a bit lasts 10.0 us"},
  };
  for (const auto &row : rows) {
    INFO("a bit lasts ", row.bitNs, " ns, sampled every ", row.periodNs);
    const Decoded decoded(sampled(wireOf(row.bitNs), row.periodNs));
    CHECK((decoded.bytes() == All) == row.right);
    const std::string said = row.right ? line::tooSlow(row.periodNs, row.bitNs) : decoded.failure;
    CHECK(holds(said, "was sampled every") == (*row.tooSlow != '\0'));
    CHECK_MESSAGE(holds(said, row.tooSlow), said);
  }
}
