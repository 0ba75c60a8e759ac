// sbus doctor: tries every setting to find what is wrong with a line, and the remedy, like examples/Diagnose.

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "cli/Json.h"
#include "cli/Output.h"
#include "cli/SettingTrial.h"
#include "cli/Stop.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Examination.h"
#include "line/Format.h"

namespace tool {

namespace {

constexpr unsigned long CrsfBaud = 420000;  // i-BUS, F.Port, SUMD and Spektrum have 115200, as a sketch's rows

// All settings together take two seconds.
constexpr uint64_t TrialUs = 450000;    // 11 frames of the slowest known receiver (25 Hz)
constexpr uint64_t RowsUs = 700000;     // three rows, 200 ms each
constexpr uint64_t FramesUs = 1500000;  // if the first setting has frames: more frames to judge by

// Returns the settings to try, the expected one first: for sim a sketch's begin(), for a recording its own settings. A
// serial port's polarity is not tried, since the adapter sets it; for a stream there is only one setting, since its
// bytes have already been received.
std::vector<line::LineSettings> settingsOf(const SourceOption &source) {
  line::LineSettings settings = source.settings();
  if (settings == line::csvSettings()) {
    return {settings};
  }
  settings.baud = source.isWire() && !source.isFile() ? sbus::Baud : settings.baud;
  settings.polarity = source.isWire() ? settings.polarity : line::Polarity::Either;
  std::vector<line::LineSettings> all = {settings};
  if (source.isStream() || !source.hasTimes()) {
    return all;
  }
  settings.baud = settings.baud == sbus::Baud ? 2 * sbus::Baud : sbus::Baud;
  all.push_back(settings);
  if (!source.isWire()) {
    all.push_back(line::csvSettings());
    all.push_back(line::csvSettings());
    all.back().baud = CrsfBaud;
    return all;
  }
  for (const size_t i : {size_t{0}, size_t{1}}) {
    line::LineSettings other = all[i];
    other.polarity = other.idleHigh() ? line::Polarity::Inverted : line::Polarity::Uninverted;
    all.push_back(other);
  }
  return all;
}

// Returns the remedy for a PC; sbus::remedy() is for sketches, and names pins and methods.
std::string remedyAtPc(sbus::Finding finding) {
  switch (finding) {
    case sbus::Finding::NoSignal:
      return "Check the wire to RXD, GND and the receiver: is it powered and bound, and is its port set to S.Bus, not "
             "CPPM?";
    case sbus::Finding::NoFrames:
      return "Connect GND. Is it S.Bus? Is RXD not inverted, or is there one inverter too many?";
    case sbus::Finding::Channels24:
      return "Set the receiver to 16 channels for devices that read no more.";
    case sbus::Finding::WrongPolarity:
      return "Invert the adapter's RXD, or add or remove an inverter.";
    case sbus::Finding::WrongBaud:
      return "Use the setting that has frames: Fast S.Bus has 200000 baud.";
    case sbus::Finding::WrongPolarityAndBaud:
      return "Invert the adapter's RXD, or add or remove an inverter; use the baud rate that has frames.";
    case sbus::Finding::PolledTooSeldom:
      return "Close the programs that keep this PC busy.";
    default:
      return sbus::remedy(finding);
  }
}

// Returns a line of further advice for a PC; usually empty.
std::string advice(sbus::Finding finding, const SourceOption &source, const line::LineSettings &expected,
                   const line::LineSettings &best, unsigned periodMs) {
  switch (finding) {
    case sbus::Finding::NoFrames:
      return source.isWire() ? "" : "An FTDI adapter inverts RXD if its EEPROM says so: extras/docs/ftdi.md\n";
    case sbus::Finding::WrongBaud:
      return "With sbus: --baud " + std::to_string(best.baud) + "\n";
    case sbus::Finding::Channels24:
      return std::string("With sbus: it shows all 24") +
             (best.baud != expected.baud ? ", with --baud " + std::to_string(best.baud) : "") +
             (best.polarity != expected.polarity ? ", once the line has the other polarity" : "") + ".\n";
    case sbus::Finding::LongPeriod:
      return line::format("With its %u ms: setTimeout(%u)\n", periodMs, (3 * periodMs + 49) / 50 * 50);
    default:
      return {};
  }
}

struct Verdict {
  bool well;
  std::string finding;
  std::string remedy;
  std::string advice{};  // further lines of the text

