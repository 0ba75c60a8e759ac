#include "cli/watch/FlightRecorder.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace tool {

namespace {

constexpr uint64_t GapWithinUs = 100000;  // a file may run on for this long, to end between two frames
constexpr uint64_t EventUs = 100000;      // an event's frame is recognised within this time

}  // namespace

FlightRecorder::FlightRecorder(const Plan &plan, EventFiles files, const line::LineSettings &settings, bool hasTimes,
                               std::optional<int64_t> startUs, std::function<void(const RecordedEvent &)> tell)
    : _plan(plan),
      _files(std::move(files)),
      _settings(settings),
      _hasTimes(hasTimes),
      _startUs(startUs),
      _tell(std::move(tell)) {
}

void FlightRecorder::put(const line::Character &character) {
  const uint64_t silenceUs = character.endUs - std::exchange(_lastUs, character.endUs);
  const bool isGap = silenceUs > 2 * uint64_t{_settings.characterUs()};
  if (_open && character.endUs > _open->firstUs + _plan.longestUs + (isGap ? 0 : GapWithinUs)) {
    close(RecordedEvent::Kind::Continued, character.endUs);
    open(RecordedEvent::Kind::Continued, character.endUs, character.endUs);
  }
  if (_open) {
    write(character);
    _goneUs = character.endUs;
    return;
  }
  _lately.push_back(character);
  forget(character.endUs - std::min(character.endUs, _plan.beforeUs + EventUs));
}

void FlightRecorder::idleUntil(uint64_t us) {
  if (_open && us > _open->zeroUs) {
    _open->recorder.idleUntil(us - _open->zeroUs);
  }
}

void FlightRecorder::tick(uint64_t nowUs, bool happens, uint64_t sinceUs) {
  _nowUs = nowUs;
  if (happens) {
    _untilUs = nowUs + _plan.afterUs;
  }
  if (happens && !_isEvent) {
    _isEvent = true;
    open(RecordedEvent::Kind::Begin, nowUs, sinceUs);
  } else if (_isEvent && !happens && nowUs > _untilUs) {
    close(RecordedEvent::Kind::End, nowUs);
    _isEvent = false;
  }
}

// Drops the characters that ended before this time.
void FlightRecorder::forget(uint64_t us) {
  while (!_lately.empty() && _lately.front().endUs < us) {
    _goneUs = _lately.front().endUs;
    _lately.pop_front();
  }
}

void FlightRecorder::open(RecordedEvent::Kind kind, uint64_t nowUs, uint64_t sinceUs) {
  forget(std::min(nowUs - std::min(nowUs, _plan.beforeUs), sinceUs));
  if (!_lately.empty() && _lately.front().endUs < sinceUs) {
    dropPart();
  }
  const uint64_t firstUs = _lately.empty() ? nowUs : _lately.front().endUs;
  const uint64_t zeroUs = _startUs ? firstUs - std::min<uint64_t>(firstUs, _settings.characterUs()) : 0;
  const auto beganUs = _startUs ? std::optional<int64_t>(*_startUs + static_cast<int64_t>(zeroUs)) : std::nullopt;
  std::string name;
  try {
    name = _files.next(beganUs);
    _open = std::make_unique<Open>(_plan.title, name, zeroUs, _settings, _hasTimes, beganUs);
    _open->firstUs = firstUs;
  } catch (const std::runtime_error &error) {
    fail(error.what());
    name.clear();
  }
  _tell({kind, nowUs, name, ""});
  for (const line::Character &character : std::exchange(_lately, {})) {
    write(character);
  }
}

// Drops the rest of a frame without its beginning: the characters before the first gap.
void FlightRecorder::dropPart() {
  const uint64_t gapUs = 2 * uint64_t{_settings.characterUs()};
  if (_lately.front().endUs > _goneUs + gapUs) {
    return;
  }
  const size_t most = std::min<size_t>(_lately.size(), sbus::FrameSize24);
  for (size_t i = 1; i < most; i++) {
    if (_lately[i].endUs - _lately[i - 1].endUs > gapUs) {
      _lately.erase(_lately.begin(), _lately.begin() + static_cast<std::ptrdiff_t>(i));
      return;
    }
  }
}

void FlightRecorder::write(line::Character character) {
  if (!_open) {
    return;
  }
  character.endUs -= _open->zeroUs;
  _open->recorder.put(character);
  if (!_open->file.failure().empty()) {
    fail(_open->file.failure());
    _open.reset();
  }
}

void FlightRecorder::close(RecordedEvent::Kind kind, uint64_t nowUs) {
  if (!_open) {
    return;
  }
  _open->recorder.finish();
  const std::string failure = _open->file.finish();
  if (!failure.empty()) {
    fail(failure);
  }
  if (kind == RecordedEvent::Kind::End) {
    _tell({kind, nowUs, _open->name, _open->recorder.summary()});
  }
  _open.reset();
}

void FlightRecorder::fail(const std::string &reason) {
  std::fprintf(stderr, "%s\n", reason.c_str());
  _failures++;
}

}  // namespace tool
