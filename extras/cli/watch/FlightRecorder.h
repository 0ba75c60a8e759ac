// Keeps the last seconds of a line. When an event happens, writes them and what follows to a file.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cli/LineRecorder.h"
#include "line/Format.h"
#include "line/Segments.h"
#include "line/recording/RecordingFile.h"
#include "line/recording/WallTime.h"

namespace tool {

struct RecordedEvent {
  enum class Kind { Begin, Continued, End };

  Kind kind;
  uint64_t us;
  std::string file;     // empty: it could not be written
  std::string summary;  // of End: "1000 characters (0 with errors), 40 frames"
};

// Names the files of `sbus watch` and removes the oldest.
class EventFiles {
 public:
  // Creates the folder if needed, and keeps at most `mostBytes` in it. Throws std::runtime_error.
  EventFiles(std::string folder, uint64_t mostBytes) : _folder(std::move(folder)), _mostBytes(mostBytes) {
    std::error_code error;
    std::filesystem::create_directory(_folder, error);
    if (error || !std::filesystem::is_directory(_folder)) {
      throw std::runtime_error(_folder + ": cannot be created (" + (error ? error.message() : "it is a file") +
                               "); name a folder that can be written");
    }
  }

  // Removes the oldest files, makes the next one, and returns its name: "DIR/sbus-000042-2026-11-24T15-16-18Z.txt",
  // without the date if `beginUs`, in us since 1970, is unknown. Numbers only grow, so the order is right whatever the
  // clock says.
  std::string next(std::optional<int64_t> beginUs) {
    std::map<unsigned long, std::filesystem::directory_entry> files;
    uint64_t bytes = 0;
    std::error_code error;
    for (const std::filesystem::directory_entry &entry : std::filesystem::directory_iterator(_folder, error)) {
      const unsigned long number = numberOf(entry.path().filename().string());
      if (number > 0) {
        files[number] = entry;
        bytes += entry.file_size(error);
      }
    }
    unsigned long number = files.empty() ? 1 : files.rbegin()->first + 1;
    while (!files.empty() && bytes > _mostBytes) {
      bytes -= std::min<uint64_t>(bytes, files.begin()->second.file_size(error));
      std::filesystem::remove(files.begin()->second.path(), error);
      files.erase(files.begin());
    }
    std::string date = beginUs ? "-" + line::wallTime(*beginUs).substr(0, 19) + "Z" : "";
    std::replace(date.begin(), date.end(), ':', '-');
    const auto name = [&] { return line::format("%s/sbus-%06lu", _folder.c_str(), number) + date + ".txt"; };
    while (isTaken(name())) {
      number++;
    }
    return name();
  }

 private:
  // Makes an empty file of this name, so that no other program takes it. Returns true if one has.
  static bool isTaken(const std::string &name) {
    std::FILE *const file = std::fopen(name.c_str(), "wx");
    return file == nullptr ? errno == EEXIST : std::fclose(file) != 0;
  }

  // Returns 42 for sbus-000042-2026-11-24T15-16-18Z.txt; 0 for other names. After 999999 a number has more digits.
  static unsigned long numberOf(const std::string &name) {
    constexpr int EndLeast = 11;  // of "sbus-000042"
    unsigned long number = 0;
    int end = 0;
    const bool is = std::sscanf(name.c_str(), "sbus-%9lu%n", &number, &end) == 1 && end >= EndLeast &&
                    std::strchr("-.", name[static_cast<size_t>(end)]) != nullptr &&
                    name.compare(name.size() - std::strlen(".txt"), std::string::npos, ".txt") == 0;
    return is ? number : 0;
  }

  const std::string _folder;
  const uint64_t _mostBytes;
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
                 std::optional<int64_t> startUs, int64_t zeroUs, std::function<void(const RecordedEvent &)> tell);

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
