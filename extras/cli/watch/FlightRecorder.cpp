#include "cli/watch/FlightRecorder.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "line/system/System.h"

namespace tool {

namespace {

constexpr uint64_t BetweenWithinUs = 100000;  // a file may run on for this long, to end before or after a frame
constexpr uint64_t EventUs = 100000;          // an event's frame is recognised within this time
constexpr uint64_t SyncUs = 1000000;          // how often a file is written to the disk itself

}  // namespace

FlightRecorder::FlightRecorder(const Plan &plan, EventFiles files, const line::LineSettings &settings, bool hasTimes,
                               std::optional<int64_t> startUs, int64_t zeroUs,
                               std::function<void(const RecordedEvent &)> tell)
    : _plan(plan),
      _files(std::move(files)),
      _settings(settings),
      _hasTimes(hasTimes),
      _startUs(startUs),
      _zeroUs(zeroUs),
      _tell(std::move(tell)) {}

void FlightRecorder::put(const line::Stretch &stretch) {
  const uint64_t firstUs = stretch.characters.front().endUs;
  const bool isBetween = std::exchange(_wasFrame, stretch.isFrame()) || stretch.isFrame();
  const uint64_t longestUs = _plan.longestUs + (isBetween ? 0 : BetweenWithinUs);
  if (_open && stretch.endUs() > _open->firstUs + longestUs) {
    close(RecordedEvent::Kind::Continued, firstUs);
    open(RecordedEvent::Kind::Continued, firstUs, firstUs);
  }
  if (_open) {
    write(stretch.characters);
    return;
  }
  _lately.push_back(stretch.characters);
  forget(stretch.endUs() - std::min(stretch.endUs(), _plan.beforeUs + EventUs));
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
  const uint64_t clockUs = line::clockUs();
  if (_open && clockUs >= _syncedUs + SyncUs) {
    _open->file.sync();
    checkFile();
    _syncedUs = line::clockUs();
  }
}

// Drops what began before this time.
void FlightRecorder::forget(uint64_t us) {
  while (!_lately.empty() && _lately.front().front().endUs < us) {
    _lately.pop_front();
  }
}

void FlightRecorder::open(RecordedEvent::Kind kind, uint64_t nowUs, uint64_t sinceUs) {
  forget(std::min(nowUs - std::min(nowUs, _plan.beforeUs), sinceUs));
  const uint64_t firstUs = _lately.empty() ? nowUs : _lately.front().front().endUs;
  const uint64_t zeroUs = _startUs ? firstUs - std::min<uint64_t>(firstUs, _settings.characterUs()) : 0;
  const auto beganUs =
      _startUs ? std::optional<int64_t>(*_startUs + _zeroUs + static_cast<int64_t>(zeroUs)) : std::nullopt;
  std::string name;
  try {
    name = _files.next(beganUs);
    _open = std::make_unique<Open>(_plan.title, name, zeroUs, _settings, _hasTimes, beganUs, _startUs ? 0 : _zeroUs);
    _open->firstUs = firstUs;
  } catch (const std::runtime_error &error) {
    fail(error.what());
    name.clear();
  }
  _tell({kind, nowUs, name, ""});
  for (const Characters &each : std::exchange(_lately, {})) {
    write(each);
  }
}

void FlightRecorder::write(const Characters &characters) {
  for (line::Character character : characters) {
    if (_open) {
      character.endUs -= _open->zeroUs;
      _open->recorder.put(character);
    }
    checkFile();
  }
}

void FlightRecorder::checkFile() {
  if (_open && !_open->file.failure().empty()) {
    fail(_open->file.failure());
    _open.reset();
  }
}

void FlightRecorder::close(RecordedEvent::Kind kind, uint64_t nowUs) {
  if (!_open) {
    return;
  }
  _open->recorder.finish();
  _open->file.sync();
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
