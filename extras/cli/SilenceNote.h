// Reports once on standard error that a source has sent nothing yet, and throws if it ends without sending anything.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace tool {

class SilenceNote {
 public:
  // Waits for `what`, such as "frames". A file is reported only at its end, since its times may begin anywhere.
  SilenceNote(const std::string &source, const char *what, bool isFile = false)
      : _source(source), _what(what), _done(isFile) {}

  // `has`: `what` has been received.
  void tick(uint64_t nowUs, bool has) {
    _beginUs = std::min(_beginUs, nowUs);
    const bool isLong = nowUs - _beginUs >= AfterUs;
    if (!has && !_done && isLong) {
      std::fprintf(stderr, "%s: no %s yet; run sbus doctor %s\n", _source.c_str(), _what, _source.c_str());
    }
    _done = _done || has || isLong;
  }

  // Takes the end of the source. Throws std::runtime_error without `has`.
  void end(bool has) const {
    if (!has) {
      throw std::runtime_error(_source + ": no " + _what + " received; run sbus doctor");
    }
  }

 private:
  static constexpr uint64_t AfterUs = 2000000;

  const std::string _source;
  const char *const _what;
  uint64_t _beginUs = UINT64_MAX;
  bool _done;
};

}  // namespace tool
