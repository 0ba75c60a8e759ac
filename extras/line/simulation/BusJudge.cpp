#include "line/simulation/BusJudge.h"

#include <algorithm>

namespace line {

void BusJudge::frame(uint64_t endUs, uint8_t end) {
  idleUntil(endUs);
  _frameEndUs = endUs;
  _end = end;
  _hasFrame = true;
}

void BusJudge::heard(const Character &character, uint32_t characterUs, bool isCollided, uint64_t frameUs) {
  const uint64_t startUs = character.endUs - characterUs;
  idleUntil(startUs);
  if (_characters == 0) {
    _startUs = startUs;
    _id = character.value;
    _isCollided = false;
    _frameUs = NoFrame;
  }
  _characters++;
  _lastUs = character.endUs;
  _isCollided = _isCollided || isCollided;
  _frameUs = std::min(_frameUs, frameUs);
}

void BusJudge::idleUntil(uint64_t nowUs) {
  if (_characters > 0 && nowUs > _lastUs + GapUs) {
    close();
  }
}

void BusJudge::close() {
  if (_isCollided && _frameUs != NoFrame && _frameUs + UnseenUs > _startUs) {
    (_frameUs >= _startUs ? _counts.met : _counts.unseen)++;
  } else if (_isCollided) {
    _counts.collided++;
  } else if (_characters > sbus::SlotSize || !sbus::isSlotId(_id)) {
    _counts.torn++;
  } else {
    closeSlot();
  }
  _characters = 0;
}

void BusJudge::closeSlot() {
  if (sbus::slotOfId(_id) == 0) {
    _counts.receivers++;
  } else if (!_hasFrame || !sbus::endsVariant(_end, sbus::SlotsVariant) ||
             sbus::slotOfId(_id) / sbus::SlotsOfGroup != sbus::firstSlotOf(_end) / sbus::SlotsOfGroup) {
    _counts.unannounced++;
  } else {
    const uint64_t dueUs = _frameEndUs + FirstSlotUs + SlotPitchUs * (sbus::slotOfId(_id) % sbus::SlotsOfGroup);
    const int64_t offUs = static_cast<int64_t>(_startUs) - static_cast<int64_t>(dueUs);
    _mostOffUs = std::max(_mostOffUs, offUs < 0 ? -offUs : offUs);
    if (offUs < -SlotToleranceUs) {
      _counts.early++;
    } else if (offUs > SlotToleranceUs) {
      _counts.late++;
    } else if (_characters < sbus::SlotSize) {
      _counts.cut++;
    } else {
      _earliestUs = _counts.right == 0 ? offUs : std::min(_earliestUs, offUs);
      _latestUs = _counts.right == 0 ? offUs : std::max(_latestUs, offUs);
      _counts.right++;
    }
  }
}

std::string BusJudge::text() const {
  std::string text = std::to_string(_counts.right) + " answers in their slots";
  if (_counts.right > 0) {
    text += ", " + std::to_string(_earliestUs) + ".." + std::to_string(_latestUs) + " us off";
  }
  const struct {
    unsigned long count;
    const char *what;
  } faults[] = {{_counts.early, "early"},
                {_counts.late, "late"},
                {_counts.receivers, "in slot 0"},
                {_counts.unannounced, "not announced"},
                {_counts.torn, "torn"},
                {_counts.collided, "collided"},
                {_counts.unseen, "in a frame's first character"},
                {_counts.held, "while TX held the wire"},
                {_counts.met, "met by a frame"},
                {_counts.cut, "cut short"}};
  const char *separator = "; ";
  for (const auto &fault : faults) {
    if (fault.count > 0) {
      text += separator + std::to_string(fault.count) + " " + fault.what;
      separator = ", ";
    }
  }
  return text;
}

}  // namespace line
