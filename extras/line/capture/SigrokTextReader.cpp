#include "line/capture/SigrokTextReader.h"

#include <cmath>

#include "line/capture/Parsing.h"

namespace line {

namespace {

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
  return _periodNs > 0 ? "" : "does not say when its samples were taken: --sample-rate is expected";
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
  return _rows.size() == _signals ? tell() : "";
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

std::string SigrokTextReader::tell() {
  if (_levels.empty()) {
    _sink.signals(_names);
    _levels.assign(_signals, 'x');
  }
  for (size_t i = 0; i < _rows.front().size(); i++) {
    const double ns = static_cast<double>(_samples++) * _periodNs;
    if (ns > static_cast<double>(CaptureTimeMaxNs)) {
      return "is longer than a year: is its rate right?";
    }
    _endNs = std::llround(ns);
    for (size_t signal = 0; signal < _signals; signal++) {
      const char level = _rows[signal][i];
      if (level != _levels[signal]) {
        _levels[signal] = level;
        _sink.level(signal, _endNs, level == '1');
      }
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

}  // namespace line
