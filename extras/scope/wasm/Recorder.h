// Keeps what is on the line, in the project's format.
#pragma once

#include <string>

#include "line/LineSettings.h"
#include "line/Observer.h"
#include "line/RecordingText.h"

namespace scope {

class Recorder {
 public:
  void begin(const line::LineSettings &settings);
  void put(const line::Stretch &stretch);
  void end();

  // What was written since it was last asked.
  std::string take() { return std::exchange(_text, {}); }

 private:
  bool _on = false;
  line::RecordingText _writer;
  std::string _text;
  uint64_t _lastEndUs = 0;
  uint32_t _characterUs = line::CharacterUs;
};

}  // namespace scope
