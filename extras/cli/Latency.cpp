#include "cli/Latency.h"

#include <algorithm>

#include "line/Format.h"

namespace tool {

void Latency::passed(size_t characters, bool written) {
  const Read last = _reads[characters - 1];
  _reads.erase(_reads.begin(), _reads.begin() + static_cast<std::ptrdiff_t>(characters));
  if (written) {
    const auto time = std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - last.time);
    (last.loop == _loop ? _us : _lateUs).push_back(static_cast<unsigned>(time.count()));
  }
}

std::string Latency::text(const char *what) {
  std::sort(_us.begin(), _us.end());
  return line::format(
      "last byte read to %s written: median %u us, worst %u us of %zu frames; %zu waited for later bytes, %u us "
      "at most",
      what, _us.empty() ? 0 : _us[_us.size() / 2], _us.empty() ? 0 : _us.back(), _us.size(), _lateUs.size(),
      _lateUs.empty() ? 0 : *std::max_element(_lateUs.begin(), _lateUs.end()));
}

}  // namespace tool
