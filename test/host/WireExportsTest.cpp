// Captures that a program has processed: Saleae's table of characters, sessions of sigrok.
#include "line/capture/Parsing.h"
#include "support/Decoded.h"

using line::lower;

namespace {

// Returns what Saleae's analyser exports for the known frames, with a character every `characterNs`. Logic 1:
// saleae/serial- analyzer, src/SerialAnalyzerResults.cpp:103 to 128, with hexadecimal values. Logic 2: a row for each
// FrameV2, src/SerialAnalyzer.cpp:240 to 256; the columns of data are in quotation marks, in any order; an empty last
// field is kept.
std::string asyncOf(bool logic2, double characterNs = 120000, size_t parityWrong = SIZE_MAX,
                    size_t framingWrong = SIZE_MAX) {
  std::string text =
      logic2 ? "name,type,start_time,duration,\"data\",\"error\"\n" : "Time [s],Value,Parity Error,Framing Error\n";
  for (size_t i = 0; i < All.size(); i++) {
    const double seconds = (2e6 + static_cast<double>(i) * characterNs + static_cast<double>(i / 25) * 4e6) / 1e9;
    const bool parity = i == parityWrong, framing = i == framingWrong;
    text += logic2 ? printed("\"Async Serial\",\"data\",%.9g,%.9g,0x%02X,%s\n", seconds, characterNs / 1.05e9, All[i],
                             parity    ? "\"parity\""
                             : framing ? "\"framing\""
                                       : "")
                   : printed("%.15f,0x%02X,%s,%s\n", seconds, All[i], parity ? "Error" : "", framing ? "Error" : "");
  }
  return text;
}

// Writes a session as libsigrok does, src/output/srzip.c:103 to 156 and 278; RX is this bit of a sample.
std::string metadataOf(size_t sampleSize, size_t bit) {
  return "[global]\nsigrok version=0.5.2\n\n[device 1]\ncapturefile=logic-1\ntotal probes=" +
         std::to_string(8 * sampleSize) + "\nsamplerate=1 MHz\ntotal analog=0\nprobe2=CLK\nprobe" +
         std::to_string(bit + 1) + "=RX\nunitsize=" + std::to_string(sampleSize) + "\n";
}

}  // namespace

TEST_CASE("characters that Saleae's analyser has decoded give the same bytes at their times, and their errors") {
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
      {"Logic 2, error before data",
       replaced(replaced(logic2, "\"data\",\"error\"", "\"error\",\"data\""), ",0x", ",,0x"), "Async Serial"},
      {"Logic 2, binary", binary, "Async Serial"},
      {"Logic 2, small letters", lower(logic2).replace(0, title.size(), title), "async serial"},
      {"Logic 2, a name of its own", replaced(logic2, "Async Serial", "RX"), "RX"},
      {"Logic 2, another analyser", replaced(logic2, title, title + i2c), "Async Serial"},
      {"Logic 2, two that take turns", replaced(logic2, "0x0F,", "0x0F,\n\"B\",\"data\",0.0021,1e-4,0x55,"),
       "Async Serial"},
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

TEST_CASE(
    "characters that Saleae's analyser has decoded, but without S.Bus: the message has what is wrong and what is "
    "expected") {
  const std::string logic1 = asyncOf(false);
  const std::string title1 = logic1.substr(0, logic1.find('\n') + 1);
  const std::string logic2 = asyncOf(true);
  const std::string title2 = logic2.substr(0, logic2.find('\n') + 1);
  const std::string notByte = "is not a byte: export the table with hexadecimal values, such as 0x0F";
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
      {logic2 + "\"B\",\"data\",9,1e-4,0x0F,\n",
       "102: \"B\" has no row among the first ones: a table of one analyser is expected"},
  };
  for (const auto &row : rows) {
    INFO(row.text.substr(row.text.size() - 30));
    CHECK(Decoded(row.text).error == row.error);
  }
  line::Overrides told;
  told.periodNs = 1000;
  CHECK(Decoded(logic2, told).error == "has times of its own: leave out --sample-rate");
  const std::string two =
      replaced(replaced(logic2, "0x0F", "0x0E"), title2, title2 + "\"B\",\"data\",0.001,1e-4,0x55,\n");
  CHECK(holds(Decoded(two).failure,
              "signal Async Serial has 100 good characters and 0 with errors: is the analyser set to the baud rate, 8 "
              "bits, even parity, 2 stop bits and inverted? No signal"));
}

TEST_CASE("a session of sigrok is read: its metadata, and samples in pieces of any size") {
  const std::string text = sampled(wireOf(), 1000);
  const struct { size_t sampleSize, bit; } rows[] = {{1, 0}, {1, 7}, {2, 9}, {4, 31}};
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

TEST_CASE("a session of sigrok that lists 16 probes, of which 8 were recorded, is read") {
  std::string metadata = metadataOf(1, 0);
  for (int probe = 9; probe <= 16; probe++) {
    metadata += "probe" + std::to_string(probe) + "=D" + std::to_string(probe - 1) + "\n";
  }
  const std::string text = sampled(wireOf(), 1000);
  std::string samples;
  for (size_t at = text.find("logic\n") + 6; at < text.size(); at += 2) {
    samples += text[at] == '1' ? '\1' : '\0';
  }
  const Decoded decoded(metadata, samples, samples.size());
  CHECK(decoded.error == "");
  CHECK(decoded.signal == "RX");
  CHECK(decoded.bytes() == All);
}

TEST_CASE("a session of sigrok that cannot be decoded: the message has what is wrong and what is expected") {
  const std::string metadata = metadataOf(1, 0);
  const std::string none = "has no logic signals: a session with them, or CSV of analogue ones, is expected";
  const struct {
    std::string metadata, error;
  } rows[] = {
      {"", none},
      {replaced(metadata, "[device 1]", "[device 2]"), none},
      {replaced(metadata, "capturefile=logic-1\n", ""), none},  // analogue signals only
      {replaced(metadata, "unitsize=1\n", ""), none},           // no samples
      {replaced(replaced(metadata, "probe1", "analog1"), "probe2", "analog2"), none},
      {replaced(replaced(metadata, "probe1=", "probe9="), "probe2=", "probe10="),
       "has more probes than fit into its unitsize of 1"},
      {replaced(metadata, "1 MHz", "0 Hz"), "does not say when its samples were taken: --sample-rate is expected"},
      {replaced(metadata, "1 MHz", "0.000000001 Hz"), "is longer than a year: is its sample rate right?"},
  };
  for (const auto &row : rows) {
    INFO(row.metadata);
    CHECK(Decoded(row.metadata, "ab", 2).error == row.error);
  }
}
