// sbus record: keeps a line as a recording, or a sketch's rows as CSV.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <vector>

#include "Output.h"
#include "SilenceNote.h"
#include "SourceOption.h"
#include "Subcommands.h"
#include "line/CsvRows.h"
#include "line/Observer.h"
#include "line/RecordingWriter.h"

namespace tool {

namespace {

// What comes is kept until it is clear whether it is S.Bus or a sketch's rows.
class Recorder {
 public:
  Recorder(const std::string &source, const line::LineSettings &settings, const Put &write)
      : _source(source), _settings(settings), _write(write) {
    _observer.reset(0, settings.characterUs());
  }

  void put(const line::Character &character) {
    _observer.put(character);
    const bool line = _rows.put(character);
    if (_kind == Kind::Rows) {
      writeRow(line);
    } else if (_kind == Kind::SBus) {
      _writer.put(character);
    } else {
      _first.push_back(character);
      decide(character);
    }
    flush();
  }

  // After the last character.
  void finish() {
    if (_kind == Kind::Unknown && !_first.empty()) {
      begin(Kind::SBus);
    }
    _writer.finish();
    flush();
  }

  // Frames or rows have come.
  bool knows() const { return _kind == Kind::Rows || _observer.counters().frames > 0; }

  std::string summary() {
    if (_kind == Kind::Rows) {
      return std::to_string(_rowCount) + " rows of CSV";
    }
    _observer.finish();
    const sbus::Counters &counters = _observer.counters();
    return std::to_string(_observer.characters()) + " characters (" + std::to_string(_observer.badCharacters()) +
           " bad), " + std::to_string(counters.frames) + " frames" + (_observer.has24() ? " of 24 channels" : "");
  }

 private:
  enum class Kind { Unknown, SBus, Rows };

  static constexpr size_t TextMax = 4096;  // bytes of a text whose rows are none

  void decide(const line::Character &character) {
    const bool text = !character.bad && (character.value == '\r' || character.value == '\n' ||
                                         (character.value >= ' ' && character.value <= '~'));
    if (_rows.recognised()) {
      begin(Kind::Rows);
    } else if (!text || _first.size() == TextMax) {
      begin(Kind::SBus);
    }
  }

  void begin(Kind kind) {
    _kind = kind;
    if (kind == Kind::SBus) {
      _writer.comment("sbus record " + _source);
      _writer.opened(_settings);
      for (const line::Character &character : _first) {
        _writer.put(character);
      }
    } else {
      _write("# sbus record " + _source + ": rows of CSV as the sketch printed them, no S.Bus\n");
      _columns = _rows.row().size();
      _rows = line::CsvRows();
      for (const line::Character &character : _first) {
        writeRow(_rows.put(character));
      }
    }
    _first.clear();
  }

  // From the middle of a row on is none.
  void writeRow(bool complete) {
    if (complete && _rows.isRow() && _rows.row().size() == _columns) {
      std::string text;
      for (const line::CsvField &field : _rows.row()) {
        text += (text.empty() ? "" : ",") + field.text;
      }
      _write(text + "\r\n");
      _rowCount++;
    }
  }

  void flush() {
    const std::string lines = _writer.take();
    if (!lines.empty()) {
      _write(lines);
    }
  }

  const std::string _source;
  const line::LineSettings _settings;
  const Put &_write;
  line::RecordingWriter _writer;
  line::Observer _observer;
  line::CsvRows _rows;
  Kind _kind = Kind::Unknown;
  std::vector<line::Character> _first;
  size_t _columns = 0;
  unsigned long _rowCount = 0;
};

void run(const SourceOption &source, const std::string &name) {
  const std::unique_ptr<Input> input = source.open();
  writeTo(name, File::New, [&](const Put &put) {
    Recorder recorder(source.name(), input->settings(), put);
    std::fprintf(stderr, "%s: recording; Ctrl-C ends it\n", name.c_str());
    SilenceNote silence(source.name(), "frames");
    uint64_t endUs = 0;
    input->run([&recorder](const line::Character &character) { recorder.put(character); },
               [&](uint64_t nowUs) {
                 endUs = nowUs;
                 silence.tick(nowUs, recorder.knows());
               });
    recorder.finish();
    std::fprintf(stderr, "%s: %.1f s, %s\n", name.c_str(), static_cast<double>(endUs) / 1e6,
                 recorder.summary().c_str());
  });
}

}  // namespace

void addRecord(CLI::App &app) {
  CLI::App *const subcommand = app.add_subcommand("record", "keeps a line in a text file, or a sketch's rows as CSV");
  const auto source = std::make_shared<SourceOption>(*subcommand, Recordings::AtOnce);
  const auto name = std::make_shared<std::string>();
  subcommand->add_option("FILE", *name, "the recording; one that is there already is left alone; - is standard output")
      ->required()
      ->check(notEmpty())
      ->type_name("");
  subcommand->footer(
      "The file grows with every frame, and is whole after Ctrl-C, if the disk is full, or if the program is killed.");
  subcommand->callback([source, name] { run(*source, *name); });
}

}  // namespace tool
