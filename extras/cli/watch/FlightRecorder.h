// Keeps the last seconds of a line. When an event happens, writes them and what follows to a file.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/LineRecorder.h"
#include "cli/watch/EventFiles.h"
#include "line/Segments.h"
#include "line/recording/RecordingFile.h"

namespace tool {

struct RecordedEvent {
  enum class Kind { Begin, Continued, End };

  Kind kind;
  uint64_t us;
  std::string file;     // empty: it could not be written
  std::string summary;  // of End: "1000 characters (0 with errors), 40 frames"
};

class FlightRecorder {
 public:
  struct Plan {
    std::string title;
    uint64_t beforeUs;
    uint64_t afterUs;
    uint64_t longestUs;  // a file's length
  };

  // `startUs`: time 0 in us since 1970; if it is known, times in each file count from the file's beginning.
  // `zeroUs`: the source's own time at time 0.
  FlightRecorder(const Plan &plan, EventFiles files, const line::LineSettings &settings, bool hasTimes,
                 std::optional<int64_t> startUs, int64_t zeroUs,
                 std::function<void(const RecordedEvent &)> tell);

  // Takes the next stretch of the line: files begin and end between two of them, so with whole frames.
  void put(const line::Stretch &stretch);

  // `happens`: whether the event is on at `nowUs`. `sinceUs`: when the first character of its frame ended, if any.
  void tick(uint64_t nowUs, bool happens, uint64_t sinceUs = UINT64_MAX);

  // Takes the time up to which there are no further characters.
  void idleUntil(uint64_t us);

  void finish() { close(RecordedEvent::Kind::End, _nowUs); }

  // Returns how many files could not be written completely.
  unsigned failures() const { return _failures; }

 private:
  // A file that is being written.
  struct Open {
    Open(const std::string &title, const std::string &path, uint64_t zero, const line::LineSettings &settings,
         bool hasTimes, std::optional<int64_t> beganUs, int64_t shownZeroUs)
        : name(path),
          zeroUs(zero),
          file(path, true),
          put([this](const std::string &text) { file.write(text); }),
          recorder(title, settings, true, hasTimes, beganUs, shownZeroUs, put) {}

    const std::string name;
    const uint64_t zeroUs;
    uint64_t firstUs = 0;
    line::LineFile file;
    const Put put;
    LineRecorder recorder;
  };

  using Characters = std::vector<line::Character>;

  void forget(uint64_t us);
  void open(RecordedEvent::Kind kind, uint64_t nowUs, uint64_t sinceUs);
  void write(const Characters &characters);
  void checkFile();
  void close(RecordedEvent::Kind kind, uint64_t nowUs);
  void fail(const std::string &reason);

  const Plan _plan;
  EventFiles _files;
  const line::LineSettings _settings;
  const bool _hasTimes;
  const std::optional<int64_t> _startUs;
  const int64_t _zeroUs;
  const std::function<void(const RecordedEvent &)> _tell;
  std::deque<Characters> _lately;  // the stretches of the last `beforeUs`, without those already in a file
  std::unique_ptr<Open> _open;
  bool _isEvent = false;
  uint64_t _nowUs = 0;
  bool _wasFrame = false;  // the newest stretch
  uint64_t _syncedUs = 0;  // by clockUs()
  uint64_t _untilUs = 0;
  unsigned _failures = 0;
};

}  // namespace tool
