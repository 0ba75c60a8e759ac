// Reads what `sbus decode` prints of a capture, a table of frames and other bytes, or of characters, and what `sbus
// hex` prints of a line with times.
#pragma once

#include <vector>

#include "line/LineSettings.h"
#include "line/file/LineReader.h"

namespace line {

class DecodedReader : public FrameReader {
 public:
  explicit DecodedReader(const LineSettings &settings) : FrameReader(settings.characterUs()) {}

  // Returns true if a text is one.
  static bool reads(std::string_view text);

  // Returns the wire's settings.
  static LineSettings settings(std::string_view text);

  std::string line(std::string_view text, std::deque<Character> &characters) override;
  std::string finish(std::deque<Character> &characters) override;

 private:
  std::string frame(std::string_view row, std::vector<Character> &came) const;

  std::vector<std::string> _columns;  // after the time; empty outside a table
};

}  // namespace line
