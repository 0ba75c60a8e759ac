#include "line/capture/SampleReaders.h"

#include <algorithm>
#include <cmath>

#include "line/capture/Parsing.h"

namespace line {

namespace {

constexpr double SampleSizeMax = 128;  // bytes of a session's samples
constexpr const char *NoRate = "does not say when its samples were taken: --sample-rate is expected";
constexpr std::string_view Title = "Acquisition with ";

// Takes "D0:" off a line of samples. Returns false for other lines, such as a trigger's "T:  ^ 5".
bool takeName(std::string_view &line, std::string &name) {
  const size_t colon = line.rfind(':');
  if (colon == std::string_view::npos || line.find('^', colon) != std::string_view::npos) {
    return false;
  }
  name = line.substr(0, colon);
  line = trimmed(line.substr(colon + 1));
  return true;
}

// A blank follows every two hexadecimal digits, or every eight bits.
bool isHex(std::string_view head) {
  while (!head.empty()) {
    const std::string_view line = takeLine(head);
    const size_t colon = line.rfind(':');
    if (colon != std::string_view::npos) {
      return line.find(' ', colon) == colon + 3;
    }
  }
  return false;
}

}  // namespace

BitsReader::BitsReader(LevelSink &sink, double periodNs) : CaptureReader(sink), _bitNs(periodNs > 0 ? periodNs : 10000) {
  _periodNs = periodNs;
}

std::string BitsReader::put(std::string_view lines) {
  while (!lines.empty()) {
    std::string_view line = takeLine(lines);
    _lines++;
    line = line.substr(0, line.find('#'));
    for (const char c : line) {
      if (isBlank(c)) {
        continue;
      }
      if (c != '0' && c != '1') {
        return quoted(std::string_view(&c, 1)) + " is not a bit: 0 or 1 is expected";
      }
      if (_samples == 0) {
        _sink.signals({"bits"});
        _endNs = -std::llround(_bitNs);
        tell(0, c == '0');  // idle: the first bit is a start bit
      }
      const std::string wrong = nextSample(_bitNs);
      if (!wrong.empty()) {
        return wrong;
      }
      tell(0, c == '1');
    }
  }
  return {};
}

// It ends with its last bit.
int64_t BitsReader::endNs() {
  return std::llround(static_cast<double>(_samples) * _bitNs);
}

bool SigrokTextReader::isHead(std::string_view head) {
  const std::string_view program = takeLine(head);
  return program.substr(0, 10) == "libsigrok " && head.substr(0, Title.size()) == Title;
}

SigrokTextReader::SigrokTextReader(std::string_view head, LevelSink &sink, double periodNs)
    : CaptureReader(sink), _hex(isHex(head)) {
  _periodNs = periodNs;
}

std::string SigrokTextReader::put(std::string_view lines) {
  std::string error;
  while (!lines.empty() && error.empty()) {
    const std::string_view line = takeLine(lines);
    _lines++;
    error = _lines == 1 ? "" : _lines == 2 ? header(line) : take(line);
  }
  return error;
}

// Reads "Acquisition with 2/8 channels at 1 MHz".
std::string SigrokTextReader::header(std::string_view line) {
  const char *at = line.data() + Title.size();
  double signals = 0;
  if (!takeNumber(at, line.data() + line.size(), signals) || !(signals >= 1) || !(signals <= SignalsMax)) {
    return "there are no signals: \"Acquisition with 1/8 channels\" or more is expected";
  }
  _signals = static_cast<size_t>(signals);
  const size_t rate = line.find(" at ");
  if (_periodNs <= 0 && rate != std::string_view::npos) {
    _periodNs = periodOf(line.substr(rate + 4));
  }
  return _periodNs > 0 ? "" : NoRate;
}

std::string SigrokTextReader::take(std::string_view line) {
  std::string name;
  if (!takeName(line, name)) {
    return trimmed(line).empty() || line.find('^') != std::string_view::npos
               ? ""
               : quoted(line) + " has no samples: a signal's name, a colon and samples are expected";
  }
  if (_names.size() < _signals) {
    _names.push_back(name);
  } else if (name != _names[_rows.size()]) {
    return quoted(name) + " is found where samples of " + quoted(_names[_rows.size()]) + " are expected";
  }
  std::string samples;
  std::string error = samplesOf(line, samples);
  if (error.empty() && !_rows.empty() && samples.size() != _rows.front().size()) {
    error = "there are " + std::to_string(samples.size()) + " samples: as many as above, " +
            std::to_string(_rows.front().size()) + ", are expected";
  }
  if (!error.empty()) {
    return error;
  }
  _rows.push_back(samples);
  return _rows.size() == _signals ? tellRows() : "";
}

std::string SigrokTextReader::samplesOf(std::string_view text, std::string &samples) const {
  for (const char c : text) {
    const char *const digits = "0123456789abcdef";
    const size_t value = std::string_view(digits, _hex ? 16 : 2).find(c);
    if (value == std::string_view::npos && !isBlank(c)) {
      return quoted(std::string_view(&c, 1)) +
             (_hex ? " is not a hexadecimal digit" : " is not a bit: 0 or 1 is expected");
    }
    for (int bit = _hex ? 3 : 0; bit >= 0 && !isBlank(c); bit--) {
      samples += (value >> bit & 1) != 0 ? '1' : '0';
    }
  }
  return {};
}

std::string SigrokTextReader::tellRows() {
  if (_samples == 0) {
    _sink.signals(_names);
  }
  for (size_t i = 0; i < _rows.front().size(); i++) {
    const std::string wrong = nextSample(_periodNs);
    if (!wrong.empty()) {
      return wrong;
    }
    for (size_t signal = 0; signal < _signals; signal++) {
      tell(signal, _rows[signal][i] == '1');
    }
  }
  _rows.clear();
  return {};
}

std::string SigrokTextReader::finish() {
  if (!_rows.empty()) {
    return "the samples of " + std::to_string(_signals) + " signals are expected, but only those of " +
           std::to_string(_rows.size()) + " came";
  }
  return _signals > 0 ? "" : "ends within its header: samples are expected after it";
}

std::string SessionReader::metadata(std::string_view text) {
  std::vector<std::string> names;
  bool isFirst = false;  // only the first device's samples are read
  while (!text.empty()) {
    const std::string_view line = trimmed(takeLine(text));
    isFirst = line.substr(0, 1) == "[" ? line == "[device 1]" : isFirst;
    const size_t equals = line.find('=');
    if (!isFirst || equals == std::string_view::npos) {
      continue;
    }
    const std::string_view key = trimmed(line.substr(0, equals));
    const std::string_view value = trimmed(line.substr(equals + 1));
    double number = 0;
    if (key == "capturefile") {
      _samplesName = value;
    } else if (key == "samplerate" && _periodNs <= 0) {
      _periodNs = periodOf(value);
    } else if (key == "unitsize" && parseNumber(value, number) && number >= 1 && number <= SampleSizeMax) {
      _sampleSize = static_cast<size_t>(number);
    } else if (key.substr(0, 5) == "probe" && parseNumber(key.substr(5), number) && number >= 1 &&
               number <= 8 * SampleSizeMax) {
      _bits.push_back(static_cast<size_t>(number) - 1);
      names.emplace_back(value);
    }
  }
  if (names.empty() || _samplesName.empty() || _sampleSize == 0) {
    return "has no logic signals: a session with them, or CSV of analogue ones, is expected";
  }
  // A device of 16 probes of which 8 were recorded lists all of them.
  while (!_bits.empty() && _bits.back() >= 8 * _sampleSize) {
    _bits.pop_back();
    names.pop_back();
  }
  if (_bits.empty() || *std::max_element(_bits.begin(), _bits.end()) >= 8 * _sampleSize) {
    return "has more probes than fit into its unitsize of " + std::to_string(_sampleSize);
  }
  if (_periodNs <= 0) {
    return NoRate;
  }
  _sink.signals(names);
  return {};
}

std::string SessionReader::put(std::string_view bytes) {
  std::string error;
  if (!_rest.empty()) {
    const size_t lacking = std::min(_sampleSize - _rest.size(), bytes.size());
    _rest += bytes.substr(0, lacking);
    bytes.remove_prefix(lacking);
    if (_rest.size() < _sampleSize) {
      return {};
    }
    error = take(_rest);
    _rest.clear();
  }
  for (; bytes.size() >= _sampleSize && error.empty(); bytes.remove_prefix(_sampleSize)) {
    error = take(bytes.substr(0, _sampleSize));
  }
  _rest += bytes;
  return error;
}

std::string SessionReader::take(std::string_view sample) {
  const std::string wrong = nextSample(_periodNs);
  if (!wrong.empty() || sample == _before) {
    return wrong;
  }
  for (size_t i = 0; i < _bits.size(); i++) {
    tell(i, (static_cast<unsigned char>(sample[_bits[i] / 8]) >> _bits[i] % 8 & 1) != 0);
  }
  _before = sample;
  return {};
}

}  // namespace line
