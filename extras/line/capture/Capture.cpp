#include "line/capture/Capture.h"

#include <cmath>

#include "line/capture/AsyncReader.h"
#include "line/capture/CsvReader.h"
#include "line/capture/Parsing.h"
#include "line/capture/VcdReader.h"

namespace line {

std::string CaptureReader::nextSample(double periodNs) {
  const double ns = static_cast<double>(_samples) * periodNs;
  if (ns > static_cast<double>(CaptureTimeMaxNs)) {
    return "is longer than a year: is its sample rate right?";
  }
  _samples++;
  _endNs = std::llround(ns);
  return {};
}

void CaptureReader::tell(size_t signal, bool high) {
  if (signal >= _told.size()) {
    _told.resize(signal + 1, 'x');
  }
  if (_told[signal] != (high ? '1' : '0')) {
    _told[signal] = high ? '1' : '0';
    _sink.level(signal, _endNs, high);
  }
}

OpenedCapture openCapture(std::string_view head, LevelSink &sink, const Overrides &overrides) {
  OpenedCapture opened;
  bool analogue = false;
  const std::string_view begin = trimmed(head).substr(0, 4);  // such as $date
  const bool isVcd = begin.size() == 4 && begin.front() == '$' &&
                     begin.find_first_not_of("abcdefghijklmnopqrstuvwxyz", 1) == begin.npos;
  const bool isAsync = AsyncReader::isHead(head);
  if ((isVcd || isAsync) && overrides.periodNs > 0) {
    opened.error = "has times of its own: leave out --sample-rate";
  } else if (isAsync) {
    opened.reader = std::make_unique<AsyncReader>(head, sink, overrides.baud);
  } else if (isVcd) {
    opened.reader = std::make_unique<VcdReader>(sink);
  } else {
    CsvLayout layout;
    opened.error = trimmed(head).empty() ? "is empty: a capture of a wire is expected"
                                         : findLayout(head, layout, overrides.periodNs);
    analogue = layout.analogue;
    if (opened.error.empty()) {
      opened.reader = std::make_unique<CsvReader>(layout, sink, overrides.threshold);
    }
  }
  if (opened.reader && overrides.threshold && !analogue) {
    return {nullptr, "has no voltages: leave out --threshold"};
  }
  return opened;
}

CaptureForm captureForm(std::string_view head) {
  struct NullSink : LevelSink {
    void signals(const std::vector<std::string> &) override {}
    void level(size_t, int64_t, bool) override {}
  } sink;
  const OpenedCapture opened = openCapture(head, sink);
  return opened.reader ? CaptureForm{opened.reader->format(), opened.reader->periodNs()} : CaptureForm();
}

}  // namespace line
