// Says on standard error, once, that a source has not brought yet what is waited for.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>

namespace tool {

class SilenceNote {
 public:
  // `what`: "frames"
  SilenceNote(const std::string &source, const char *what) : _source(source), _what(what) {}

  void tick(uint64_t nowUs, bool has) {
    _beginUs = std::min(_beginUs, nowUs);
    const bool isLong = nowUs - _beginUs >= AfterUs;
    if (!has && !_done && isLong) {
      std::fprintf(stderr, "%s: no %s yet; sbus doctor %s says why\n", _source.c_str(), _what, _source.c_str());
    }
    _done = _done || has || isLong;
  }

 private:
  static constexpr uint64_t AfterUs = 2000000;

  const std::string _source;
  const char *const _what;
  uint64_t _beginUs = UINT64_MAX;
  bool _done = false;
};

}  // namespace tool
