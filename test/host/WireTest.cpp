// Captures of the wire itself: which format, which signal, which way up and how fast; then the characters.
#include "line/wire/WireDecoder.h"

#include <doctest/doctest.h>

#include "line/wire/VcdWriter.h"
#include "support/Bytes.h"
#include "support/KnownFrames.h"
#include "support/WireText.h"

using line::WireCharacter;

namespace {

// What a text holds. It is handed over in blocks of whole lines, as a file is.
struct Decoded {
  std::vector<WireCharacter> characters;
  std::string error;  // the place and what is wrong
  std::string failure;
  std::string signal;
  std::vector<std::string> others;
  line::FoundWire wire;

  explicit Decoded(const std::string &text, const std::string &only = "", size_t blockMax = 5000) {
    line::WireDecoder decoder(
        only, [] {}, [this](const WireCharacter &character) { characters.push_back(character); });
    line::OpenedCapture opened = line::openCapture(std::string_view(text).substr(0, line::CaptureHeadMax), decoder);
    error = opened.error;
    if (!opened.reader) {
      return;
    }
    for (size_t from = 0; from < text.size() && error.empty();) {
      const size_t end = text.size() - from <= blockMax ? text.size() : text.rfind('\n', from + blockMax) + 1;
      error = opened.reader->put(std::string_view(text).substr(from, end - from));
      from = end;
    }
    error = error.empty() ? opened.reader->finish() : error;
    error = error.empty() ? "" : std::to_string(opened.reader->lines()) + ": " + error;
    decoder.finish(opened.reader->endNs(), !error.empty());
    if (decoder.found()) {
      signal = decoder.signal();
      others = decoder.others();
      wire = decoder.wire();
    } else {
      failure = decoder.failure(opened.reader->periodNs());
    }
  }

