#include "line/capture/SessionReader.h"

#include <algorithm>

#include "line/capture/Parsing.h"

namespace line {

namespace {

constexpr double SampleSizeMax = 128;  // bytes of a session's samples
constexpr const char *NoRate = "does not say when its samples were taken: --sample-rate is expected";

}  // namespace

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
