#include "line/capture/RecordedCapture.h"

namespace line {

RecordedCapture::RecordedCapture(const Overrides &overrides)
    : _wire(
          overrides, [this] { _times.begin(_wire.wire()); },
          [this](const WireCharacter &character) {
            recording.characters.push_back(_times.of(character));
            recording.zeroUs = _times.zeroNs() / 1000;
          },
          [this](int64_t ns, bool high) { _edges.put(ns, high); }) {
}

std::string RecordedCapture::failure(const std::string &name, const CaptureEnd &end) const {
  if (!end.rejection.empty()) {
    return end.rejection;
  }
  if (!end.error.empty()) {
    return end.error + "; sbus decode -o FILE keeps the part before it";
  }
  if (recording.characters.empty()) {
    return name + ": " + (_wire.found() ? "has no characters: " + std::string(FrameForm) : _wire.failure(end.periodNs));
  }
  const std::string slow = tooSlow(end.periodNs, _wire.wire().bitNs);
  return slow.empty() ? "" : name + ": " + slow + "; sbus decode shows what can be decoded";
}

}  // namespace line
