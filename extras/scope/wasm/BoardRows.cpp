#include "BoardRows.h"

#include <algorithm>

namespace scope {

namespace {

constexpr uint16_t TimeoutMs = 1000;  // the sketches print five rows a second

}  // namespace

BoardRows::BoardRows() : Arrivals(TimeoutMs) {
}

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
    const std::string name = line::csvName(i, row().size());
    _failsafe = _failsafe || (name == "failsafe" && row()[i].value != 0);
    _lostFrame = _lostFrame || (name == "lostFrame" && row()[i].value != 0);
  }
  if (!_failsafe && !_lostFrame) {
    mark();
  }
  add(nowUs, static_cast<uint8_t>((_failsafe ? sbus::FlagFailsafe : 0) | (_lostFrame ? sbus::FlagLostFrame : 0)));
  _count++;
  return true;
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
