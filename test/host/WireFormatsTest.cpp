// Captures of the wire in the formats of analysers and oscilloscopes give the same bytes at their times.
#include "support/Decoded.h"
#include "line/capture/VcdWriter.h"

namespace {

const char *nameOf(TestFormat format) {
  switch (format) {
    case TestFormat::Vcd:
      return "VCD";
    case TestFormat::Saleae:
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

}  // namespace

TEST_CASE("each format gives the same bytes at their times, at 100000 and 200000 baud within 3 %, of either polarity") {
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
          const bool shifted =
              format == TestFormat::Saleae || format == TestFormat::Scope || format == TestFormat::Rigol;
          CHECK(std::abs(first - (shifted ? 1000000 : 2000000)) <= 2000);
          CHECK(std::abs(decoded.characters.back().startNs - first -
                         static_cast<int64_t>(wire.ns - 6e6 - 12 * wire.bitNs)) <= 2000);
        }
      }
    }
  }
}

TEST_CASE("variations of analysers and oscilloscopes give the same bytes") {
  const std::string vcd = textOf(wireOf(), TestFormat::Vcd);
  const std::string saleae = textOf(wireOf(), TestFormat::Saleae);
  const std::string clocked = textOf(wireOf(), TestFormat::Saleae, true);
  const std::string pulseView = textOf(wireOf(), TestFormat::PulseView);
  const std::string scope = textOf(wireOf(), TestFormat::Scope);
  const struct {
    std::string what, text;
  } rows[] = {
      {"blank lines before a VCD", "\n \n" + vcd},
      {"vectors of one bit", replaced(replaced(vcd, "1!", "b1 !"), "0!", "b0 !")},
      {"each level twice", replaced(replaced(vcd, "1!\n", "1!\n1!\n"), "0!\n", "0!\n0!\n")},
      {"unknown, then known", replaced(vcd, "#0\n", "#0\nx!\nz!\n")},
      {"comments, and strings as GTKWave has them",
       replaced(vcd, "$dumpvars\n", "$comment why? $end\nsidle %\n$dumpvars\n")},
      {"reals", replaced(replaced(vcd, "$var wire 8 % bus", "$var real 64 % bus"), "b0101 %", "r1.25e3 %")},
      {"a vector of more bits than signals can be", replaced(vcd, "$var wire 8 % bus", "$var wire 99999 % bus")},
      {"a long header", replaced(vcd, "$date today", "$date" + replaced("0000000000000000", "0", " today"))},
      {"a signal that is switched off", replaced(clocked, ",0,", ",X,")},
      {"quotation marks", replaced(replaced(saleae, "Time [s]", "\"Time [s]\""), ",1\r", ",\"1\"\r")},
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

// Rows as Hantek's DSO5000 writes them: Stylesoftware/Hantek-DSO5000-Series-CSV-to-PulseVIew, sample/WaveData50.csv; a
// DSO2000 and a DSO5202P have the two bases in two lines. No file of a Rigol DHO was found: with times it is as a
// public Python program for Rigol's oscilloscopes writes it, to be "compatible with the oscilloscope's export"; without
// times as users report it.
TEST_CASE("heads of oscilloscopes that name no columns give the same bytes") {
  const TestWire wire = wireOf();
  std::string timed, sampled, both;
  size_t edge = 0;
  for (int us = 0; us * 1000.0 < wire.ns; us++) {
    for (; edge < wire.edges.size() && wire.edges[edge] <= us * 1000.0; edge++) {
    }
    const double volts = ((edge % 2 == 0) == wire.inverted ? 0.04 : 3.28) + us % 3 * 0.04;
    timed += printed("%.5E,%.3f\n", (us + 1) / 1e6, volts * 1e3);
    sampled += printed("%.5E,,\n", volts);
    both += printed("%.6e,%.6e,,\n", us / 1e6 - 5e-4, volts);
  }
  const struct {
    const char *what;
    std::string text;
    const char *signal;
  } rows[] = {
      {"Hantek", "#timebase=40000000(ps),#voltbase=1000000(uV)\n\n" + timed, "2"},
      {"Hantek, two lines", "#timebase=40000000(ps)\n,#voltbase=1000000(mv/100)\n#size=4064\n" + timed, "2"},
      {"Hantek, an empty line between", "#timebase=4000000000(ps)\n\n,#voltbase=1000000(uV)\n\n" + timed, "2"},
      {"Rigol DHO, with times", "Time(s),CH1V,t0 =-5.000000e-04, tInc = 1.000000e-06,\n" + both, "CH1V"},
      {"Rigol DHO, without", "CH1V,t0 =-5.000000e-04,tInc =1.000000e-06\n" + sampled, "CH1V"},
      {"Rigol DHO, blanks", "CH1V, t0 = -5.0E-04, tInc = 1.0E-06,\n" + sampled, "CH1V"},
  };
  for (const auto &row : rows) {
    INFO(row.what);
    const Decoded decoded(row.text);
    CHECK(decoded.error == "");
    CHECK(decoded.failure == "");
    CHECK(decoded.bytes() == All);
    CHECK(decoded.signal == row.signal);
  }
}

TEST_CASE("the threshold is found again where the wire goes much further than before") {
  std::string small;  // but long enough to be taken for a wire
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

TEST_CASE(
    "if several signals have the same name, it gets the module's name or the column's number; a wire has one name") {
  const std::string vcd = textOf(wireOf(), TestFormat::Vcd);
  const std::string var = "$var wire 1 ! RX $end\n";
  const std::string clocked = textOf(wireOf(), TestFormat::Saleae, true);
  CHECK(Decoded(replaced(vcd, var, "$scope module b $end $var wire 1 & RX $end $upscope $end " + var)).signal ==
        "a.RX");
  CHECK(Decoded(replaced(vcd, var, "$var wire 1 & RX $end $scope module b $end " + var)).signal == "b.RX");
  CHECK(Decoded(replaced(vcd, var, var + "$scope module b $end $var wire 1 ! TX $end")).signal == "RX");
  CHECK(Decoded(replaced(clocked, "Channel 0", "RX")).signal == "3");
  CHECK(Decoded(replaced(clocked, "RX", "")).signal == "3");
}

TEST_CASE(
    "the channels of an oscilloscope or DSView have numbers or names, in one row or in two, also with trailing "
    "commas") {
  const std::string saleae = textOf(wireOf(), TestFormat::Saleae, true);
  const std::string keysight = textOf(wireOf(), TestFormat::Keysight);
  const std::string dsView = textOf(wireOf(), TestFormat::DsView, true);
  const std::string rigol = textOf(wireOf(), TestFormat::Rigol);
  const struct {
    std::string what, text, signal;
  } rows[] = {
      {"DSView", dsView, "RX"},
      {"DSView, numbers", replaced(dsView, "RX", "1"), "1"},
      {"DSView, trailing commas", replaced(replaced(replaced(dsView, "RX", "1,"), ",0\n", ",0,\n"), ",1\n", ",1,\n"),
       "1"},
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

TEST_CASE("each bit of a VCD's vector is a signal, and has its number") {
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
      {"$var wire 8 % bus $end", replaced(replaced(body, "b1001 ", "bx1 "), "b1 ", "bz1 "),
       "bus[3]"},  // others unknown
      {"$var wire 4 % bus $end", replaced(replaced(body, "b0 ", "b110000 "), "b1", "b111"), "bus[3]"},
      {"$var wire 1 % bus [3] $end", replaced(replaced(replaced(body, "b1 ", "b0 "), "b1001", "b1"), "b1000", "b1"),
       "bus[3]"},
  };
  for (const auto &row : rows) {
    INFO(row.variable, " ", row.body.substr(20, 30));
    const Decoded decoded("$timescale 1 ns $end\n" + row.variable + "\n" + row.body);
    CHECK(decoded.error == "");
    CHECK(decoded.signal == row.signal);
    CHECK(decoded.bytes() == All);
  }
}

TEST_CASE("a unit of time that is no whole number of ns is exact") {
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

TEST_CASE("the VCD of a recording reads as the recording: bytes, times, character errors") {
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

TEST_CASE("simulators' uneven times and Saleae's dates give the same bytes, and a period that a bit holds often") {
  const TestWire wire = wireOf();
  std::string ltspice = "time\tV(sbus)\n", ngspice, dates = "Time,Channel 0\n2023-06-07T23:59:59.999000000+00:00,0\n";
  const auto row = [&](double ns, bool high) {
    ltspice += printed("%.15e\t%.6e\n", ns / 1e9, high ? 3.3 : 0.0);
    ngspice += printed(" %.8e  %.8e \n", ns / 1e9, high ? 3.3 : 0.0);
  };
  double before = 0;
  bool high = false;
  for (const double edge : wire.edges) {
    for (double ns = before + 50000; ns < edge - 1000; ns += 50000) {  // coarse where nothing happens
      ltspice += printed("%.15e\t%.6e\n", ns / 1e9, high ? 3.3 : 0.0);
    }
    row(edge - 10, high);
    high = !high;
    row(edge, high);
    const auto ns = static_cast<unsigned long long>(edge) + 999000567;
    dates += printed("2023-06-%02u", ns < 1000000000 ? 7u : 8u) +
             printed(ns < 1000000000 ? "T23:59:59.%09llu" : "T00:00:00.%09llu", ns % 1000000000) +
             (high ? "+00:00,1\n" : "+00:00,0\n");
    before = edge;
  }
  row(wire.ns, high);
  const std::string micros = replaced(replaced(dates, "567+", "+"), "000+", "+");
  for (const std::string &text : {ltspice, ngspice, dates, micros}) {
    INFO(text.substr(0, 200));
    const Decoded decoded(text);
    CHECK(decoded.error == "");
    CHECK(decoded.bytes() == All);
    CHECK(decoded.characters.front().startNs % 1000 == (text == dates ? 567 : 0));
    const line::CaptureForm form = line::captureForm(std::string_view(text).substr(0, line::CaptureHeadMax));
    CHECK(line::tooSlow(form.periodNs, 10000) == "");
  }
}

TEST_CASE("of times that are rounded to microseconds the period is the mean") {
  std::string rounded = "Time [s],Channel 0\n";
  for (int i = 0; i < 500; i++) {
    rounded += printed("%.6f,%.1f\n", i * 2.6e-6, i % 7 < 3 ? 0.1 : 3.2);
  }
  CHECK(line::captureForm(rounded).periodNs == doctest::Approx(2600).epsilon(0.01));
}
