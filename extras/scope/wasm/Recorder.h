// Keeps what is on the line, in the project's format.
#pragma once

#include <string>

#include "line/LineSettings.h"
#include "line/Observer.h"
#include "line/RecordingWriter.h"

namespace scope {

class Recorder {
 public:
  void begin(const line::LineSettings &settings);
  void put(const line::Stretch &stretch);
  void end();

  // Whole lines, since it was last asked.
  std::string take() { return _writer.take(); }

 private:
  bool _on = false;
  line::RecordingWriter _writer;
};

}  // namespace scope
