// sbus csv: prints the same rows as the sketch examples/DecodeSBus, for the same viewers.

#include <memory>
#include <stdexcept>

#include "cli/Output.h"
#include "cli/SilenceNote.h"
#include "cli/options/CsvColumn.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/recording/CsvRows.h"

namespace tool {

namespace {

struct CsvOptions {
  std::string columns = "ch1-ch4,failsafe,lostframe";
  double rate = 5;  // rows per second, like the sketch's PERIOD_DISPLAY
  Option everyFrame;
  Option header;
};

class CsvView {
 public:
  CsvView(const CsvOptions &options, const SourceOption &source, uint32_t characterUs)
      : _source(source.name()),
        _hasTimes(source.hasTimes()),
        _zeroUs(source.zeroUs()),
        _columns(parseColumns(options.columns)),
        _everyFrame(options.everyFrame.given()),
        _periodUs(static_cast<uint64_t>(1e6 / options.rate)),
        _nextUs(_periodUs),
        _silence(_source, "frames", source.isFile()) {
    _observer.reset(0, characterUs);
    _observer.listen([this](const line::Stretch &stretch) { take(stretch); });
    if (options.header.given()) {
      write(header(_columns));
    }
  }

  void put(const line::Character &character) {
    _rows.put(character);
    if (_rows.recognised()) {
      throw std::runtime_error(_source +
                               ": these are rows of CSV already; sbus monitor shows them, sbus record keeps them");
    }
    _observer.put(character);
  }

  void tick(uint64_t nowUs, uint64_t knownUs) {
    _observer.idleUntil(knownUs);
    _silence.tick(nowUs, hasFrames());
    if (nowUs < _nextUs) {
      return;
    }
    _nextUs += _periodUs * (1 + (nowUs - _nextUs) / _periodUs);
    if (!_everyFrame && isYoung(_observer.state(nowUs))) {
      print(nowUs);
    }
  }

  // A line that ended before its first row was due still gets one row.
  void finish() {
    _observer.finish();
    if (_firstUs == 0 && hasFrames()) {
      print(_observer.newest().endUs);
    }
    if (!_anyRow && hasFrames()) {
      haveAllArrived(_columns, _observer.newest(), UINT64_MAX);  // throws: a channel is missing
    }
    flush();
    _silence.end(hasFrames());
  }

 private:
  bool hasFrames() const { return _observer.counters().frames > 0; }

  static bool isYoung(sbus::LinkState state) {
    return state != sbus::LinkState::NeverSeen && state != sbus::LinkState::Stale;
  }

  void take(const line::Stretch &stretch) {
    if (_everyFrame && stretch.isFrame() && stretch.kind != line::Stretch::Kind::Extra) {
      print(stretch.endUs());
    }
  }

  // Prints no row until all of its channels have been received.
  void print(uint64_t nowUs) {
    _firstUs = _firstUs == 0 ? nowUs : _firstUs;
    if (haveAllArrived(_columns, _observer.newest(), nowUs - _firstUs)) {
      write(row(_columns, _observer, nowUs, _hasTimes, _zeroUs));
      _anyRow = true;
    }
  }

  const std::string _source;
  const bool _hasTimes;
  const int64_t _zeroUs;
  const std::vector<CsvColumn> _columns;
  const bool _everyFrame;
  const uint64_t _periodUs;
  uint64_t _nextUs;
  uint64_t _firstUs = 0;  // the first row's time
  bool _anyRow = false;
  line::Observer _observer;
  line::CsvRows _rows;
  SilenceNote _silence;
};

void run(const SourceOption &source, const CsvOptions &options) {
  const std::unique_ptr<Input> input = source.open();
  CsvView view(options, source, input->settings().characterUs());
  input->run([&view](const line::Character &character) { view.put(character); },
             [&](uint64_t nowUs) { view.tick(nowUs, input->knownUs()); });
  view.finish();
}

}  // namespace

void addCsv(CLI::App &app) {
  Subcommand subcommand(app, "csv", "prints what the sketch prints, for a serial plotter or a spreadsheet");
  const auto source = std::make_shared<SourceOption>(subcommand, Playback::AtOnce);
  const auto options = std::make_shared<CsvOptions>();
  subcommand
      .option("--columns", options->columns,
              "ch1 to ch32, spans, failsafe, lostframe, time, state, age, quality (ch1-ch4,failsafe,lostframe)")
      .type("LIST");
  subcommand.option("--rate", options->rate, "rows a second (5)").between(0.01, 1000).type("N");
  options->everyFrame = subcommand.flag("--every-frame", "print a row for each frame, whatever the rate");
  options->header = subcommand.flag("--header", "print the column names in the first row");
  subcommand.footer(
      "Like the sketch, it prints nothing before the first frame, and nothing once the newest is 0.1 s old.");
  subcommand.run([source, options] { run(*source, *options); });
}

}  // namespace tool
