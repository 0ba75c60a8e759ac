// Writes a recording to a stream.
#pragma once

#include <ostream>
#include <string>

#include "RecordingText.h"

namespace line {

class RecordingWriter {
 public:
  // `out` must outlive it. Whoever owns it looks whether it has gone wrong.
  explicit RecordingWriter(std::ostream &out) : _out(out) {}

  // As those of RecordingText.
  void opened(const LineSettings &settings);
  void put(const Character &character);
  void finish();

 private:
  void write();

  std::ostream &_out;
  RecordingText _text;
  std::string _pending;  // what the last call has appended
};

}  // namespace line
