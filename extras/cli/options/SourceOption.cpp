#include "cli/options/SourceOption.h"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <deque>
#include <set>
#include <stdexcept>
#include <utility>

#include "cli/TextLine.h"
#include "line/FrameBytes.h"
#include "line/ports/ByteStream.h"
#include "line/ports/Reopened.h"
#include "line/recording/CsvRows.h"
#include "line/recording/RecordedLine.h"
#include "line/recording/RestoredLine.h"
#include "line/recording/WallTime.h"
#include "line/recording/Words.h"
#include "line/simulation/NoisyLine.h"
#include "line/system/System.h"
#include "line/uart/SampledLine.h"

namespace tool {

namespace {

using BytePace = line::ByteStream::Pace;

int64_t wallUs() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

void cut(const std::string &name, FileSource &file, const PartOption &part) {
  const line::Characters all = std::exchange(file.recording.characters, {});
  for (const line::Character character : all) {
    if (part.has(static_cast<int64_t>(character.endUs) + file.zeroUs)) {
      file.recording.characters.push_back(character);
    }
  }
  file.recording.beginUs = std::max(file.recording.beginUs, part.fromUs(file.zeroUs));
  file.recording.endUs =
      std::min(file.recording.endUs, part.toUs(file.zeroUs) > 0 ? part.toUs(file.zeroUs) : UINT64_MAX);
  if (file.recording.characters.empty()) {
    throw std::runtime_error(name + emptyPart(static_cast<int64_t>(all[0].endUs) + file.zeroUs,
                                              static_cast<int64_t>(all.back().endUs) + file.zeroUs));
  }
}

// Sends the same values as a frame every period, like a receiver.
class RepeatedFrames : public line::Line {
 public:
  RepeatedFrames(const line::Values &values, uint64_t periodUs, uint32_t characterUs)
      : _frame(line::charactersOf(line::frameBytes(line::Stretch::Kind::Frame, values))),
        _periodUs(periodUs),
        _characterUs(characterUs) {}

  bool next(uint64_t nowUs, line::Character &character) override {
    if (_waiting.empty() && _frameUs <= nowUs) {
      line::appendBackToBack(_frame, _frameUs + _frame.size() * _characterUs, 0, _characterUs, _waiting);
      _frameUs += _periodUs;
    }
    if (_waiting.empty() || _waiting.front().endUs > nowUs) {
      return false;
    }
    character = _waiting.front();
    _waiting.pop_front();
    return true;
  }