  Bytes bytes() const {
    Bytes all;
    for (const WireCharacter &character : characters) {
      CHECK_FALSE(character.bad());
      all.push_back(character.value);
    }
    return all;
  }
};

TestWire wireOf(double bitNs = 10000, bool inverted = true) {
  TestWire wire;
  wire.bitNs = bitNs;
  wire.inverted = inverted;
  for (const KnownFrame &frame : KnownFrames) {
    wire.bytes(frame.bytes);
    wire.gap(4000000);
  }
  return wire;
}

// As a logic analyser samples it.
std::string sampled(const TestWire &wire, double periodNs) {
  std::string text = printed("; Samplerate: %.6f Hz\nlogic\n", 1e9 / periodNs);
  size_t edge = 0;
  for (double ns = 0; ns < wire.ns; ns += periodNs) {
    for (; edge < wire.edges.size() && wire.edges[edge] <= ns; edge++) {
    }
    text += edge % 2 == 0 ? "0\n" : "1\n";
  }
  return text;
}

const Bytes All = join({PaperLow.bytes, PaperHigh.bytes, Neutral.bytes, Sbus2.bytes});

// With `now` wherever `before` was.
std::string replaced(std::string text, const std::string &before, const std::string &now) {
  for (size_t at = text.find(before); at != std::string::npos; at = text.find(before, at + now.size())) {
    text.replace(at, before.size(), now);
  }
  return text;
}

bool holds(const std::string &text, const std::string &part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("each format, 100000 and 200000 baud within 3 %, either way up: the same bytes at their times") {
  for (const TestFormat format : TestFormats) {
    for (const double nominalNs : {10000.0, 5000.0}) {
      for (const double clock : {0.975, 1.0, 1.025}) {
        for (const bool inverted : {true, false}) {
          INFO("format ", static_cast<int>(format), ", bit ", nominalNs, " ns, clock ", clock, ", inverted ", inverted);
          const TestWire wire = wireOf(nominalNs * clock, inverted);
          const Decoded decoded(textOf(wire, format));
          CHECK(decoded.error == "");
          CHECK(decoded.failure == "");
          CHECK(holds(decoded.signal, "RX"));
          CHECK(decoded.bytes() == All);
          CHECK(decoded.wire.settings.baud == (nominalNs > 7000 ? 100000 : 200000));
          CHECK((decoded.wire.settings.polarity == line::Polarity::Inverted) == inverted);
          CHECK(decoded.wire.bitNs == doctest::Approx(wire.bitNs).epsilon(0.006));
          REQUIRE(decoded.characters.size() == All.size());
          const int64_t first = decoded.characters.front().startNs;
          const bool shifted = format == TestFormat::Saleae || format == TestFormat::Scope || format == TestFormat::Rigol ||
                               format == TestFormat::Owon;
          CHECK(std::abs(first - (shifted ? 1000000 : 2000000)) <= 2000);
          CHECK(std::abs(decoded.characters.back().startNs - first - static_cast<int64_t>(wire.ns - 6e6 - 12 * wire.bitNs)) <= 2000);
        }
      }
    }
  }
}

TEST_CASE("what else analysers and oscilloscopes write: the same bytes") {
  const std::string vcd = textOf(wireOf(), TestFormat::Vcd);
  const std::string saleae = textOf(wireOf(), TestFormat::Saleae);
  const std::string clocked = textOf(wireOf(), TestFormat::Saleae, true);
  const std::string dates = textOf(wireOf(), TestFormat::SaleaeIso);
  const std::string pulseView = textOf(wireOf(), TestFormat::PulseView);
  const std::string scope = textOf(wireOf(), TestFormat::Scope);
  const struct {
    std::string what, text;
  } rows[] = {
      {"blank lines before a VCD", "\n \n" + vcd},
      {"vectors of one bit", replaced(replaced(vcd, "1!", "b1 !"), "0!", "b0 !")},
      {"each level twice", replaced(replaced(vcd, "1!\n", "1!\n1!\n"), "0!\n", "0!\n0!\n")},
      {"unknown, then known", replaced(vcd, "#0\n", "#0\nx!\nz!\n")},
      {"comments, and strings as GTKWave has them", replaced(vcd, "$dumpvars\n", "$comment why? $end\nsidle %\n$dumpvars\n")},
      {"a long header", replaced(vcd, "$date today", "$date" + replaced("0000000000000000", "0", " today"))},
      {"a signal that is switched off", replaced(clocked, ",0,", ",X,")},
      {"quotation marks", replaced(replaced(saleae, "Time [s]", "\"Time [s]\""), ",1\r", ",\"1\"\r")},
      {"dates of Greenwich", replaced(dates, "+00:00", "Z")},
      {"dates west of it", replaced(dates, "+00:00", "-05:00")},
      {"dates without a zone", replaced(dates, "+00:00", "")},
      {"a rate in Hz", replaced(pulseView, "Samplerate: 1 MHz", "Sample rate: 1000000")},
      {"a rate in GHz", replaced(pulseView, "1 MHz", "0.001 GHz")},
      {"comments between rows", replaced(pulseView, "1\n0\n", "1\n; an edge\n# here\n\n0\n")},
      {"comments between voltages", replaced(scope, "1\n", "1\n; 0\n# 0\n\n")},
      {"a sample interval", replaced(textOf(wireOf(), TestFormat::OwonHandheld), "Time interval", "Sample Interval")},
      {"plus signs", replaced(scope, ",3", ",+3")},
      {"blanks", replaced(scope, ",", ", ")},
      {"a spike", std::string(scope).replace(scope.find(",3.", scope.size() / 3), 3, ",23.")},
      {"no title", replaced(textOf(wireOf(), TestFormat::DecimalCommas), "Zeit [s]", "")},
  };
  for (const auto &row : rows) {
    INFO(row.what);
    CHECK(Decoded(row.text).error == "");
    CHECK(Decoded(row.text).bytes() == All);
  }
}

TEST_CASE("the threshold is looked for again where the wire goes much further than before") {
  std::string small;  // but for so long that it is taken for a wire
  for (int i = 0; i < 450; i++) {
    small += printed("%.3f,%.2f\n", -3 + i * 0.001, i / 4 % 2 * 0.45 - 1);
  }
  const std::string units = "(ms),(V)\n";
  const Decoded decoded(replaced(textOf(wireOf(), TestFormat::Scope), units, units + small));
  REQUIRE(decoded.characters.size() == All.size() + 1);  // where it changes there is a break
  for (size_t i = 0; i < All.size(); i++) {
    CHECK(decoded.characters[i + 1].value == All[i]);
  }
}

TEST_CASE("names that several signals have: the module's before it, or the column's number; one wire, one name") {
  const std::string vcd = textOf(wireOf(), TestFormat::Vcd);
  const std::string var = "$var wire 1 ! RX $end\n";
  const std::string clocked = textOf(wireOf(), TestFormat::Saleae, true);
  CHECK(Decoded(replaced(vcd, var, "$scope module b $end $var wire 1 & RX $end $upscope $end " + var)).signal == "a.RX");
  CHECK(Decoded(replaced(vcd, var, "$var wire 1 & RX $end $scope module b $end " + var)).signal == "b.RX");
  CHECK(Decoded(replaced(vcd, var, var + "$scope module b $end $var wire 1 ! TX $end")).signal == "RX");
  CHECK(Decoded(replaced(clocked, "Channel 0", "RX")).signal == "3");
  CHECK(Decoded(replaced(clocked, "RX", "")).signal == "3");
}

TEST_CASE("a time's unit, where it is no whole number of ns") {
  TestWire wire = wireOf();
  std::string vcd = "$timescale 100 ps $end\n$var wire 1 ! RX $end\n$enddefinitions $end\n#0\n0!\n";
  std::string pulseView = "; CSV generated by libsigrok 0.5.2\n; Samplerate: 24 MHz\nnanoseconds,logic\n0,0\n";
  for (size_t i = 0; i < wire.edges.size(); i++) {
    vcd += printed("#%.0f\n%d!\n", wire.edges[i] * 10, i % 2 == 0);
    pulseView += printed("%.0f,%d\n", std::round(wire.edges[i] * 0.024) * 41, i % 2 == 0);  // sigrok cuts off 0.67 ns
  }
  for (const std::string &text : {vcd, pulseView}) {
    CHECK(Decoded(text).bytes() == All);
    CHECK(Decoded(text).wire.bitNs == doctest::Approx(10000).epsilon(0.001));
  }
}

TEST_CASE("an oscilloscope's samples beyond its range, in whatever encoding: high or low") {
  const std::string most = "\xE2\x88\x9E";
  const struct {
    std::string low, lowToo, high;
  } rows[] = {
      {"0", "0.03", most},  // the converter's last digit is no level
      {"-" + most, "-" + most, "3.3"},
      {"-" + most, "-" + most, most},
      {"0", "0.03", "\xC3\xA2\xC2\x88\xC2\x9E"},  // UTF-8 taken for Latin-1, and written as UTF-8
      {"0", "0.03", "\xC3\xA2\xCB\x86\xC5\xBE"},  // ... for Windows-1252
      {"0", "0.03", "\xEC"},                       // code page 437
  };
  for (const auto &row : rows) {
    INFO(row.low, " ", row.high);
    std::string text = "Time,RX\n(\xC2\xB5s),(V)\n\n";
    const TestWire wire = wireOf();
    size_t edge = 0;
    for (int us = 0; us * 1000 < wire.ns; us++) {
      for (; edge < wire.edges.size() && wire.edges[edge] <= us * 1000; edge++) {
      }
      text += std::to_string(us) + "," + (edge % 2 == 1 ? row.high : us % 2 == 0 ? row.low : row.lowToo) + "\n";
    }
    CHECK(Decoded(text).bytes() == All);
    CHECK(holds(Decoded(text + "1e6,-\n").error, "\"-\" is no voltage: a number is expected in column 2"));
  }
}

TEST_CASE("of several signals the one that carries S.Bus is found, or the one that was asked for") {
  for (const TestFormat format : {TestFormat::Vcd, TestFormat::Saleae, TestFormat::PulseView}) {
    const std::string text = textOf(wireOf(), format, true);
    INFO("format ", static_cast<int>(format));
    CHECK(Decoded(text).signal == "RX");
    CHECK(Decoded(text).bytes() == All);
    CHECK(Decoded(text, "RX").bytes() == All);
    CHECK(holds(Decoded(text, "TX").failure, "there is no signal TX: one of "));
  }
  const std::string failure = Decoded(textOf(wireOf(), TestFormat::PulseView, true), "CLK").failure;
  CHECK(holds(failure, "signal CLK is no S.Bus: its shortest pulses last 3.0 us, as bits of 333333 baud do"));
  CHECK_FALSE(holds(failure, "signal RX"));
  CHECK(Decoded("Time [s],A,B,C,D,E,F,G,H,I\n0,0,0,0,0,0,0,0,0,0\n1,0,0,0,0,0,0,0,0,1\n", "X").failure ==
        "there is no signal X: one of A, B, C, D, E, F, G, H, ... is expected");
}

TEST_CASE("of two signals that carry S.Bus the one with less errors is decoded, and the other one named") {
  TestWire good = wireOf();
  TestWire worse = wireOf();
  worse.edges[9] += 10000;
  const struct {
    const TestWire &a, &b;
    std::string signal, other;
  } rows[] = {{good, worse, "A", "B"}, {worse, good, "B", "A"}, {good, good, "A", "B"}};
  for (const auto &row : rows) {
    std::string vcd = "$timescale 1 ns $end\n$var wire 1 a A $end\n$var wire 1 b B $end\n$enddefinitions $end\n#0\n0a\n0b\n";
    for (size_t i = 0; i < row.a.edges.size(); i++) {
      const bool aFirst = row.a.edges[i] < row.b.edges[i];
      const std::string a = printed("#%.0f\n%da\n", row.a.edges[i], i % 2 == 0);
      const std::string b = printed("#%.0f\n%db\n", row.b.edges[i], i % 2 == 0);
      vcd += aFirst ? a + b : b + a;
    }
    CHECK(Decoded(vcd).signal == row.signal);
    CHECK(Decoded(vcd).others == std::vector<std::string>{row.other});
  }
}

TEST_CASE("S.Bus that begins after a million edges of noise: no byte of it is missing") {
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

TEST_CASE("the paper's bits, chapter 4.1: a framing error in byte 2, a parity error in byte 3, all others good") {
  const Decoded decoded(
      "1 00001111 1001 00111000 0001 00111111 1101 00000111 1001 00101011 1001 11111100 1001 00011100 0001 10101111 1001");
  const Bytes expected = {0x0F, 0xE3, 0x03, 0x1F, 0x2B, 0xC0, 0xC7, 0x0A};
  REQUIRE(decoded.characters.size() == expected.size());
  for (size_t i = 0; i < expected.size(); i++) {
    INFO("byte ", i);
    CHECK(decoded.characters[i].value == expected[i]);
    CHECK(decoded.characters[i].startNs == static_cast<int64_t>(i) * 120000);
    CHECK(decoded.characters[i].stopWrong == (i == 2));
    CHECK(decoded.characters[i].parityWrong == (i == 3));
  }
  CHECK(decoded.wire.settings.polarity == line::Polarity::Inverted);
}

TEST_CASE("a UART's rules: glitches, breaks, and the character after them") {
  TestWire wire = wireOf();
  wire.edges.push_back(wire.ns);  // shorter than half a bit: no start bit
  wire.edges.push_back(wire.ns + 4000);
  wire.gap(50000);
  wire.edges.push_back(wire.ns);  // a break: one framing error, however long
  wire.edges.push_back(wire.ns + 900000);
  wire.gap(950000);
  wire.byte(0x55);
  const Decoded decoded(textOf(wire, TestFormat::Saleae));
  REQUIRE(decoded.characters.size() == All.size() + 2);
  CHECK(decoded.characters[All.size()].value == 0);
  CHECK(decoded.characters[All.size()].stopWrong);
  CHECK(decoded.characters[All.size() + 1].value == 0x55);
  CHECK_FALSE(decoded.characters[All.size() + 1].bad());
}

TEST_CASE("a capture that ends within a character: that one is left out, unless its last edge is the end") {
  const std::string vcd = textOf(wireOf(), TestFormat::Vcd);
  const std::string atItsEdge = vcd.substr(0, vcd.rfind('#'));
  const struct {
    std::string text;
    size_t characters;
  } rows[] = {
      {atItsEdge, 100},
      {atItsEdge.substr(0, atItsEdge.rfind('#')), 99},
      {atItsEdge + printed("#%.0f\n", (wireOf().ns - 4e6 - 25000) / 10), 99},  // the middle of its parity bit
  };
  for (const auto &row : rows) {
    INFO(row.text.size(), " bytes");
    CHECK(Decoded(row.text).error == "");
    CHECK(Decoded(row.text).bytes() == part(All, 0, row.characters));
  }
}

TEST_CASE("what is no S.Bus, and why") {
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
  TestWire seldom;  // sampled at 300 kHz, and nobody says so
  for (const double edge : uart.edges) {
    seldom.edges.push_back(std::ceil(edge * 0.0003) / 0.0003);
  }
  const struct {
    std::string text, failure;
  } rows[] = {
      {textOf(glitch, TestFormat::Saleae), "signal RX is no S.Bus: its shortest pulses last 8.7 us, as bits of 115207 baud do"},
      {textOf(wireOf(10400), TestFormat::Saleae), "its shortest pulses last 10.4 us, as bits of 96153 baud do: 10 us or 5 us are expected, within 3 %"},
      {textOf(seldom, TestFormat::Saleae), "signal RX was sampled every 3.3 us, but a bit lasts 10.0 us"},
      {textOf(brief, TestFormat::Saleae), "signal RX has only 3 good characters: at least 4 are expected, record for longer"},
      {textOf(silent, TestFormat::Vcd), "signal RX has no pulses: is the probe on S-BUS_OUT, and the receiver on?"},
      {textOf(silent, TestFormat::Scope), "has no pulses"},  // noise alone
      {textOf(uart, TestFormat::Saleae), "signal RX is no S.Bus: its shortest pulses last 8.7 us, as bits of 115207 baud do"},
      {textOf(other, TestFormat::Saleae), "have a wrong parity or stop bit: 8 data bits, even parity and 2 stop bits are expected"},
  };
  for (const auto &row : rows) {
    INFO(row.failure);
    CHECK_MESSAGE(holds(Decoded(row.text).failure, row.failure), Decoded(row.text).failure);
    CHECK(Decoded(row.text).characters.empty());
  }
}

TEST_CASE("four samples a bit are enough, with less it is said so; bits are still told with a little more than two") {
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

TEST_CASE("malformed captures: the line, what is wrong and what is expected") {
  const std::string vcd = "$timescale 1 us $end\n$var wire 1 ! RX $end\n$enddefinitions $end\n";
  const std::string saleae = "Time [s],RX\n0.0,0\n0.1,1\n";
  const struct {
    std::string text, error;
  } rows[] = {
      {"", "is empty: a capture of a wire is expected"},
      {"PK\x03\x04", "is a session of PulseView or Logic 2: export it as VCD or as CSV"},
      {"<SALEAE>\x01", "is Logic 2's binary export: export it as CSV"},
      {"# ours\n120 0F E3\n", "is a recording of characters, not a capture of the wire"},
      {"beef 0F E3\n", "is no capture of a wire that is known"},
      {"0\n1\n0\n1\n", "does not say when its samples were taken"},
      {"hello\nworld\n", "is no capture of a wire that is known: VCD, CSV of Saleae Logic 2"},
      {"0,1\n0,1\n1,0\n", "does not say when its samples were taken"},
      {"$timescale 1 us $end\n", "1: ends within its header: $enddefinitions $end is expected"},
      {"$timescale 3 us $end\n", "1: \"3us\" is not a timescale: 1, 10 or 100 and s, ms, us, ns, ps or fs is expected"},
      {"$var wire 1 ! RX $end\n$enddefinitions $end\n", "2: there is no $timescale before this line"},
      {"$timescale 1 us $end\n$enddefinitions $end\n", "2: there is no variable of one bit before this line"},
      {"$timescale 1 us $end\nvar\n", "2: \"var\" stands outside of a section"},
      {"$var wire 1 $end\n", "1: a variable is not complete: type, number of bits, code and name are expected"},
      {vcd + "#0\n0!\n#x\n", "6: \"x\" is not a time: a whole number is expected after #"},
      {vcd + "#5\n0!\n#4\n", "6: time 4 is before the one that came before it: times in order are expected"},
      {vcd + "#99999999999999999\n", "4: time 99999999999999999 is later than a year: is the timescale right?"},
      {vcd + "#1000000000000000000\n", "4: \"1000000000000000000\" is not a time"},
      {vcd + "#0\n2!\n", "5: \"2!\" is no value change: #TIME, or 0 or 1 and a variable's code is expected"},
      {vcd + "#0\n0\n", "5: a value has no code: one such as 1! is expected"},
      {saleae + "0.2\n", "4: the row ends after column 1: column 2 is expected"},
      {textOf(wireOf(), TestFormat::PulseView) + "2\n", "30005: \"2\" is no level: 0 or 1 is expected in column 1"},
      {saleae + "soon,0\n", "4: \"soon\" is not a time: a number is expected in column 1"},
      {saleae + "soon,1\n", "4: \"soon\" is not a time: a number is expected in column 1"},
      {"Time,V\n1,0.1\n2,0.1\n3,0.1\n4,0.1\nsoon,3\n6,3\n7,3\n8,3\n9,0\n10,0\n", "6: \"soon\" is not a time: a number is expected in column 1"},
      {saleae + "0.05,0\n", "4: a time is before that of a row above: times in order are expected"},
      {saleae + "1e9,0\n", "4: a time is beyond a year: is its unit right?"},
      {"Time,V\n0,0.1\n1,0.2\n2,0.1\n3,volt\n", "5: \"volt\" is no voltage: a number is expected in column 2"},
      {"0110\n0120\n", "does not say when its samples were taken"},
  };
  for (const auto &row : rows) {
    INFO(row.text);
    CHECK(Decoded(row.text).error.substr(0, row.error.size()) == row.error);
  }
}

TEST_CASE("what is wrong somewhere does not take what came before it") {
  for (const TestFormat format : TestFormats) {
    INFO("format ", static_cast<int>(format));
    const std::string text = textOf(wireOf(), format);
    const Decoded decoded(text + "what?\n");
    CHECK(decoded.error != "");
    CHECK(decoded.bytes() == All);
  }
}

TEST_CASE("the VCD of a recording reads as the recording: bytes, times, which are bad") {
  for (const unsigned long baud : {100000ul, 200000ul}) {
    for (const line::Polarity polarity : {line::Polarity::Inverted, line::Polarity::Uninverted}) {
      for (const int64_t startUs : {int64_t{-60}, int64_t{-1}, int64_t{0}, int64_t{1}, int64_t{5000000000}}) {
        INFO("baud ", baud, ", start ", startUs);
        line::LineSettings settings;
        settings.baud = baud;
        settings.polarity = polarity;
        line::VcdWriter writer(settings);
        std::string text;
        line::Character character;
        character.endUs = static_cast<uint64_t>(startUs);
        for (size_t i = 0; i < All.size(); i++) {
          character.endUs += settings.characterUs() + (i % 25 == 24 ? 3000 : 0);
          character.value = All[i];
          character.bad = i == 30;
          text += writer.put(character);
        }
        text += writer.finish();
        const Decoded decoded(text);
        REQUIRE(decoded.characters.size() == All.size());
        CHECK(decoded.wire.settings.polarity == polarity);
        CHECK(decoded.characters.front().startNs == (startUs > 0 ? startUs : settings.characterUs()) * 1000);
        for (size_t i = 0; i < All.size(); i++) {
          CHECK(decoded.characters[i].value == All[i]);
          CHECK(decoded.characters[i].parityWrong == (i == 30));
          CHECK_FALSE(decoded.characters[i].stopWrong);
        }
      }
    }
  }
}
