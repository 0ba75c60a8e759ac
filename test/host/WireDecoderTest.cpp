// Decodes the characters of the wire by a UART's rules; captures that are cut off or malformed.
#include "line/uart/Levels.h"
#include "support/Decoded.h"

TEST_CASE("a framing error in byte 2 and a parity error in byte 3 are told apart, and there is no other error") {
  const Bytes bytes = {0x0F, 0xE3, 0x03, 0x1F, 0x2B, 0xC0, 0xC7, 0x0A};
  TestWire wire;
  for (size_t i = 0; i < bytes.size(); i++) {
    const unsigned parity = line::isOdd(bytes[i]) != (i == 3), stops = i == 2 ? 2 : 3;
    wire.character(bytes[i] | parity << 8 | stops << 9);
  }
  wire.gap(1e6);
  const Decoded decoded(textOf(wire, TestFormat::Vcd), "RX");
  REQUIRE(decoded.characters.size() == bytes.size());
  for (size_t i = 0; i < bytes.size(); i++) {
    INFO("byte ", i);
    CHECK(decoded.characters[i].value == bytes[i]);
    CHECK(decoded.characters[i].startNs == 2000000 + static_cast<int64_t>(i) * 120000);
    CHECK(decoded.characters[i].stopWrong == (i == 2));
    CHECK(decoded.characters[i].parityWrong == (i == 3));
  }
}

TEST_CASE("glitches, breaks and the character after them are decoded as a UART does") {
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

TEST_CASE("a character in which the capture ends is left out, unless its last edge is the end") {
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

TEST_CASE("a malformed capture is rejected: the message has the line, what is wrong and what is expected") {
  const std::string vcd = "$timescale 1 us $end\n$var wire 1 ! RX $end\n$enddefinitions $end\n";
  const std::string saleae = "Time [s],RX\n0.0,0\n0.1,1\n";
  const struct {
    std::string text, error;
  } rows[] = {
      {"", "is empty: a capture of a wire is expected"},
      {"beef 0F E3\n", "is not a known capture of a wire"},
      {"0\n1\n0\n1\n", "does not say when its samples were taken"},
      {"hello\nworld\n", "is not a known capture of a wire: VCD, or CSV of Saleae Logic 2"},
      {"0,1\n0,1\n1,0\n", "does not say when its samples were taken"},
      {"$timescale 1 us $end\n", "1: ends within its header: $enddefinitions $end is expected"},
      {"$timescale 3 us $end\n", "1: \"3us\" is not a timescale: 1, 10 or 100 and s, ms, us, ns, ps or fs is expected"},
      {"$var wire 1 ! RX $end\n$enddefinitions $end\n", "2: there is no $timescale before this line"},
      {"$timescale 1 us $end\n$enddefinitions $end\n", "2: there is no variable of bits before this line"},
      {"$timescale 1 us $end\n$var real 0 ! v $end\n$enddefinitions $end\n",
       "3: there is no variable of bits before this line"},
      {"$timescale 1 us $end\nvar\n", "2: \"var\" is outside a section"},
      {"$var wire 1 $end\n", "1: a variable is not complete: type, number of bits, code and name are expected"},
      {vcd + "#0\n0!\n#x\n", "6: \"x\" is not a time: a whole number is expected after #"},
      {vcd + "#5\n0!\n#4\n", "6: time 4 is before the previous one: times in order are expected"},
      {vcd + "#99999999999999999\n", "4: time 99999999999999999 is later than a year: is the timescale right?"},
      {vcd + "#1000000000000000000\n", "4: \"1000000000000000000\" is not a time"},
      {vcd + "#0\n2!\n", "5: \"2!\" is not a value change: #TIME, or 0 or 1 and a variable's code is expected"},
      {vcd + "#0\n0\n", "5: a value has no code: one such as 1! is expected"},
      {saleae + "0.2\n", "4: the row ends after column 1: column 2 is expected"},
      {textOf(wireOf(), TestFormat::PulseView) + "2\n", "30005: \"2\" is not a level: 0 or 1 is expected in column 1"},
      {saleae + "soon,0\n", "4: \"soon\" is not a time: a number is expected in column 1"},
      {saleae + "soon,1\n", "4: \"soon\" is not a time: a number is expected in column 1"},
      {"Time,V\n1,0.1\n2,0.1\n3,0.1\n4,0.1\nsoon,3\n6,3\n7,3\n8,3\n9,0\n10,0\n",
       "6: \"soon\" is not a time: a number is expected in column 1"},
      {saleae + "0.05,0\n", "4: a time is before that of a row above: times in order are expected"},
      {saleae + "1e9,0\n", "4: a time is beyond a year: is its unit right?"},
      {"Time,V\n0,0.1\n1,0.2\n2,0.1\n3,volt\n", "5: \"volt\" is not a voltage: a number is expected in column 2"},
      {"0110\n0120\n", "does not say when its samples were taken"},
  };
  for (const auto &row : rows) {
    INFO(row.text);
    CHECK(Decoded(row.text).error.substr(0, row.error.size()) == row.error);
  }
}

TEST_CASE("what came before an error is decoded") {
  for (const TestFormat format : TestFormats) {
    INFO("format ", static_cast<int>(format));
    const std::string text = textOf(wireOf(), format);
    const Decoded decoded(text + "what?\n");
    const bool endsWithEdge = format == TestFormat::DsView || format == TestFormat::DsViewOld;  // and more may be lost
    CHECK(decoded.error != "");
    CHECK(decoded.bytes() == part(All, 0, endsWithEdge ? 99 : 100));
  }
}

TEST_CASE("all that comes before a capture's first frame is decoded, or the part from a gap on that fits in memory") {
  constexpr size_t Packets = 400;  // of 24 bytes: no frame
  TestWire wire;
  for (size_t i = 0; i < Packets; i++) {
    Bytes bytes(24, static_cast<uint8_t>(i));
    bytes[0] = 0x0F;
    wire.bytes(bytes);
    wire.gap(4000000);
  }
  const size_t packetEdges = wire.edges.size();
  for (const KnownFrame &frame : KnownFrames) {
    wire.bytes(frame.bytes);
    wire.gap(4000000);
  }
  for (const bool hasFrames : {false, true}) {
    for (const size_t keptMax : {size_t{64} << 20, size_t{1}}) {
      CAPTURE(hasFrames);
      CAPTURE(keptMax);
      std::vector<WireCharacter> characters;
      line::WireDecoder decoder(
          {}, [] {}, [&](const WireCharacter &character) { characters.push_back(character); }, nullptr, keptMax);
      decoder.signals({"RX"});
      decoder.level(0, 0, false);
      const size_t edges = hasFrames ? wire.edges.size() : packetEdges;
      for (size_t i = 0; i < edges; i++) {
        decoder.level(0, static_cast<int64_t>(wire.edges[i]), i % 2 == 0);
      }
      decoder.finish(static_cast<int64_t>(hasFrames ? wire.ns : wire.edges[edges - 1] + 1e6), false);
      REQUIRE(decoder.found());
      const size_t all = 24 * Packets + (hasFrames ? All.size() : 0);
      CHECK(std::none_of(characters.begin(), characters.end(), [](const WireCharacter &each) { return each.bad(); }));
      CHECK((characters.size() == all) == (keptMax > 1));
      CHECK(decoder.note().empty() == (keptMax > 1));
      CHECK(characters.size() >= 192);  // a sample of 1024 edges at least
      CHECK(decoder.wire().frames == (hasFrames ? 4 : 0));
    }
  }
}
