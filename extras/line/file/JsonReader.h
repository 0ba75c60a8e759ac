// Reads JSON lines as `sbus hex --json` writes them, or as another program has changed them: sbus.1, JSON LINES.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "line/file/LineReader.h"
#include "line/LineSettings.h"

namespace line {

// What the first objects say about the line.
struct JsonHead {
  LineSettings settings;
  std::optional<int64_t> startUs;  // time 0 in us since 1970
  bool hasTimes = true;            // its frames have times
  bool isRead = false;             // its frames say when they were read
  bool isKnown = false;            // an object says so
};

// Reads the head of a text, which may be cut anywhere.
JsonHead readJsonHead(std::string_view text);

// An object a line. Types other than line, frame, no_frame and slot are left out. A frame without a
// time ends 9 ms after the previous one.
class JsonReader : public FrameReader {
 public:
  explicit JsonReader(const LineSettings &settings) : FrameReader(settings.characterUs()) {}

  std::string line(std::string_view text, std::deque<Character> &characters) override;
  std::string finish(std::deque<Character> &characters) override;
  bool isComplete() const override { return _hasEnded; }

 private:
  bool _hasEnded = false;  // an object of type end came
};

}  // namespace line
