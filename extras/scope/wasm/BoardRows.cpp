#include "BoardRows.h"

#include <algorithm>

namespace scope {

namespace {

constexpr uint64_t TimeoutMs = 1000;  // the sketches print five rows a second
constexpr uint64_t TimeoutMaxMs = 60000;
constexpr uint64_t Missing = 3;  // rows, until the board is stale: a slow sketch gets more time

}  // namespace

BoardRows::BoardRows() : Arrivals(TimeoutMs) {}

bool BoardRows::put(uint8_t byte, uint64_t nowUs) {
  if (!_rows.put(byte)) {
    return false;
  }
  if (!_rows.isRow()) {
    _otherLines += _rows.isText();
    return false;
  }
  if (!_rows.recognised()) {
    return false;
  }
  _failsafe = false;
  _lostFrame = false;
  for (size_t i = 0; i < row().size(); i++) {
    _failsafe = _failsafe || (kind(i) == line::CsvKind::Failsafe && row()[i].value != 0);
    _lostFrame = _lostFrame || (kind(i) == line::CsvKind::LostFrame && row()[i].value != 0);
  }
  if (!_failsafe && !_lostFrame) {
    mark();
  }
  waitFor(nowUs);
  add(nowUs, static_cast<uint8_t>((_failsafe ? sbus::FlagFailsafe : 0) | (_lostFrame ? sbus::FlagLostFrame : 0)));
  _count++;
  return true;
}

void BoardRows::waitFor(uint64_t nowUs) {
  if (_count > 0) {
    _longestUs = std::max(_longestUs, nowUs - std::min(nowUs, _newestUs));
    setTimeout(static_cast<uint16_t>(std::clamp(Missing * _longestUs / 1000, TimeoutMs, TimeoutMaxMs)));
  }
  _newestUs = nowUs;
}

void BoardRows::mark() {
  for (size_t i = 0; i < row().size(); i++) {
    const double value = row()[i].value;
    if (i == _travel.size()) {
      _travel.push_back({value, value});
    }
    _travel[i] = {std::min(_travel[i].low, value), std::max(_travel[i].high, value)};
  }
}

}  // namespace scope
