// A line as received by a port that may have other settings.
#pragma once

#include <memory>

#include "line/Line.h"
#include "line/uart/UartSampler.h"

namespace line {

class SampledLine : public Line {
 public:
  SampledLine(std::unique_ptr<Line> line, const LineSettings &settings, const LineSettings &port)
      : _line(std::move(line)), _settings(settings), _port(port), _agrees(mismatch(port, settings).empty()) {}

  void opened(uint64_t nowUs) override {
    _line->opened(nowUs);
    _sampler.open(nowUs, _port, _settings);
  }
  bool next(uint64_t nowUs, Character &character) override {
    for (Character sent; !_agrees && _line->next(nowUs, sent);) {
      _sampler.put(sent);
    }
    return _agrees ? _line->next(nowUs, character) : _sampler.next(nowUs, character);
  }
  bool finished(uint64_t nowUs) const override { return _line->finished(nowUs); }
  std::string failure() const override { return _line->failure(); }
  bool isBroken() const override { return _line->isBroken(); }
  std::string news() override { return _line->news(); }
  uint64_t knownUs(uint64_t nowUs) const override { return _line->knownUs(nowUs); }
  bool wait() override { return _agrees && _line->wait(); }
  bool canAdvanceTo(uint64_t us) override { return _line->canAdvanceTo(us); }

 private:
  std::unique_ptr<Line> _line;
  LineSettings _settings;
  LineSettings _port;
  bool _agrees;  // port and line have the same settings: no sampling is needed
  UartSampler _sampler;
};

}  // namespace line