 private:
  const std::vector<line::Character> _frame;
  const uint64_t _periodUs;
  const uint32_t _characterUs;
  uint64_t _frameUs = 0;  // when the next frame begins
  std::deque<line::Character> _waiting;
};

// Returns true for ch3=172, but not for sim:noise=30 or a file name with an =.
bool isValue(const std::string &word) {
  struct stat status;
  return word.find('=') != std::string::npos && word.find_first_of(":/") > word.find('=') &&
         stat(word.c_str(), &status) != 0;
}

}  // namespace

SourceOption::SourceOption(Subcommand &subcommand, Playback playback, Rows rows, const char *name) {
  _given.playback = playback;
  _given.rows = rows;
  constexpr const char *What = "a serial port, a file, - for standard input, sim, or values such as ch3=172,ch5=on";
  (rows == Rows::Sent ? subcommand.option(name, _words, What) : subcommand.option(name, _word, What).notEmpty())
      .required()
      .type("");
  subcommand.option("--baud", _given.baud, "the line's baud rate: 200000 for Fast S.Bus (a recording's own, or 100000)")
      .oneOf({100000, 200000})
      .type("100000|200000");
  subcommand.option("--seconds", _given.seconds, "stop after S seconds").seconds().type("S");
  _given.signal =
      subcommand.option("--signal", _given.overrides.signal, "the signal of a capture (the one with the most frames)")
          .notEmpty()
          .type("NAME");
  _given.part.addTo(subcommand);
  _given.simulatedTime =
      subcommand.flag("--simulated-time", "play sim and - as fast as possible, with the same output each time");
}

void SourceOption::addRows(Subcommand &subcommand) {
  _given.asRows = subcommand.flag("--rows", "the port carries a sketch's rows, at 115200 baud");
}

SourceOption::SourceOption(const SourceOption &first, const std::string &word, const Option &given,
                           const std::string &signal)
    : _given(first._given), _word(word) {
  if (word == first._word && Pipe::isPipe(word)) {
    rejectCommandLine(word + ": cannot be read twice; name another source");
  }
  if (given.given()) {
    _given.signal = given;
    _given.overrides.signal = signal;
  }
}

const SourceOption::Parsed &SourceOption::parsed() const {
  if (!_parsed) {
    Parsed parsed = parse();
    if (Pipe::isPipe(parsed.name) && parsed.kind == Kind::File) {
      openPipe(parsed);
    }
    rejectOptions(parsed);
    _parsed = std::move(parsed);
  }
  return *_parsed;
}

SourceOption::Parsed SourceOption::parse() const {
  const std::string &first = _words.empty() ? _word : _words.front();
  if (isValue(first)) {
    return parseValues();
  }
  if (_words.size() > 1) {
    rejectCommandLine(_words[1] + " is unexpected; only values such as ch3=172 ch5=on may be several");
  }
  Parsed parsed;
  try {
    parsed.source = line::parseSource(first);
  } catch (const std::runtime_error &error) {
    rejectCommandLine(error.what());
  }
  parsed.name = parsed.source.isSimulated() ? "sim" : parsed.source.name;
  parsed.kind = parsed.source.isSimulated() ? Kind::Simulated : line::isPortName(parsed.name) ? Kind::Port : Kind::File;
  return parsed;
}

SourceOption::Parsed SourceOption::parseValues() const {
  Parsed parsed;
  parsed.kind = Kind::Values;
  std::set<std::string> names;
  for (const std::string &word : _words.empty() ? std::vector<std::string>{_word} : _words) {
    parsed.name += (parsed.name.empty() ? "" : ",") + word;
  }
  line::forEachBetweenCommas(parsed.name, [&](std::string_view each) {
    const std::string value(each);
    const std::string name = line::lower(value.substr(0, value.find('=')));
    if (!names.insert(name).second) {
      rejectCommandLine(line::quoted(value) + " sets " + name + " twice; leave one of them out");
    }
    const std::string wrong = line::assign(value, _given.range, parsed.values);
    if (!wrong.empty()) {
      rejectCommandLine(wrong);
    }
  });
  return parsed;
}

void SourceOption::openPipe(Parsed &parsed) const {
  const auto start = std::chrono::steady_clock::now();
  _startUs = wallUs();
  _pipe = std::make_shared<Pipe>(parsed.name);
  Pipe::Content content = _given.asRows.given() ? Pipe::Content::Line : _pipe->content(_given.seconds);
  content =
      content == Pipe::Content::Line && !_given.asRows.given() && _pipe->isMangled() ? Pipe::Content::File : content;
  _isLiveText = content == Pipe::Content::Text && _given.playback != Playback::Repeatable;
  const bool hasPace = content == Pipe::Content::Line || (_isLiveText && _given.playback == Playback::RealTime);
  _isAtOnce = hasPace && !_given.simulatedTime.given() && _pipe->isFileAtOnce();
  parsed.kind = content == Pipe::Content::Line ? Kind::Stream : Kind::File;
  _waitedS = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void SourceOption::rejectOptions(const Parsed &parsed) const {
  const bool isFile = parsed.kind == Kind::File;
  if (!isFile && parsed.kind != Kind::Simulated) {
    rejectDisturbing(parsed, parsed.kind == Kind::Port ? "a port" : "a stream of bytes");
  }
  if (parsed.source.sbus2 && _given.baud > sbus::Baud) {
    rejectCommandLine("--baud: S.BUS2 has 100000 baud; leave it out");
  }
  if (parsed.kind == Kind::Port && _given.simulatedTime.given()) {
    rejectCommandLine("--simulated-time: is for sim and -; a port runs in real time");
  }
  if (!isFile) {
    if (_given.signal.given()) {
      rejectCommandLine("--signal: is for a capture of several signals; leave it out for " + parsed.name);
    }
    _given.part.reject("is for a file; leave it out for " + parsed.name);
  }
}

void SourceOption::rejectDisturbing(const Parsed &parsed, const char *what) {
  if (parsed.source.disturbs()) {
    rejectCommandLine(parsed.name + ": what follows the colon is for sim or a recording; leave it out for " + what);
  }
}

line::LineSettings SourceOption::settings() const {
  if (_given.asRows.given()) {
    return line::csvSettings();
  }
  if (isFile()) {
    return file().settings;
  }
  line::LineSettings settings;
  settings.baud = _given.baud > 0 ? _given.baud : sbus::Baud;
  return settings;
}

line::LineSettings SourceOption::lineSettings() const {
  line::LineSettings settings = this->settings();
  settings.polarity = parsed().source.settings.idleHigh() ? line::Polarity::Uninverted : settings.polarity;
  return settings;
}

// A pipe whose frames say when they were read is live, however many come at once: old ones may be the rest of a line
// that has stopped.
bool SourceOption::isLive() const {
  const Kind kind = parsed().kind;
  if (kind == Kind::File) {
    return _isLiveText && _given.playback == Playback::RealTime && !_given.simulatedTime.given() &&
           (!_isAtOnce || file().isRead);
  }
  return kind == Kind::Port || (kind == Kind::Stream && !_isAtOnce && !_given.simulatedTime.given());
}

void SourceOption::rejectEmpty() const {
  if (isStream() && _pipe->isEmpty()) {
    throw std::runtime_error(name() + ": is empty: bytes of a line are expected");
  }
}

void SourceOption::rejectRows() const {
  const bool areShown = _given.rows == Rows::Shown || _given.asRows.given();
  if (!areShown && (isFile() ? file().isRows() : isStream() && _pipe->hasRows())) {
    throw std::runtime_error(name() +
                             ": these are rows of CSV, but no frames: a time, all of CH1 to CH16, CH24 or CH32 as raw "
                             "values from 0 to 2047, and rows at most 50 ms apart are expected; sbus monitor shows "
                             "other rows");
  }
}

bool SourceOption::isWire() const {
  const Kind kind = parsed().kind;
  return kind == Kind::File ? !file().isRows() && !file().areBytes() : kind == Kind::Simulated || kind == Kind::Values;
}

std::optional<double> SourceOption::shownUs(uint64_t us) const {
  return hasTimes() ? std::optional<double>(static_cast<double>(static_cast<int64_t>(us) + zeroUs())) : std::nullopt;
}

Json SourceOption::json() const {
  Json json("line");
  json.number("format", uint64_t{1}).text("source", name());
  if (isFile() && !file().signal.empty()) {
    json.text("signal", file().signal);
  }
  json.number("baud", settings().baud);
  if (isWire()) {
    json.flag("inverted", !lineSettings().idleHigh());
  }
  if (startUs()) {
    json.text("start", line::wallTime(*startUs()));
  }
  return hasTimes() ? json : json.flag("timed", false);
}

const FileSource &SourceOption::file() const {
  if (_file) {
    return *_file;
  }
  line::Overrides overrides = _given.overrides;
  overrides.baud = _given.baud;
  FileSource read;
  if (_isLiveText) {
    static_cast<line::FileHead &>(read) = line::headOfText(_pipe->textKind(), _pipe->begin(), _given.baud);
  } else {
    read = readFile(_pipe ? _pipe->wholeFile() : FileName(name()), overrides);
  }
  if (!read.hasTimes || !read.hasRowTimes) {
    _given.part.reject("is for a file with times; leave it out for " + name());
  } else if (read.isCapture() && _given.part.given()) {
    cut(name(), read, _given.part);
  }
  if (read.isRows() || read.areBytes()) {
    rejectDisturbing(parsed(), read.isRows() ? "rows of CSV" : "bytes without times");
  }
  _file = std::make_shared<const FileSource>(std::move(read));
  return *_file;
}

std::unique_ptr<Input> SourceOption::open(const line::LineSettings &port) const {
  rejectRows();
  const Kind kind = parsed().kind;
  const bool atOnce = _given.simulatedTime.given() || (kind == Kind::File && _given.playback != Playback::RealTime);
  const auto pace = atOnce ? Input::Pace::AtOnce : isLive() ? Input::Pace::Live : Input::Pace::RealTime;
  auto input = std::make_unique<Input>(openLine(port), port, pace, leftSeconds());
  input->setStart(_given.part.fromUs(zeroUs()));
  return input;
}

// Returns the rest of --seconds after the wait for a pipe's first bytes.
double SourceOption::leftSeconds() const {
  constexpr double LeastS = 0.001;  // 0 means no limit
  return parsed().kind == Kind::Stream && _given.seconds > 0 ? std::max(LeastS, _given.seconds - _waitedS)
                                                             : _given.seconds;
}

std::unique_ptr<line::Line> SourceOption::openLine(const line::LineSettings &port) const {
  const Parsed &parsed = this->parsed();
  switch (parsed.kind) {
    case Kind::Port: {
      _startUs = wallUs();
      return std::make_unique<line::ReopenedPort>(parsed.name, port);
    }
    case Kind::Stream:
      if (!_given.asRows.given() && !_pipe->hasRows()) {
        std::fprintf(stderr, "%s: bytes without times: times are not known%s\n", parsed.name.c_str(),
                     _isAtOnce ? ", played as fast as a line" : "");
      }
      return std::make_unique<line::ByteStream>(parsed.name, _pipe->descriptor(), _pipe->begin(), port.characterUs(),
                                                _given.simulatedTime.given() ? BytePace::Patient
                                                : _isAtOnce                  ? BytePace::LineRate
                                                                             : BytePace::Live);
    case Kind::File:
      return openFile(port);
    case Kind::Values: {
      auto line = std::make_unique<RepeatedFrames>(parsed.values, _given.periodUs, settings().characterUs());
      return std::make_unique<line::SampledLine>(std::move(line), settings(), port);
    }
    case Kind::Simulated:
      break;
  }
  line::Source source = parsed.source;
  source.settings = lineSettings();
  if (!_given.simulatedTime.given()) {
    _startUs = wallUs();
  }
  return std::make_unique<line::SampledLine>(source.open(), source.settings, port);
}

std::unique_ptr<line::Line> SourceOption::openText() const {
  std::unique_ptr<TextInput> input;
  if (_isLiveText) {
    input = std::make_unique<PipeText>(_pipe->descriptor(), _pipe->begin());
  } else {
    input = std::make_unique<FileText>(file().path, name(), file().kind == line::FileKind::Bytes);
  }
  return std::make_unique<TextLine>(name(), std::move(input), line::makeReader(file(), !_isLiveText),
                                    isLive() ? TextLine::Clock::Live : TextLine::Clock::OfText,
                                    _given.part.fromUs(zeroUs()), _given.part.toUs(zeroUs()));
}

std::unique_ptr<line::Line> SourceOption::openFile(const line::LineSettings &port) const {
  const FileSource &read = file();
  std::unique_ptr<line::Line> line;
  if (read.isCapture()) {
    line = std::make_unique<line::RecordedLine>(std::shared_ptr<const line::Recording>(_file, &read.recording));
  } else {
    line = openText();
  }
  if (read.isLate && _given.rows == Rows::Sent && !isLive()) {
    return std::make_unique<line::RestoredLine>(std::move(line), read.settings.characterUs());
  }
  if (!isWire()) {
    return line;
  }
  const line::LineSettings settings = lineSettings();
  if (parsed().source.noise > 0) {
    line = std::make_unique<line::NoisyLine>(std::move(line), parsed().source.noise, settings.characterUs());
  }
  return std::make_unique<line::SampledLine>(std::move(line), settings, port);
}

}  // namespace tool
