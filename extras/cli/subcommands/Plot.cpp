// sbus plot: the curves of the channels, as a picture.

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "cli/options/CsvColumn.h"
#include "cli/options/LineOptions.h"
#include "cli/Output.h"
#include "cli/SilenceNote.h"
#include "cli/options/SourceOption.h"
#include "cli/SvgPlot.h"
#include "cli/subcommands/Subcommands.h"
#include "line/recording/CsvRows.h"

namespace tool {

namespace {

struct PlotOptions {
  std::string columns = "ch1-ch4";
  std::string output;
};

constexpr uint64_t SilenceUs = sbus::Link::DefaultTimeout * 1000;

// What is shaded while it is so, of one kind.
class Shade {
 public:
  explicit Shade(ShadedTime::Kind kind) : _kind(kind) {}

  void at(double ms, bool is, std::vector<ShadedTime> &spans) {
    if (is && !_is) {
      _from = ms;
    } else if (!is && _is) {
      spans.push_back({_kind, _from, ms});
    }
    _is = is;
  }

 private:
  ShadedTime::Kind _kind;
  bool _is = false;
  double _from = 0;
};

// Takes a line, of S.Bus or of a sketch's rows, and draws it.
class Plotter {
 public:
  // `rowsHaveTimes`: a sketch's rows come when they were printed; else their numbers stand for the time.
  Plotter(const PlotOptions &options, uint32_t characterUs, bool rowsHaveTimes)
      : _columns(parseColumns(options.columns)), _rowsHaveTimes(rowsHaveTimes) {
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

  // There is something to be drawn.
  bool any() const { return _lastUs != 0; }

  std::string finish(const std::string &name) {
    _observer.finish();
    if (!any()) {
      throw std::runtime_error(name + ": there is nothing to be drawn: no frames came; sbus doctor says why");
    }
    const double end = ms(_lastUs);
    _failsafe.at(end, false, _picture.spans);
    _lost.at(end, false, _picture.spans);
    _picture.title = name == "-" ? "standard input" : name.substr(name.rfind('/') + 1);
    _picture.yTitle = "raw";
    const double margin = _lastUs > _firstUs ? 0 : 0.5;  // of a single frame: its time is in the middle
    _picture.xBegin = std::max(0.0, ms(_firstUs) - margin);
    _picture.xEnd = end + margin;
    if (_rows.recognised() && !_rowsHaveTimes) {
      _picture.xTitle = "rows";
    } else {
      chooseUnit(end);
    }
    return svg(_picture);
  }

 private:
  static double ms(uint64_t us) { return static_cast<double>(us) / 1000; }

  // Of an axis that ends there.
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
    const bool joined = begin(stretch.endUs());
    for (size_t i = 0; i < _columns.size(); i++) {
      const unsigned channel = _columns[i].channel;
      const bool isSwitch = values.count == 16 && channel > 16;
      const double value = isSwitch ? values.switches[channel - 17] : values.raw[channel - 1];
      _picture.curves[i].name = "CH" + std::to_string(channel);
      _picture.curves[i].points.push_back({ms(_lastUs), value, joined});
    }
    shade(values.failsafe, values.lostFrame);
  }

  void takeRow(uint64_t nowUs) {
    const line::CsvRow &row = _rows.row();
    const bool joined = begin(_rowsHaveTimes ? nowUs : _lastUs + 1000);
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
      _picture.curves[curve++].points.push_back({ms(_lastUs), row[i].value, joined});
    }
    shade(failsafe, lostFrame);
  }

  // The next point is at `us`. True if it is joined to the one before.
  bool begin(uint64_t us) {
    const bool silence = _lastUs != 0 && us - _lastUs > SilenceUs && !_rows.recognised();
    if (silence) {
      shade(false, false);
      _picture.spans.push_back({ShadedTime::Kind::NoFrames, ms(_lastUs), ms(us)});
    }
    const bool joined = _lastUs != 0 && !silence;
    _firstUs = _lastUs == 0 ? us : _firstUs;
    _lastUs = us;
    return joined;
  }

  void shade(bool failsafe, bool lostFrame) {
    _failsafe.at(ms(_lastUs), failsafe, _picture.spans);
    _lost.at(ms(_lastUs), lostFrame && !failsafe, _picture.spans);
  }

  const std::vector<CsvColumn> _columns;
  const bool _rowsHaveTimes;
  line::Observer _observer;
  line::CsvRows _rows;
  Picture _picture;
  Shade _failsafe{ShadedTime::Kind::Failsafe};
  Shade _lost{ShadedTime::Kind::LostFrame};
  uint64_t _beganUs = 0;  // of the first frame
  uint64_t _firstUs = 0;  // of what is drawn
  uint64_t _lastUs = 0;
};

void run(const SourceOption &source, const PlotOptions &options) {
  rejectSameFile(source.name(), options.output);
  const std::unique_ptr<Input> input = source.open();
  Plotter plotter(options, input->settings().characterUs(), source.name() != "-");
  SilenceNote silence(source.name(), "frames");
  input->run([&](const line::Character &character) { plotter.put(character); },
             [&](uint64_t nowUs) {
               plotter.idleUntil(input->knownUs());
               silence.tick(nowUs, plotter.any());
             });
  const std::string picture = plotter.finish(source.name());
  writeTo(options.output, File::Any, [&picture](const Put &put) { put(picture); });
}

}  // namespace

void addPlot(CLI::App &app) {
  Subcommand subcommand(app, "plot", "the curves of the channels as a picture, SVG");
  const auto source = std::make_shared<SourceOption>(subcommand, Recordings::AtOnce);
  const auto options = std::make_shared<PlotOptions>();
  subcommand.option("--columns", options->columns, "ch1 to ch32 and spans; of a sketch's rows all are drawn (ch1-ch4)")
      .type("LIST");
  subcommand.option("-o,--output", options->output, "a file (standard output)").type("FILE.svg");
  subcommand.footer(
      "It is drawn when the source ends, after --seconds, or after Ctrl-C. Failsafe, lost frames and times without "
      "frames are shaded.");
  subcommand.run([source, options] { run(*source, *options); });
}

}  // namespace tool
