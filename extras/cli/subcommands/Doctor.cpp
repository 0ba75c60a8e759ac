// sbus doctor: what is wrong with a line, and the remedy, as examples/Diagnose finds it: every setting is tried.

#include <algorithm>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "cli/Format.h"
#include "cli/Json.h"
#include "cli/Output.h"
#include "cli/Stop.h"
#include "cli/VariantOfLine.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Examination.h"
#include "line/Observer.h"
#include "line/recording/CsvRows.h"
#include "line/telemetry/Readings.h"

namespace tool {

namespace {

// All settings together take less than two seconds.
constexpr uint64_t TrialUs = 450000;    // 11 frames of the slowest receiver known (25 Hz)
constexpr uint64_t RowsUs = 700000;     // three rows, 200 ms each
constexpr uint64_t FramesUs = 1500000;  // of a setting that is right from the beginning: more to judge by
constexpr uint64_t SilenceUs = 100000;  // between characters: no frame period is so long
constexpr uint64_t ToItsEnd = UINT64_MAX;

const char *polarityName(line::Polarity polarity) {
  return polarity == line::Polarity::Inverted     ? "inverted"
         : polarity == line::Polarity::Uninverted ? "uninverted"
                                                  : "unknown";
}

// What came with a setting.
class Heard {
 public:
  explicit Heard(const line::LineSettings &settings) : _settings(settings) {
    _observer.reset(0, settings.characterUs());
    _observer.listen([this](const line::Stretch &stretch) { take(stretch); });
  }
  Heard(const Heard &) = delete;  // its observer's listener leads into it
  Heard &operator=(const Heard &) = delete;

  // For so long; if frames come, for as long as `framesUs`.
  void listen(Input &input, uint64_t us, uint64_t framesUs) {
    input.run(
        [this, us](const line::Character &character) {
          if (us == ToItsEnd && _observer.characters() == 0) {
            _examination.begin(_observer, character.endUs);
            _lastUs = character.endUs;
          }
          heard(character.endUs);
          _isLate = _isLate || character.lateUs > 0;
          _observer.put(character);
          _isCsv = (_rows.put(character) && _rows.recognised()) || _isCsv;
        },
        [&](uint64_t nowUs) {
          _observer.idleUntil(input.knownUs());
          _endUs = us == ToItsEnd ? _lastUs + pauseUs() : nowUs;
          if (nowUs >= (framesCome() ? framesUs : us)) {
            input.end();
          }
        });
    _observer.finish();
    if (us != ToItsEnd) {
      heard(std::max(_endUs, _lastUs));
    }
    _note = input.note();
  }

  // What keeps the times of this source from being exact, a line; or nothing.
  std::string note() const { return _note.empty() ? "" : _note + "\n"; }

  bool isCsv() const { return _isCsv; }

  bool framesCome() const { return uint64_t{counters().frames} * sbus::Diagnosis::PeriodMax > ms(); }

  sbus::Trial trial() const { return _examination.trial(_observer, _settings, _endUs); }

  // "100000 baud, 8E2, inverted: 55 frames, 0 bytes of no frame"
  std::string text() const {
    const std::string bad = std::to_string(_observer.badCharacters());
    const unsigned long telemetry = _observer.telemetry().characters();
    const unsigned long discarded = _observer.discardedBytes();
    return line::text(_settings) + ": " +
           (_isCsv ? "rows of CSV"
                   : frames() + (_observer.has24() ? " of 24 channels" : "") + ", " +
                         (telemetry > 0 ? std::to_string(telemetry) + " bytes of telemetry, " : "") +
                         std::to_string(discarded) + (discarded == 1 ? " byte of no frame" : " bytes of no frame")) +
           (_observer.badCharacters() > 0 ? ", " + bad + (bad == "1" ? " bad character" : " bad characters") : "") +
           "\n";
  }

  Json json() const {
    return Json("trial")
        .number("baud", _settings.baud)
        .text("polarity", polarityName(_settings.polarity))
        .number("heard_ms", ms())
        .number("frames", counters().frames)
        .flag("has_24_channels", _observer.has24())
        .number("telemetry_bytes", _observer.telemetry().characters())
        .number("discarded_bytes", _observer.discardedBytes())
        .number("bad_characters", _observer.badCharacters())
        .number("lost_frames", counters().lostFrames)
        .number("failsafe_frames", counters().failsafeFrames)
        .flag("rows_of_csv", _isCsv);
  }