  Json json() const { return Json("verdict").flag("well", well).text("finding", finding).text("remedy", remedy); }
  std::string text() const { return finding + "\n" + remedy + "\n" + advice; }
};

// Returns the verdict on what is not a line as a receiver sends it; nothing for a line.
std::optional<Verdict> verdictOnSource(const SourceOption &source,
                                       const std::vector<std::unique_ptr<SettingTrial>> &heard) {
  if (std::any_of(heard.begin(), heard.end(), [](const auto &each) { return each->isCsv(); })) {
    return Verdict{false, "Rows of CSV: a sketch prints them; this is not S.Bus.",
                   "sbus monitor shows them: at 115200 baud with --rows. For S.Bus name the receiver's port."};
  }
  const bool isChanged = source.isFile() && !source.file().damage.empty();
  return isChanged ? std::optional(Verdict{false, source.file().damage, source.file().damageRemedy}) : std::nullopt;
}

// Returns the verdict on S.Bus that was read at another baud rate; nothing for any other line.
std::optional<Verdict> verdictOnBaud(sbus::Finding finding, const std::vector<std::unique_ptr<SettingTrial>> &heard) {
  const auto found = std::find_if(heard.begin(), heard.end(), [](const auto &each) { return each->readAtBaud() != 0; });
  if (found == heard.end() || (finding != sbus::Finding::NoFrames && finding != sbus::Finding::WrongPackets)) {
    return std::nullopt;
  }
  return Verdict{false, line::ReadAtBaud::finding((*found)->readAtBaud()), line::ReadAtBaud::Remedy};
}

Verdict verdictOnLine(sbus::Finding finding, const SettingTrial &best, const std::string &advice) {
  const bool well = line::isWell(finding);
  const bool areOthers = finding == sbus::Finding::NoFrames || finding == sbus::Finding::WrongPackets;
  const std::string part = well || areOthers ? best.framesInPart() : "";
  if (!part.empty()) {
    return {false, part, "What changed then: the sender, its settings, the wire? sbus summary lists the times."};
  }
  if (well && best.isInterrupted()) {
    return {false, "Interruptions: frames come, but the line is idle now and then.",
            "Check plugs, wires and supply. A receiver set to no pulses is silent without its radio. sbus summary "
            "lists the times."};
  }
  if (well && best.rejectsTelemetry()) {
    return {false, "Telemetry rejected: the frames are good, but the bytes after them are not just slots.",
            "Disconnect the sensors one by one: do two share a slot, or does one answer too late?"};
  }
  if (well && best.jumps() > 0) {
    return {false, "Jumps: the frames are good, but now and then a channel leaves its course for one of them.",
            "The sender makes them: sbus summary lists channels and times, sbus watch --when jump records them."};
  }
  return {well, std::string(text(finding)), remedyAtPc(finding), advice};
}

// Prints the verdict. Returns true if the line is fine.
bool printVerdict(const SourceOption &source, const std::vector<std::unique_ptr<SettingTrial>> &heard,
                  const std::vector<line::LineSettings> &settings, bool asJson) {
  if (const std::optional<Verdict> other = verdictOnSource(source, heard)) {
    write(asJson ? other->json().line() : other->text());
    return false;
  }
  sbus::Diagnosis diagnosis;
  for (const std::unique_ptr<SettingTrial> &each : heard) {
    diagnosis.add(each->trial());
  }
  const bool hasParity = settings[diagnosis.best()].format.parity != line::Parity::None;
  const sbus::Finding finding =
      line::isWell(diagnosis.finding()) && !hasParity ? sbus::Finding::NoParity : diagnosis.finding();
  const SettingTrial &best = *heard[diagnosis.best()];
  const bool areWrong = finding == sbus::Finding::WrongPackets || finding == sbus::Finding::UnusedFlags;
  const auto shaped =
      std::find_if(heard.begin(), heard.end(), [&](const auto &each) { return each->trial().other == finding; });
  const std::optional<Verdict> onBaud = verdictOnBaud(finding, heard);
  const Verdict verdict =
      onBaud ? *onBaud
             : verdictOnLine(finding, best,
                             advice(finding, source, settings.front(), settings[diagnosis.best()], best.periodMs()));
  write(asJson ? verdict.json().text("line", best.variant()).line()
               : verdict.text() + (areWrong && !onBaud ? (*shaped)->packets() : "") + best.figures(source.hasTimes()) +
                     best.telemetry() + best.note());
  return verdict.well;
}

bool examine(const SourceOption &source, bool asJson) {
  const std::vector<line::LineSettings> settings = settingsOf(source);
  std::vector<line::LineSettings> tried;
  std::vector<std::unique_ptr<SettingTrial>> heard;
  for (const line::LineSettings &each : settings) {
    std::unique_ptr<Input> input;
    try {
      input = source.open(each);
    } catch (const std::runtime_error &error) {
      if (heard.empty()) {
        throw;
      }
      write(asJson ? Json("error").text("message", error.what()).line()
                   : std::string(error.what()) + "\n");  // this adapter does not support the setting
      continue;
    }
    const bool rows = each == line::csvSettings();
    const uint64_t us = source.isFile()     ? SettingTrial::ToItsEnd
                        : source.isStream() ? FramesUs
                        : rows              ? RowsUs
                                            : TrialUs;
    tried.push_back(each);
    heard.push_back(std::make_unique<SettingTrial>(each));
    heard.back()->listen(*input, us, source.isFile() ? SettingTrial::ToItsEnd : heard.size() == 1 ? FramesUs : TrialUs);
    write(asJson ? heard.back()->json(source.hasTimes()).line() : heard.back()->text());
    flush();
    if (stopped()) {
      return false;
    }
    if (heard.back()->isCsv() || (heard.size() == 1 && heard.back()->hasFrames())) {
      break;
    }
  }
  const bool well = printVerdict(source, heard, tried, asJson);
  flush();
  return well;
}

}  // namespace

void addDoctor(CLI::App &app) {
  Subcommand subcommand(app, "doctor", "finds what is wrong with a line, and the remedy, in two seconds");
  const auto source = std::make_shared<SourceOption>(subcommand, Playback::Repeatable);
  subcommand.footer(
      "It tries both baud rates; for sim and a recording also both polarities. Exit status: 0 if all is well, 1 if "
      "not.");
  const auto json = std::make_shared<bool>(false);
  subcommand.flag("--json", *json, "JSON lines: each setting that was tried, then the verdict");
  subcommand.run([source, json] {
    if (!examine(*source, *json)) {
      fail();
    }
  });
}

}  // namespace tool
