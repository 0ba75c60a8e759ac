// sbus doctor: what is wrong with a line, and the cure, as examples/Diagnose finds it: every setting is tried.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "VariantOfLine.h"
#include "Output.h"
#include "SourceOption.h"
#include "Stop.h"
#include "Subcommands.h"
#include "line/CsvRows.h"
#include "line/Observer.h"
#include "sbus/Diagnosis.h"

namespace tool {

namespace {

// All settings together take less than two seconds.
constexpr uint64_t TrialUs = 450000;    // 11 frames of the slowest receiver known (25 Hz)
constexpr uint64_t RowsUs = 700000;     // three rows, 200 ms each
constexpr uint64_t FramesUs = 1500000;  // of a setting that is right from the beginning: more to judge by
constexpr uint64_t SilenceUs = 100000;  // no time from one frame to the next
constexpr uint64_t ToItsEnd = UINT64_MAX;

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
        [this](const line::Character &character) {
          _firstUs = _observer.characters() == 0 ? character.endUs : _firstUs;
          _lastUs = character.endUs;
          _isLate = _isLate || character.lateUs > 0;
          _observer.put(character);
          _isCsv = (_rows.put(character) && _rows.recognised()) || _isCsv;
        },
        [&](uint64_t nowUs) {
          _observer.idleUntil(input.knownUs());
          _heardUs = us == ToItsEnd ? _lastUs - _firstUs + pauseUs() : nowUs;
          if (nowUs >= (framesCome() ? framesUs : us)) {
            input.end();
          }
        });
    _observer.finish();
    _note = input.note();
  }

  // What keeps the times of this source from being exact, a line; or nothing.
  std::string note() const { return _note.empty() ? "" : _note + "\n"; }

  bool isCsv() const { return _isCsv; }

  bool framesCome() const { return uint64_t{counters().frames} * sbus::Diagnosis::PeriodMax > ms(); }

  sbus::Trial trial() const {
    return {_settings.baud, _settings.polarity != line::Polarity::Uninverted, ms(), _observer.counters16()};
  }

  // "100000 baud, 8E2, inverted: 55 frames, 0 bytes of no frame"
  std::string text() const {
    const std::string bad = std::to_string(_observer.badCharacters());
    return line::text(_settings) + ": " +
           (_isCsv ? "rows of CSV"
                   : std::to_string(counters().frames) + " frames" + (_observer.has24() ? " of 24 channels" : "") +
                         ", " + std::to_string(counters().discardedBytes) +
                         (counters().discardedBytes == 1 ? " byte of no frame" : " bytes of no frame")) +
           (_observer.badCharacters() > 0 ? ", " + bad + (bad == "1" ? " bad character" : " bad characters") : "") +
           "\n";
  }

  // "S.BUS: 111 frames a second and 0 damaged, 9000 us from one to the next; 1 % with the lost-frame flag"
  std::string figures() const {
    const sbus::Counters &seen = counters();
    if (seen.frames == 0) {
      return {};
    }
    const auto aSecond = [this](uint64_t count) { return std::to_string((count * 1000 + ms() / 2) / ms()); };
    return _kind.text() + ": " + aSecond(seen.frames) + " frames a second and " + aSecond(sbus::impairedFrames(seen)) +
           " damaged, " + std::to_string(usualPeriodUs()) + " us from one to the next; " +
           std::to_string(uint64_t{seen.lostFrames} * 100 / seen.frames) + " % with the lost-frame flag\n";
  }

 private:
  void take(const line::Stretch &stretch) {
    _kind.take(stretch);
    if (stretch.isFrame() && stretch.kind != line::Stretch::Kind::Extra) {
      _ends.push_back(stretch.endUs());
    }
  }

  // The median, since a line may have been silent for hours; the mean where a port's lumps leave no period as it was.
  uint64_t usualPeriodUs() const {
    std::vector<uint64_t> periods(_ends.size());
    std::adjacent_difference(_ends.begin(), _ends.end(), periods.begin());
    if (periods.size() < 2) {
      return 0;
    }
    if (_isLate) {
      const auto isPeriod = [](uint64_t us) { return us < SilenceUs; };
      const auto silence = std::partition(periods.begin() + 1, periods.end(), isPeriod);
      const auto count = std::max<std::ptrdiff_t>(1, silence - periods.begin() - 1);
      return std::accumulate(periods.begin() + 1, silence, uint64_t{0}) / static_cast<uint64_t>(count);
    }
    const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
    std::nth_element(periods.begin() + 1, middle, periods.end());
    return *middle;
  }

  const sbus::Counters &counters() const { return _observer.counters(); }
  // A recording ends with a frame, not with the pause that belongs to it.
  uint64_t pauseUs() const {
    const uint64_t frameUs = uint64_t{sbus::FrameSize} * _settings.characterUs();
    return std::max(_observer.gaps().low, frameUs) - frameUs;
  }
  uint32_t ms() const { return std::max<uint32_t>(1, static_cast<uint32_t>(_heardUs / 1000)); }

  const line::LineSettings _settings;
  line::Observer _observer;
  VariantOfLine _kind;
  std::vector<uint64_t> _ends;  // of the frames, in us
  line::CsvRows _rows;
  bool _isCsv = false;
  uint64_t _firstUs = 0;  // of the characters
  uint64_t _lastUs = 0;
  uint64_t _heardUs = 0;
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
  if (source.isStream()) {
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
    other.polarity = line::Polarity::Uninverted;
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

// True if all is well.
bool tell(const SourceOption &source, const std::vector<std::unique_ptr<Heard>> &heard,
          const std::vector<line::LineSettings> &settings) {
  if (std::any_of(heard.begin(), heard.end(), [](const auto &each) { return each->isCsv(); })) {
    write(
        "ROWS OF CSV: they come from a sketch; this is no S.Bus.\n"
        "sbus monitor shows them: at 115200 baud with --csv. For S.Bus name the receiver's port.\n");
    return false;
  }
  sbus::Diagnosis diagnosis;
  for (const std::unique_ptr<Heard> &each : heard) {
    diagnosis.add(each->trial());
  }
  const sbus::Finding finding = diagnosis.finding();
  write(std::string(text(finding)) + "\n" + cure(finding) + "\n" +
        advice(finding, source, settings.front(), settings[diagnosis.best()]) + heard[diagnosis.best()]->figures() + heard[diagnosis.best()]->note());
  return finding == sbus::Finding::AllWell || finding == sbus::Finding::AllWellAndMore;
}

bool examine(const SourceOption &source) {
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
      write(std::string(error.what()) + "\n");  // this adapter cannot do all of them
      continue;
    }
    const bool rows = each == line::csvSettings();
    const uint64_t us = source.isFile() ? ToItsEnd : source.isStream() ? FramesUs : rows ? RowsUs : TrialUs;
    tried.push_back(each);
    heard.push_back(std::make_unique<Heard>(each));
    heard.back()->listen(*input, us, source.isFile() ? ToItsEnd : heard.size() == 1 ? FramesUs : TrialUs);
    write(heard.back()->text());
    flush();
    if (stopped()) {
      return false;
    }
    if (heard.back()->isCsv() || (heard.size() == 1 && heard.back()->framesCome())) {
      break;
    }
  }
  const bool well = tell(source, heard, tried);
  flush();
  return well;
}

}  // namespace

void addDoctor(CLI::App &app) {
  CLI::App *const subcommand = app.add_subcommand("doctor", "what is wrong with a line, and the cure, in two seconds");
  const auto source = std::make_shared<SourceOption>(*subcommand, Recordings::AtOnce);
  subcommand->footer(
      "It tries both baud rates; of sim and of a recording both polarities, too. Exit status: 0 if all is well, "
      "1 if not.");
  subcommand->callback([source] {
    if (!examine(*source)) {
      throw CLI::RuntimeError(EXIT_FAILURE);
    }
  });
}

}  // namespace tool
