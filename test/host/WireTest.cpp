// Captures of the wire itself: which format, which signal, which way up and how fast; then the characters.
#include "line/capture/WireDecoder.h"

#include <doctest/doctest.h>

#include "line/capture/SessionReader.h"
#include "line/capture/Text.h"
#include "line/capture/VcdWriter.h"
#include "support/Bytes.h"
#include "support/KnownFrames.h"
#include "support/WireText.h"

using line::WireCharacter;
using line::lower;

namespace {

// What a text holds. It is handed over in blocks of whole lines, as a file is.
struct Decoded {
  std::vector<WireCharacter> characters;
  std::string error;  // the place and what is wrong
  std::string failure;
  std::string format;
  std::string signal;
  std::vector<std::string> others;
  line::FoundWire wire;

  explicit Decoded(const std::string &text, const std::string &only = "") : Decoded(text, signalOf(only)) {}

  Decoded(const std::string &text, const line::Overrules &overrules) {
    constexpr size_t blockMax = 5000;
    line::WireDecoder decoder(
        overrules, [] {}, [this](const WireCharacter &character) { characters.push_back(character); });
    line::OpenedCapture opened = line::openCapture(std::string_view(text).substr(0, line::CaptureHeadMax), decoder, overrules);
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
    format = opened.reader->format();
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

  // Of a session, unpacked; the samples in pieces.
  Decoded(const std::string &metadata, const std::string &samples, size_t piece) {
    line::WireDecoder decoder(
        {}, [] {}, [this](const WireCharacter &character) { characters.push_back(character); });
    line::SessionReader reader(decoder, 0);
    error = reader.metadata(metadata);
    for (size_t from = 0; from < samples.size() && error.empty(); from += piece) {
      error = reader.put(std::string_view(samples).substr(from, piece));
    }
    decoder.finish(reader.endNs(), !error.empty());
    signal = decoder.found() ? decoder.signal() : "";
  }

  static line::Overrules signalOf(const std::string &name) {
    line::Overrules overrules;
    overrules.signal = name;
    return overrules;
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

const Bytes All = join({PaperLow.bytes, PaperHigh.bytes, Neutral.bytes, Sbus2.bytes});

const char *nameOf(TestFormat format) {
  switch (format) {
    case TestFormat::Vcd:
      return "VCD";
    case TestFormat::Saleae:
    case TestFormat::SaleaeIso:
      return "logic analyser's CSV";
    case TestFormat::PulseView:
    case TestFormat::PulseViewTimed:
      return "PulseView CSV";
    case TestFormat::DsView:
    case TestFormat::DsViewOld:
    case TestFormat::DsViewAnalogue:
      return "DSView CSV";
    default:
      return "oscilloscope's CSV";
  }
}

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

// As sigrok-cli -O bits and -O hex print it: libsigrok, src/output/bits.c:101 to 111 and 142 to 185, src/output/hex.c:154 to 205: the
// samples of `width`, in eights, the last ones of hexadecimal digits filled up with zeros; where it was triggered a line with T.
std::string sigrokOf(const TestWire &wire, bool hex, size_t width, bool triggered = false) {
  const std::string samples = sampled(wire, 1000);
  std::string levels[2];
  for (size_t at = samples.find("logic\n") + 6, i = 0; at < samples.size(); at += 2, i++) {
    levels[0] += i / 3 % 2 == 0 ? '0' : '1';  // a clock
    levels[1] += samples[at];
  }
  std::string text = "libsigrok 0.5.2\nAcquisition with 2/8 channels at 1 MHz\n";
  for (size_t from = 0; from < levels[0].size(); from += width) {
    for (const size_t signal : {0u, 1u}) {
      const std::string row = levels[signal].substr(from, width);
      text += signal == 0 ? "CLK:" : "RX:";
      for (size_t i = 0; i < row.size(); i += 8) {
        unsigned byte = 0;
        const std::string bits = row.substr(i, 8);
        for (const char bit : bits + std::string(8 - bits.size(), '0')) {
          byte = byte << 1 | static_cast<unsigned>(bit == '1');
        }
        text += hex ? printed("%.2x ", byte) : (i > 0 ? " " : "") + bits;
      }
      text += "\n";
    }
    text += triggered && from == 0 ? "T:    ^ 4\n" : "";
  }
  return text;
}

// What Saleae's analyser makes of the known frames, `characterNs` from one to the next. Logic 1: saleae/serial-analyzer,
// src/SerialAnalyzerResults.cpp:103 to 128, with hexadecimal values. Logic 2: a row for each FrameV2, src/SerialAnalyzer.cpp:240 to
// 256; the columns of data are in quotation marks, in any order, and a last field that is empty is there.
std::string asyncOf(bool logic2, double characterNs = 120000, size_t parityWrong = SIZE_MAX, size_t framingWrong = SIZE_MAX) {
  std::string text = logic2 ? "name,type,start_time,duration,\"data\",\"error\"\n" : "Time [s],Value,Parity Error,Framing Error\n";
  for (size_t i = 0; i < All.size(); i++) {
    const double seconds = (2e6 + static_cast<double>(i) * characterNs + static_cast<double>(i / 25) * 4e6) / 1e9;
    const bool parity = i == parityWrong, framing = i == framingWrong;
    text += logic2 ? printed("\"Async Serial\",\"data\",%.9g,%.9g,0x%02X,%s\n", seconds, characterNs / 1.05e9, All[i],
                             parity ? "\"parity\"" : framing ? "\"framing\"" : "")
                   : printed("%.15f,0x%02X,%s,%s\n", seconds, All[i], parity ? "Error" : "", framing ? "Error" : "");
  }
  return text;
}

// As libsigrok writes it, src/output/srzip.c:103 to 156 and 278; RX is this bit of a sample.
std::string metadataOf(size_t sampleSize, size_t bit) {
  return "[global]\nsigrok version=0.5.2\n\n[device 1]\ncapturefile=logic-1\ntotal probes=" + std::to_string(8 * sampleSize) +
         "\nsamplerate=1 MHz\ntotal analog=0\nprobe2=CLK\nprobe" + std::to_string(bit + 1) +
         "=RX\nunitsize=" + std::to_string(sampleSize) + "\n";
}

// Two inverted wires, A and B, in one capture.
std::string vcdOf(const TestWire &a, const TestWire &b) {
  std::string vcd = "$timescale 1 ns $end\n$var wire 1 a A $end\n$var wire 1 b B $end\n$enddefinitions $end\n#0\n0a\n0b\n";
  for (size_t i = 0, k = 0; i < a.edges.size() || k < b.edges.size();) {
    const bool isA = k == b.edges.size() || (i < a.edges.size() && a.edges[i] <= b.edges[k]);
    vcd += isA ? printed("#%.0f\n%da\n", a.edges[i], i % 2 == 0) : printed("#%.0f\n%db\n", b.edges[k], k % 2 == 0);
    (isA ? i : k)++;
  }
  return vcd + printed("#%.0f\n", std::fmax(a.ns, b.ns));
}

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
          CHECK(decoded.format == nameOf(format));
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
      {"reals", replaced(replaced(vcd, "$var wire 8 % bus", "$var real 64 % bus"), "b0101 %", "r1.25e3 %")},
      {"a vector of more bits than signals can be", replaced(vcd, "$var wire 8 % bus", "$var wire 99999 % bus")},
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

TEST_CASE("the names of an oscilloscope's and of DSView's channels: numbers, in one row or in two, with commas at their end") {
  const std::string saleae = textOf(wireOf(), TestFormat::Saleae, true);
  const std::string keysight = textOf(wireOf(), TestFormat::Keysight);
  const std::string dsView = textOf(wireOf(), TestFormat::DsView, true);
  const std::string rigol = textOf(wireOf(), TestFormat::Rigol);
  const struct {
    std::string what, text, signal;
  } rows[] = {
      {"DSView", dsView, "RX"},
      {"DSView, numbers", replaced(dsView, "RX", "1"), "1"},
      {"DSView, trailing commas", replaced(replaced(replaced(dsView, "RX", "1,"), ",0\n", ",0,\n"), ",1\n", ",1,\n"), "1"},
      {"numbers after a time", replaced(replaced(saleae, "Channel 0", "0"), "RX", "1"), "1"},
      {"more trailing commas in the title", replaced(saleae, "RX", "RX,,"), "RX"},
      {"more trailing commas in the rows", replaced(replaced(saleae, ",0\r", ",0,,\r"), ",1\r", ",1,,\r"), "RX"},
      {"Keysight", keysight, "RX"},
      {"Keysight, as it comes", replaced(keysight, "RX", "1"), "1"},
      {"Keysight, trailing commas", replaced(replaced(keysight, "RX\n", "1,\n"), "Volt\n", "Volt,\n"), "1"},
      {"units in brackets", textOf(wireOf(), TestFormat::Scope), "RX"},
      {"Rigol", rigol, "RX"},
  };
  for (const auto &row : rows) {
    INFO(row.what);
    const Decoded decoded(row.text);
    CHECK(decoded.error == "");
    CHECK(decoded.signal == row.signal);
    CHECK(decoded.bytes() == All);
    CHECK(Decoded(row.text, row.signal).bytes() == All);
  }
}

TEST_CASE("a VCD's vectors: each bit is a signal and has its number") {
  // As simulators write them: zeros before the first one are left out (IEEE 1364-2005, 18.2.1). Bit 3 from the right is
  // the wire, bit 0 a clock.
  const TestWire wire = wireOf();
  std::string body = "$enddefinitions $end\n#0\nb0 %\n";
  for (size_t i = 0; i < wire.edges.size(); i++) {
    body += printed("#%.0f\nb%s %%\n#%.0f\nb%s %%\n", wire.edges[i], i % 2 == 0 ? "1000" : "0", wire.edges[i] + 500,
                    i % 2 == 0 ? "1001" : "1");
  }
  body += printed("#%.0f\n", wire.ns);
  const struct {
    std::string variable, body, signal;
  } rows[] = {
      {"$var wire 8 % bus $end", body, "bus[3]"},
      {"$var reg 8 % bus [7:0] $end", body, "bus[3]"},
      {"$var integer 32 % bus[31:0] $end", body, "bus[3]"},
      {"$var wire 8 % bus [15:8] $end", body, "bus[11]"},
      {"$var wire 8 % bus [0:7] $end", body, "bus[4]"},
      {"$var wire 4 % bus [99999999999999999999] $end", body, "bus[3]"},
      {"$var wire 8 %%% bus $end", replaced(body, " %", " %%%"), "bus[3]"},
      {"$var wire 8 % bus $end", replaced(body, "b", "B"), "bus[3]"},
      {"$var wire 8 % bus $end", replaced(replaced(body, "b1001 ", "bx1 "), "b1 ", "bz1 "), "bus[3]"},  // others unknown
      {"$var wire 4 % bus $end", replaced(replaced(body, "b0 ", "b110000 "), "b1", "b111"), "bus[3]"},
      {"$var wire 1 % bus [3] $end", replaced(replaced(replaced(body, "b1 ", "b0 "), "b1001", "b1"), "b1000", "b1"), "bus[3]"},
  };
  for (const auto &row : rows) {
    INFO(row.variable, " ", row.body.substr(20, 30));
    const Decoded decoded("$timescale 1 ns $end\n" + row.variable + "\n" + row.body);
    CHECK(decoded.error == "");
    CHECK(decoded.signal == row.signal);
    CHECK(decoded.bytes() == All);
  }
}

TEST_CASE("characters that Saleae's analyser has decoded: the same bytes at their times, and their errors") {
  const std::string logic1 = asyncOf(false);
  const std::string logic2 = asyncOf(true);
  const std::string i2c = "\"I2C\",\"start\",0.001,1e-07,,\n\"I2C\",\"data\",0.001,2e-05,0x0F,\n";
  const std::string title = logic2.substr(0, logic2.find('\n') + 1);
  std::string binary = logic2;
  for (int byte = 0; byte <= UINT8_MAX; byte++) {
    std::string digits = "0b";
    for (int bit = 7; bit >= 0; bit--) {
      digits += byte >> bit & 1 ? '1' : '0';
    }
    binary = replaced(binary, printed("0x%02X", byte), digits);
  }
  std::string decimal = logic1;
  for (int byte = UINT8_MAX; byte >= 0; byte--) {
    decimal = replaced(decimal, printed("0x%02X", byte), std::to_string(byte));
  }
  const struct {
    std::string what, text, signal;
  } rows[] = {
      {"Logic 1", logic1, "Async Serial"},
      {"Logic 1, Windows", replaced(logic1, "\n", "\r\n"), "Async Serial"},
      {"Logic 1, decimal", decimal, "Async Serial"},
      {"Logic 2", logic2, "Async Serial"},
      {"Logic 2, no error, so no column", replaced(replaced(logic2, ",\"error\"", ""), ",\n", "\n"), "Async Serial"},
      {"Logic 2, error before data", replaced(replaced(logic2, "\"data\",\"error\"", "\"error\",\"data\""), ",0x", ",,0x"), "Async Serial"},
      {"Logic 2, binary", binary, "Async Serial"},
      {"Logic 2, small letters", lower(logic2).replace(0, title.size(), title), "async serial"},
      {"Logic 2, dates", replaced(logic2, "\"data\",0.", "\"data\",2021-12-31T23:59:59."), "Async Serial"},
      {"Logic 2, a name of its own", replaced(logic2, "Async Serial", "RX"), "RX"},
      {"Logic 2, another analyser", replaced(logic2, title, title + i2c), "Async Serial"},
      {"Logic 2, two that take turns", replaced(logic2, "0x0F,", "0x0F,\n\"B\",\"data\",0.0021,1e-4,0x55,"), "Async Serial"},
  };
  for (const auto &row : rows) {
    INFO(row.what);
    const Decoded decoded(row.text);
    CHECK(decoded.error == "");
    CHECK(decoded.format == "Saleae's table of characters");
    CHECK(decoded.signal == row.signal);
    CHECK(decoded.bytes() == All);
  }
  for (const bool isLogic2 : {false, true}) {
    for (const double characterNs : {120000.0, 116500.0, 123500.0, 107000.0, 60000.0, 58300.0, 61700.0}) {
      INFO("Logic 2: ", isLogic2, ", a character lasts ", characterNs);
      const Decoded decoded(asyncOf(isLogic2, characterNs, 30, 60));
      REQUIRE(decoded.characters.size() == All.size());
      for (size_t i = 0; i < All.size(); i++) {
        CHECK(decoded.characters[i].value == All[i]);
        CHECK(decoded.characters[i].parityWrong == (i == 30));
        CHECK(decoded.characters[i].stopWrong == (i == 60));
        const double ns = 2e6 + static_cast<double>(i) * characterNs + static_cast<double>(i / 25) * 4e6;
        const bool late = characterNs == 107000 && i == 61;  // the wrong stop bit lasts until then
        CHECK(std::abs(decoded.characters[i].startNs - std::llround(ns) - (late ? 3000 : 0)) <= 1);
      }
    }
  }
}

TEST_CASE("characters that Saleae's analyser has decoded, but no frames of S.Bus: what is wrong and what is expected") {
  const std::string logic1 = asyncOf(false);
  const std::string title1 = logic1.substr(0, logic1.find('\n') + 1);
  const std::string logic2 = asyncOf(true);
  const std::string title2 = logic2.substr(0, logic2.find('\n') + 1);
  const std::string notByte = "is no byte: export the table with hexadecimal values, such as 0x0F";
  const struct {
    std::string text, error;
  } rows[] = {
      {title1 + "0.1,',,\n", "2: \"'\" " + notByte},
      {title1 + "0.1,'15',,\n", "2: \"'15'\" " + notByte},
      {title1 + "0.1,0x100,,\n", "2: \"0x100\" " + notByte},
      {title1 + "0.1,0x,,\n", "2: \"0x\" " + notByte},
      {title1 + "0.1,0b12,,\n", "2: \"0b12\" " + notByte},
      {title1 + "soon,0x0F,,\n", "2: \"soon\" is not a time: a number is expected in column 1"},
      {title1 + "1e9,0x0F,,\n", "2: a time is beyond a year: is its unit right?"},
      {logic1 + "0.1,0x0F,,\n0.09,0x0F,,\n", "103: a time is before that of a row above: times in order are expected"},
      {logic2 + "\"B\",\"data\",9,1e-4,0x0F,\n", "102: \"B\" has no row among the first ones: a table of one analyser is expected"},
  };
  for (const auto &row : rows) {
    INFO(row.text.substr(row.text.size() - 30));
    CHECK(Decoded(row.text).error == row.error);
  }
  line::Overrules told;
  told.periodNs = 1000;
  CHECK(Decoded(logic2, told).error == "has times of its own: leave out --rate");
  told.periodNs = 0;
  told.polarity = line::Polarity::Inverted;
  CHECK(Decoded(logic2, told).error == "has characters that are decoded already: leave out --invert");
  const std::string two = replaced(replaced(logic2, "0x0F", "0x0E"), title2, title2 + "\"B\",\"data\",0.001,1e-4,0x55,\n");
  CHECK(holds(Decoded(two).failure,
              "signal Async Serial has 100 good characters and 0 bad ones: is the analyser set to the baud rate, 8 bits, even parity, 2 stop bits and inverted? No signal"));
}

TEST_CASE("samples as sigrok prints them, as bits and in hexadecimal digits, with lines of any width") {
  for (const bool hex : {false, true}) {
    for (const size_t width : {size_t{8}, size_t{64}, size_t{192}, size_t{4000}, hex ? size_t{40} : size_t{13}}) {
      for (const bool triggered : {false, true}) {
        INFO("hex ", hex, ", width ", width, ", triggered ", triggered);
        const Decoded decoded(sigrokOf(wireOf(), hex, width, triggered));
        CHECK(decoded.error == "");
        CHECK(decoded.format == (hex ? "sigrok hex" : "sigrok bits"));
        CHECK(decoded.signal == "RX");
        CHECK(decoded.bytes() == All);
        REQUIRE(!decoded.characters.empty());
        CHECK(std::abs(decoded.characters.front().startNs - 2000000) <= 1000);
      }
    }
  }
  const std::string bits = sigrokOf(wireOf(), false, 64);
  const std::string noRate = replaced(bits, " at 1 MHz", "");
  line::Overrules told;
  told.periodNs = 1000;
  CHECK(Decoded(noRate, told).bytes() == All);
  CHECK(Decoded(replaced(bits, "1 MHz", "3 MHz"), told).bytes() == All);
  const std::string begin = "libsigrok 0.5.2\nAcquisition with 2/8 channels at 1 MHz\n";
  const struct {
    std::string text, error;
  } rows[] = {
      {noRate, "2: does not say when its samples were taken: --rate is expected"},
      {replaced(bits, "with 2/8", "with 0/8"), "2: there are no signals: \"Acquisition with 1/8 channels\" or more is expected"},
      {replaced(bits, "1 MHz", "0.0000000001 Hz"), "4: is longer than a year: is its rate right?"},
      {begin + "CLK:0101\n", "3: the samples of 2 signals are expected, but only those of 1 came"},
      {begin + "CLK:01\nRX:011\n", "4: there are 3 samples: as many as above, 2, are expected"},
      {begin + "CLK:0\nRX:1\nRX:1\n", "5: \"RX\" stands where samples of \"CLK\" are expected"},
      {begin + "CLK:0101 0102\n", "3: \"2\" is no bit: 0 or 1 is expected"},
      {begin + "CLK:0f g0\n", "3: \"g\" is no hexadecimal digit"},
      {begin + "0101\n", "3: \"0101\" has no samples: a signal's name, a colon and samples are expected"},
  };
  for (const auto &row : rows) {
    INFO(row.error);
    CHECK(Decoded(row.text).error == row.error);
  }
}

TEST_CASE("a session of sigrok: its metadata, and samples in pieces of any size") {
  const std::string text = sampled(wireOf(), 1000);
  const struct {
    size_t sampleSize, bit;
  } rows[] = {{1, 0}, {1, 7}, {2, 9}, {4, 31}};
  for (const auto &row : rows) {
    std::string samples;
    for (size_t at = text.find("logic\n") + 6, i = 0; at < text.size(); at += 2, i++) {
      std::string sample(row.sampleSize, '\0');
      sample[row.bit / 8] = static_cast<char>(static_cast<unsigned>(text[at] == '1') << row.bit % 8);
      sample[0] = static_cast<char>(sample[0] | static_cast<char>(i / 3 % 2 << 1));  // a clock
      samples += sample;
    }
    for (const size_t piece : {size_t{1}, size_t{3}, size_t{1000}, samples.size()}) {
      INFO("bit ", row.bit, " of ", row.sampleSize, " bytes, in pieces of ", piece);
      const Decoded decoded(metadataOf(row.sampleSize, row.bit), samples, piece);
      CHECK(decoded.error == "");
      CHECK(decoded.signal == "RX");
      CHECK(decoded.bytes() == All);
      REQUIRE(!decoded.characters.empty());
      CHECK(std::abs(decoded.characters.front().startNs - 2000000) <= 1000);
    }
  }
}

TEST_CASE("a session of sigrok that cannot be decoded: what is wrong and what is expected") {
  const std::string metadata = metadataOf(1, 0);
  const std::string none = "has no logic signals: a session with them, or CSV of analogue ones, is expected";
  const struct {
    std::string metadata, error;
  } rows[] = {
      {"", none},
      {replaced(metadata, "[device 1]", "[device 2]"), none},
      {replaced(metadata, "capturefile=logic-1\n", ""), none},  // analogue ones alone
      {replaced(metadata, "unitsize=1\n", ""), none},          // no samples
      {replaced(replaced(metadata, "probe1", "analog1"), "probe2", "analog2"), none},
      {replaced(metadata, "probe1=", "probe9="), "has more probes than fit into its unitsize of 1"},
      {replaced(metadata, "1 MHz", "0 Hz"), "does not say when its samples were taken: --rate is expected"},
      {replaced(metadata, "1 MHz", "0.000000001 Hz"), "is longer than a year: is its samplerate right?"},
  };
  for (const auto &row : rows) {
    INFO(row.metadata);
    CHECK(Decoded(row.metadata, "ab", 2).error == row.error);
  }
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

TEST_CASE("a signal without frames is never taken for S.Bus, whatever stands beside it and however clean its characters are") {
  TestWire bytes = wireOf();  // 8E2 at 100000 baud, too
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
  CHECK(Decoded(vcdOf(bytes, bytes), "B").characters.size() == 200);  // as it was asked for
}

TEST_CASE("of two signals with frames the one with more is decoded, though its first characters have more errors") {
  TestWire few;
  few.bytes(Neutral.bytes);
  few.gap(30000000);
  TestWire more = wireOf();
  more.edges[3] += 10000;
  CHECK(Decoded(vcdOf(few, more)).signal == "B");
  CHECK(Decoded(vcdOf(few, more)).others == std::vector<std::string>{"A"});
}

TEST_CASE("what the user knows better overrules what is found") {
  const std::string samples = sampled(wireOf(), 1000);
  const std::string noRate = samples.substr(samples.find('\n') + 1);
  const std::string bits = replaced(noRate.substr(noRate.find('\n') + 1), "0\n0\n0\n0\n", "0000\n");
  const std::string fast = textOf(wireOf(9400), TestFormat::Saleae);  // 6 % off
  const std::string uninverted = textOf(wireOf(10000, false), TestFormat::Saleae);
  const std::string volts = textOf(wireOf(), TestFormat::Scope);
  const auto overrules = [](unsigned long baud, line::Polarity polarity, double periodNs, std::optional<double> volt) {
    line::Overrules told;
    told.baud = baud;
    told.polarity = polarity;
    told.periodNs = periodNs;
    told.threshold = volt;
    return told;
  };
  const auto Either = line::Polarity::Either;
  const struct {
    std::string what, text;
    line::Overrules told;
    bool right;
  } rows[] = {
      {"6 % too fast", fast, overrules(0, Either, 0, {}), false},
      {"6 % too fast, but told so", fast, overrules(106000, Either, 0, {}), true},
      {"the other baud rate", fast, overrules(200000, Either, 0, {}), false},
      {"uninverted, as it is", uninverted, overrules(0, line::Polarity::Uninverted, 0, {}), true},
      {"inverted, as it is not", uninverted, overrules(0, line::Polarity::Inverted, 0, {}), false},
      {"no rate", noRate, overrules(0, Either, 0, {}), false},
      {"a rate", noRate, overrules(0, Either, 1000, {}), true},
      {"the file's rate is wrong", replaced(samples, "1000000.0", "1500000.0"), overrules(0, Either, 1000, {}), true},
      {"the file's times are wrong", replaced(volts, "(ms)", "(s)"), overrules(0, Either, 1000, {}), true},
      {"samples without a title", bits, overrules(0, Either, 1000, {}), true},
      {"a threshold on the slope", volts, overrules(0, Either, 0, 1.2), true},
      {"a threshold above it all", volts, overrules(0, Either, 0, 5), false},
  };
  for (const auto &row : rows) {
    INFO(row.what);
    const Decoded decoded(row.text, row.told);
    CHECK((decoded.wire.frames > 0) == row.right);
    CHECK((decoded.characters.size() == All.size() && decoded.bytes() == All) == row.right);
  }
  CHECK(Decoded(textOf(wireOf(), TestFormat::Vcd), overrules(0, Either, 1000, {})).error == "has times of its own: leave out --rate");
  CHECK(Decoded(textOf(wireOf(), TestFormat::Saleae), overrules(0, Either, 0, 1.5)).error == "has no voltages: leave out --threshold");
  TestWire zeros;  // whose pulses are all of ten bits: nothing tells how long one is
  zeros.bytes(Bytes(5, 0));
  zeros.gap(1e6);
  CHECK(Decoded(textOf(zeros, TestFormat::Saleae)).characters.empty());
  CHECK(Decoded(textOf(zeros, TestFormat::Saleae), overrules(100000, Either, 0, {})).bytes() == Bytes(5, 0));
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
    const std::string vcd = vcdOf(row.a, row.b);
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
      {textOf(brief, TestFormat::Saleae), "signal RX has 3 good characters at 100000 baud, 8E2, inverted, but no frame. No signal has a frame of S.Bus: a frame is 25 characters"},
      {textOf(silent, TestFormat::Saleae), "signal RX has no pulses: is the probe on S-BUS_OUT, and the receiver on?"},
      {textOf(silent, TestFormat::Saleae, true), "no signal has pulses: is the probe on S-BUS_OUT, and the receiver on? No signal has a frame"},
      {textOf(uart, TestFormat::Vcd), "signal RX is no S.Bus: its shortest pulses last 8.7 us, as bits of 115207 baud do: 10 us or 5 us are expected, within 3 %. No"},
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
      {"<SALEAE>\x01", "is Logic 2's binary export: export it as CSV"},
      {"# ours\n120 0F E3\n", "is a recording of characters, not a capture of the wire"},
      {"beef 0F E3\n", "is no capture of a wire that is known"},
      {"0\n1\n0\n1\n", "does not say when its samples were taken"},
      {"hello\nworld\n", "is no capture of a wire that is known: VCD, CSV of Saleae Logic 2"},
      {"0,1\n0,1\n1,0\n", "does not say when its samples were taken"},
      {"$timescale 1 us $end\n", "1: ends within its header: $enddefinitions $end is expected"},
      {"$timescale 3 us $end\n", "1: \"3us\" is not a timescale: 1, 10 or 100 and s, ms, us, ns, ps or fs is expected"},
      {"$var wire 1 ! RX $end\n$enddefinitions $end\n", "2: there is no $timescale before this line"},
      {"$timescale 1 us $end\n$enddefinitions $end\n", "2: there is no variable of bits before this line"},
      {"$timescale 1 us $end\n$var real 64 ! v $end\n$enddefinitions $end\n", "3: there is no variable of bits before this line"},
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
    const bool endsWithEdge = format == TestFormat::DsView || format == TestFormat::DsViewOld;  // and more may be lost
    CHECK(decoded.error != "");
    CHECK(decoded.bytes() == part(All, 0, endsWithEdge ? 99 : 100));
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
