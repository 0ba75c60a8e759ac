// Records the line in the project's format.
#pragma once

#include <string>

#include "line/LineSettings.h"
#include "line/recording/RecordingWriter.h"

namespace scope {

class TextRecorder {
 public:
  // Begins a recording, whose times count from `nowUs`.
  void begin(const line::LineSettings &settings, uint64_t nowUs);
  void put(line::Character character);
  void end();

  // Returns the whole lines since the last call.
  std::string take() { return _writer.take(); }

 private:
  bool _on = false;
  uint64_t _zeroUs = 0;
  uint32_t _characterUs = 0;
  line::RecordingWriter _writer;
};

}  // namespace scope
