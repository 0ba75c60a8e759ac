// A capture as a recording: the characters of the signal that carries S.Bus, from time 0 on.
#pragma once

#include <algorithm>
#include <string>

#include "line/capture/CaptureText.h"
#include "line/capture/EdgeStore.h"
#include "line/recording/Recording.h"

namespace line {

// Converts the times of a capture's characters for an Observer: they count from 0, even if the capture begins before
// its own time 0, the trigger's.
class CaptureTimes {
 public:
  // Takes the wire, and when the capture begins.
  void begin(const FoundWire &wire, int64_t beginNs = 0) {
    _characterNs = wire.settings.format.bits() * wire.bitNs;
    _zeroNs = floor(beginNs);
  }

  // Returns the character with its time. Time 0 is the capture's, or its beginning if that is earlier.
  Character of(const WireCharacter &character) {
    if (!_begun) {
      _begun = true;
      _zeroNs = std::min(_zeroNs, floor(character.startNs));
    }
    return character.since(_zeroNs, _characterNs);
  }

  // Returns an Observer's time 0 in the capture's time: whole microseconds, not above 0.
  int64_t zeroNs() const { return _zeroNs; }

  // Converts the capture's time `ns` for an Observer.
  uint64_t us(int64_t ns) const { return static_cast<uint64_t>(std::max<int64_t>(0, ns - _zeroNs) / 1000); }

 private:
  // Returns a time below 0 in whole microseconds, or 0.
  static int64_t floor(int64_t ns) { return std::min<int64_t>(0, ns - 999) / 1000 * 1000; }

  bool _begun = false;
  int64_t _zeroNs = 0;
  double _characterNs = 0;
};

class RecordedCapture {
 public:
  // `keepsEdges`: edges() has them; they take as much memory as the characters.
  explicit RecordedCapture(const Overrides &overrides, bool keepsEdges)
      : _wire(
            overrides, [this] { _times.begin(_wire.wire(), _wire.beginNs()); },
            [this](const WireCharacter &character) {
              recording.characters.push_back(_times.of(character));
              recording.zeroUs = _times.zeroNs() / 1000;
            },
            keepsEdges ? std::function([this](int64_t ns, bool high) { _edges.put(ns, high); }) : nullptr) {}
  RecordedCapture(const RecordedCapture &) = delete;
  RecordedCapture &operator=(const RecordedCapture &) = delete;

  // Returns the decoder, which takes the capture.
  WireDecoder &wire() { return _wire; }

  // Returns, after the end, why it cannot be played; nothing if it can. `name`: the file's.
  std::string failure(const std::string &name, const CaptureEnd &end) {
    if (!end.rejection.empty()) {
      return end.rejection;
    }
    if (!end.error.empty()) {
      return end.error + "; sbus decode -o FILE keeps the part before it";
    }
    if (recording.characters.empty()) {
      return name + ": " +
             (_wire.found() ? "has no characters: " + std::string(FrameForm) : _wire.failure(end.periodNs));
    }
    recording.beginUs = _times.us(_wire.beginNs());
    recording.endUs = _times.us(_wire.captureEndNs());
    const std::string slow = tooSlow(end.periodNs, _wire.wire().bitNs);
    return slow.empty() ? "" : name + ": " + slow + "; sbus decode shows what can be decoded";
  }

  const LineSettings &settings() const { return _wire.wire().settings; }

  // Return the edges of the signal, and the recording's time 0 in the capture's time.
  const EdgeStore &edges() const { return _edges; }
  int64_t zeroNs() const { return _times.zeroNs(); }

  Recording recording;

 private:
  WireDecoder _wire;
  CaptureTimes _times;
  EdgeStore _edges;
};

}  // namespace line