  // "Telemetry: receiver voltage 4.6 V; slots 0, 1", a line; empty without a slot.
  std::string telemetry() const {
    const std::string slots = _readings.slots(0);
    std::string text;
    for (const std::string &quantity : _readings.quantities(0)) {
      text += quantity + "; ";
    }
    return slots.empty() ? "" : "Telemetry: " + text + slots + "\n";
  }

  // "S.BUS", "S.BUS2" ...; empty without frames.
  std::string kind() const { return _kind.text(); }

  // "S.BUS: 111 frames a second and 0 damaged, 9000 us from one to the next; 1 % with the lost-frame flag". All of it
  // by the times of the frames: one frame has no rate.
  std::string figures() const {
    const sbus::Counters &seen = counters();
    if (seen.frames == 0) {
      return {};
    }
    const std::vector<uint64_t> periods = this->periods();
    const uint64_t us = std::accumulate(periods.begin(), periods.end(), uint64_t{0});
    const auto aSecond = [us](uint64_t count) { return std::to_string((count * 1000000 + us / 2) / us); };
    const std::string rate = us == 0 ? frames() + ", too few for a rate"
                                     : aSecond(periods.size()) + " frames a second and " +
                                           aSecond(sbus::impairedFrames(seen)) + " damaged, " +
                                           std::to_string(usualPeriodUs(periods, us)) + " us from one to the next";
    return _kind.text() + ": " + rate + "; " + std::to_string(uint64_t{seen.lostFrames} * 100 / seen.frames) +
           " % with the lost-frame flag" +
           (_silentUs == 0 ? "" : format("; silent for %.2f s", static_cast<double>(_silentUs) / 1e6)) + "\n";
  }

 private:
  void take(const line::Stretch &stretch) {
    _kind.take(stretch);
    _readings.put(_observer.telemetry().proved());
    if (stretch.isFrame() && stretch.kind != line::Stretch::Kind::Extra) {
      _ends.push_back(stretch.endUs());
    }
  }

  // No character came between the last one and this time, or the one that is complete then.
  void heard(uint64_t us) {
    if (us >= _lastUs + SilenceUs) {
      _silences.push_back(_lastUs);
      _silentUs += us - _lastUs;
    }
    _lastUs = us;
  }

  // Returns the times from frame to frame in which the line was not silent: it may have been so for hours.
  std::vector<uint64_t> periods() const {
    std::vector<uint64_t> periods;
    for (size_t i = 1; i < _ends.size(); i++) {
      const auto silence = std::lower_bound(_silences.begin(), _silences.end(), _ends[i - 1]);
      if (silence == _silences.end() || *silence >= _ends[i]) {
        periods.push_back(_ends[i] - _ends[i - 1]);
      }
    }
    return periods;
  }

  // The median, which an impaired frame does not move; the mean where a port's lumps leave no period as it was.
  uint64_t usualPeriodUs(std::vector<uint64_t> periods, uint64_t us) const {
    const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
    std::nth_element(periods.begin(), middle, periods.end());
    return _isLate ? us / periods.size() : *middle;
  }

  std::string frames() const {
    return std::to_string(counters().frames) + (counters().frames == 1 ? " frame" : " frames");
  }

  sbus::Counters counters() const { return _observer.counters(); }
  // A recording ends with a frame, not with the silence that belongs to it.
  uint64_t pauseUs() const {
    const uint64_t frameUs = uint64_t{sbus::FrameSize} * _settings.characterUs();
    return std::max(_observer.gaps().low, frameUs) - frameUs;
  }
  uint32_t ms() const { return trial().ms; }

  const line::LineSettings _settings;
  line::Observer _observer;
  line::Examination _examination;
  VariantOfLine _kind;
  line::Readings _readings;
  std::vector<uint64_t> _ends;      // of the frames, in us
  std::vector<uint64_t> _silences;  // where they begin, in us
  uint64_t _silentUs = 0;
  line::CsvRows _rows;
  bool _isCsv = false;
  uint64_t _lastUs = 0;  // of the characters
  uint64_t _endUs = 0;   // of what was heard
  bool _isLate = false;
  std::string _note;
};

// The one that is meant first: of sim what a sketch's begin() opens, of a recording how its line was set. What inverts
// a serial port is its adapter, and the bytes of a stream have come already.
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
    return all;
  }
  for (const size_t i : {size_t{0}, size_t{1}}) {
    line::LineSettings other = all[i];
    other.polarity = other.idleHigh() ? line::Polarity::Inverted : line::Polarity::Uninverted;
    all.push_back(other);
  }
  return all;
}

