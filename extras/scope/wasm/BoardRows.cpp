#include "BoardRows.h"

#include <algorithm>

namespace scope {

namespace {

constexpr uint64_t SecondUs = 1000000;
constexpr uint16_t TimeoutMs = 1000;  // the sketches print five rows a second

}  // namespace

void BoardRows::reset() {
  *this = BoardRows();
  _link.setTimeout(TimeoutMs);
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
  _link.frame(static_cast<uint8_t>((_failsafe ? sbus::FlagFailsafe : 0) | (_lostFrame ? sbus::FlagLostFrame : 0)));
  if (!_failsafe && !_lostFrame) {
    mark();
  }
  if (_count > 0) {
    _gaps.add(nowUs - _lastUs);
  }
  _lastUs = nowUs;
  _count++;
  _lately.push_back(nowUs);
  while (_lately.front() + SecondUs <= nowUs) {
    _lately.pop_front();
  }
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

sbus::LinkState BoardRows::state(uint64_t nowUs) {
  return _link.state(static_cast<uint32_t>(_lastUs), static_cast<uint32_t>(std::max(nowUs, _lastUs)));
}

unsigned BoardRows::perSecond(uint64_t nowUs) const {
  return static_cast<unsigned>(
      std::count_if(_lately.begin(), _lately.end(), [nowUs](uint64_t us) { return us + SecondUs > nowUs; }));
}

}  // namespace scope
