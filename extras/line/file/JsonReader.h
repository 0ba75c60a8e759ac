// Reads JSON lines as `sbus hex --json` writes them, or as another program has changed them: sbus.1, JSON LINES.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "line/file/LineReader.h"
#include "line/file/LineSplitter.h"
#include "line/LineSettings.h"

namespace line {

// Splits a text into objects.
class JsonSplitter {
 public:
  // Takes a character. Returns true if it completes an object.
  bool put(char c);

  // Returns the complete object.
  std::string take() { return std::exchange(_object, {}); }

  // Returns true if an object has begun.
  bool isWithin() const { return _depth > 0; }

  // Returns true if an object is too long for any memory: an end is missing.
  bool isTooLong() const { return _object.size() > TextLineMax; }

 private:
  std::string _object;
  int _depth = 0;
  bool _inText = false;  // within quotation marks
  bool _isEscaped = false;
};

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

// An object may span lines. Types other than line, frame, no_frame and slot are left out. A frame without a
// time ends 9 ms after the previous one.
class JsonReader : public FrameReader {
 public:
  explicit JsonReader(const LineSettings &settings) : FrameReader(settings.characterUs()) {}

  std::string line(std::string_view text, std::deque<Character> &characters) override;
  std::string finish(std::deque<Character> &characters) override;
  bool isComplete() const override { return _hasEnded; }

 private:
  std::string take(const std::string &object, std::deque<Character> &characters);
  std::string put(std::optional<double> endUs, uint32_t lateUs, const std::vector<Character> &came,
                  std::deque<Character> &characters);

  JsonSplitter _splitter;
  bool _hasEnded = false;  // an object of type end came
};

}  // namespace line