// What else there is to say to somebody at a PC; mostly nothing.
std::string advice(sbus::Finding finding, const SourceOption &source, const line::LineSettings &meant,
                   const line::LineSettings &best) {
  switch (finding) {
    case sbus::Finding::NoFrames:
      return source.isWire() ? "" : "An FTDI adapter inverts RXD if its EEPROM says so: extras/docs/ftdi.md\n";
    case sbus::Finding::WrongBaud:
      return "Here: --baud " + std::to_string(best.baud) + "\n";
    case sbus::Finding::Channels24:
      return std::string("Here: sbus shows all 24") +
             (best.baud != meant.baud ? ", with --baud " + std::to_string(best.baud) : "") +
             (best.polarity != meant.polarity ? ", once the line has the other inversion" : "") + ".\n";
    default:
      return {};
  }
}

Json verdict(bool well, const std::string &finding, const std::string &remedy) {
  return Json("verdict").flag("well", well).text("finding", finding).text("remedy", remedy);
}

// True if all is well.
bool tell(const SourceOption &source, const std::vector<std::unique_ptr<Heard>> &heard,
          const std::vector<line::LineSettings> &settings, bool asJson) {
  if (std::any_of(heard.begin(), heard.end(), [](const auto &each) { return each->isCsv(); })) {
    const std::string finding = "Rows of CSV: they come from a sketch; this is no S.Bus.";
    const std::string remedy =
        "sbus monitor shows them: at 115200 baud with --csv. For S.Bus name the receiver's port.";
    write(asJson ? verdict(false, finding, remedy).line() : finding + "\n" + remedy + "\n");
    return false;
  }
  sbus::Diagnosis diagnosis;
  for (const std::unique_ptr<Heard> &each : heard) {
    diagnosis.add(each->trial());
  }
  const sbus::Finding finding = diagnosis.finding();
  const Heard &best = *heard[diagnosis.best()];
  const bool well = line::isWell(finding);
  if (asJson) {
    write(verdict(well, text(finding), remedy(finding)).text("line", best.kind()).line());
    return well;
  }
  write(std::string(text(finding)) + "\n" + remedy(finding) + "\n" +
        advice(finding, source, settings.front(), settings[diagnosis.best()]) +
        (source.hasTimes() ? best.figures() : "") + best.telemetry() + best.note());
  return well;
}

bool examine(const SourceOption &source, bool asJson) {
  const std::vector<line::LineSettings> settings = settingsOf(source);
  std::vector<line::LineSettings> tried;
  std::vector<std::unique_ptr<Heard>> heard;
  for (const line::LineSettings &each : settings) {
    std::unique_ptr<Input> input;
    try {
      input = source.open(each);
    } catch (const std::runtime_error &error) {
      if (heard.empty()) {
        throw;
      }
      write(asJson ? Json("error").text("message", error.what()).line()
                   : std::string(error.what()) + "\n");  // this adapter cannot do all of them
      continue;
    }
    const bool rows = each == line::csvSettings();
    const uint64_t us = source.isFile() ? ToItsEnd : source.isStream() ? FramesUs : rows ? RowsUs : TrialUs;
    tried.push_back(each);
    heard.push_back(std::make_unique<Heard>(each));
    heard.back()->listen(*input, us, source.isFile() ? ToItsEnd : heard.size() == 1 ? FramesUs : TrialUs);
    write(asJson ? heard.back()->json().line() : heard.back()->text());
    flush();
    if (stopped()) {
      return false;
    }
    if (heard.back()->isCsv() || (heard.size() == 1 && heard.back()->framesCome())) {
      break;
    }
  }
  const bool well = tell(source, heard, tried, asJson);
  flush();
  return well;
}

}  // namespace

void addDoctor(CLI::App &app) {
  Subcommand subcommand(app, "doctor", "what is wrong with a line, and the remedy, in two seconds");
  const auto source = std::make_shared<SourceOption>(subcommand, Recordings::AtOnce);
  subcommand.footer(
      "It tries both baud rates; of sim and of a recording also both polarities. Exit status: 0 if all is well, "
      "1 if not.");
  const auto json = std::make_shared<bool>(false);
  subcommand.flag("--json", *json, "JSON lines: each setting that was tried, then the verdict");
  subcommand.run([source, json] {
    if (!examine(*source, *json)) {
      fail();
    }
  });
}

}  // namespace tool
