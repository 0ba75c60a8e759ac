// sbus plot: the curves of the channels, as a picture.

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "cli/Output.h"
#include "cli/SilenceNote.h"
#include "cli/SvgPlot.h"
#include "cli/options/CsvColumn.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/recording/CsvRows.h"
#include "line/recording/RecordingFile.h"

namespace tool {

namespace {

struct PlotOptions {
  std::string columns = "ch1-ch4";
  std::string output;
};

// Takes a line, of S.Bus or of a sketch's rows, and draws it.
class Plotter {
 public:
  // Without `hasTimes` the numbers of frames stand for the time. `rowsHaveTimes`: a sketch's rows come when they were
  // printed; otherwise their numbers do.
  Plotter(const PlotOptions &options, uint32_t characterUs, bool hasTimes, bool rowsHaveTimes)
      : _columns(parseColumns(options.columns)), _hasTimes(hasTimes), _rowsHaveTimes(rowsHaveTimes) {
    for (const CsvColumn &column : _columns) {
      if (column.kind != CsvColumn::Kind::Channel) {
        rejectCommandLine("--columns: channels are expected, such as ch1-ch4: flags are shaded by themselves");
      }
    }
    _observer.reset(0, characterUs);
    _observer.listen([this](const line::Stretch &stretch) { takeFrame(stretch); });
  }

  void put(const line::Character &character) {
    const bool complete = _rows.put(character);
    if (complete && _rows.recognised() && _rows.isRow()) {
      takeRow(character.endUs);
    }
    if (!_rows.recognised()) {
      _observer.put(character);
    }
  }

  void idleUntil(uint64_t nowUs) { _observer.idleUntil(nowUs); }

  // Returns true if there is something to draw.
  bool any() const { return _flags.lastUs() != 0; }

  std::string finish(const std::string &name) {
    _observer.finish();
    if (!any()) {
      throw std::runtime_error(name + ": there is nothing to draw: no frames came; sbus doctor says why");
    }
    _flags.finish();
    for (const FlagSpan &span : _flags.all()) {
      _picture.spans.push_back({span.kind, ms(span.fromUs), ms(span.toUs)});
    }
    const double end = ms(_flags.lastUs());
    _picture.title = name == "-" ? "standard input" : name.substr(name.rfind('/') + 1);
    _picture.yTitle = "raw";
    const double margin = _flags.lastUs() > _flags.firstUs() ? 0 : 0.5;  // a single frame is in the middle
    _picture.xBegin = std::max(0.0, ms(_flags.firstUs()) - margin);
    _picture.xEnd = end + margin;
    if (_rows.recognised() ? !_rowsHaveTimes : !_hasTimes) {
      _picture.xTitle = _rows.recognised() ? "rows" : "frames";
    } else {
      chooseUnit(end);
    }
    return svg(_picture);
  }

 private:
  static double ms(uint64_t us) { return static_cast<double>(us) / 1000; }

  // Chooses the unit of an axis that ends at `endMs`.
  void chooseUnit(double endMs) {
    const double perMs = endMs < 10 ? 1000 : endMs < 1000 ? 1 : 0.001;
    _picture.xTitle = endMs < 10 ? "us" : endMs < 1000 ? "ms" : "s";
    for (Curve &curve : _picture.curves) {
      for (Curve::Point &point : curve.points) {
        point.x *= perMs;
      }
    }
    for (ShadedTime &span : _picture.spans) {
      span.from *= perMs;
      span.to *= perMs;
    }
    _picture.xBegin *= perMs;
    _picture.xEnd *= perMs;
  }

  void takeFrame(const line::Stretch &stretch) {
    if (!stretch.isFrame() || stretch.kind == line::Stretch::Kind::Extra) {
      return;
    }
    const line::Values &values = _observer.newest();
    _beganUs = _beganUs == 0 ? stretch.endUs() : _beganUs;
    if (!haveCome(_columns, values, stretch.endUs() - _beganUs)) {
      return;
    }
    _picture.curves.resize(_columns.size());
    const uint64_t us = _hasTimes ? stretch.endUs() : _flags.lastUs() + 1000;
    const bool joined = any() && !_flags.brokenUntil(us, stretch.lateUs());
    for (size_t i = 0; i < _columns.size(); i++) {
      const unsigned channel = _columns[i].channel;
      const bool isSwitch = values.count == 16 && channel > 16;
      const double value = isSwitch ? values.switches[channel - 17] : values.raw[channel - 1];
      _picture.curves[i].name = "CH" + std::to_string(channel);
      _picture.curves[i].points.push_back({ms(us), value, joined});
    }
    _flags.put(us, _observer.inFailsafe(), values.lostFrame);
  }

  void takeRow(uint64_t nowUs) {
    const line::CsvRow &row = _rows.row();
    const uint64_t us = _rowsHaveTimes ? nowUs : _flags.lastUs() + 1000;
    const bool joined = any();
    bool failsafe = false;
    bool lostFrame = false;
    size_t curve = 0;
    for (size_t i = 0; i < row.size(); i++) {
      const line::CsvKind kind = _rows.kind(i);
      if (kind == line::CsvKind::Failsafe || kind == line::CsvKind::LostFrame) {
        (kind == line::CsvKind::Failsafe ? failsafe : lostFrame) = row[i].value != 0;
        continue;
      }
      _picture.curves.resize(std::max(_picture.curves.size(), curve + 1));
      _picture.curves[curve].name = row[i].name.empty() ? "CH" + std::to_string(i + 1) : row[i].name;
      _picture.curves[curve++].points.push_back({ms(us), row[i].value, joined});
    }
    _flags.put(us, failsafe, lostFrame);
  }

  const std::vector<CsvColumn> _columns;
  const bool _hasTimes;
  const bool _rowsHaveTimes;
  line::Observer _observer;
  line::CsvRows _rows;
  Picture _picture;
  FlagSpans _flags;       // of what is drawn
  uint64_t _beganUs = 0;  // of the first frame
};

void run(const SourceOption &source, const PlotOptions &options) {
  rejectSameFile(source.name(), options.output);
  line::requireNew(options.output);  // before the flight, not after it
  const std::unique_ptr<Input> input = source.open();
  Plotter plotter(options, input->settings().characterUs(), source.hasTimes(), !source.isStream());
  SilenceNote silence(source.name(), "frames");
  input->run([&](const line::Character &character) { plotter.put(character); },
             [&](uint64_t nowUs) {
               plotter.idleUntil(input->knownUs());
               silence.tick(nowUs, plotter.any());
             });
  const std::string picture = plotter.finish(source.name());
  writeTo(options.output, File::New, [&picture](const Put &put) { put(picture); });
}

}  // namespace

void addPlot(CLI::App &app) {
  Subcommand subcommand(app, "plot", "the curves of the channels as a picture, SVG");
  const auto source = std::make_shared<SourceOption>(subcommand, Recordings::AtOnce);
  const auto options = std::make_shared<PlotOptions>();
  subcommand.option("--columns", options->columns, "ch1 to ch32 and spans; of a sketch's rows all are drawn (ch1-ch4)")
      .type("LIST");
  subcommand.option("-o,--output", options->output, "a file, not overwritten if it exists (standard output)")
      .type("FILE.svg");
  subcommand.footer(
      "It is drawn when the source ends, after --seconds, or after Ctrl-C. Failsafe, lost frames, times without "
      "frames and times when the PC was late are shaded.");
  subcommand.run([source, options] { run(*source, *options); });
}

}  // namespace tool
