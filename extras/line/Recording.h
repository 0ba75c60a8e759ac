// A recording of a line, as a text file:
//
//   # a comment
//   120 0F E5 03! 1F    microseconds at which the first character was complete, then characters back to back; ! after
//   one
//                       with a wrong parity or stop bit
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "Line.h"

namespace line {

struct Recording {
  std::vector<Character> characters;
  std::string error;       // what is wrong and what is expected; empty if nothing is
  unsigned errorLine = 0;  // where, counted from 1; 0 if it is wrong as a whole
};

constexpr size_t RecordingLineMax = 4096;                                     // characters of text
constexpr uint64_t RecordingTimeMaxUs = uint64_t{366} * 24 * 3600 * 1000000;  // a year: what is later is a mistake

// Takes a recording line by line.
class RecordingReader {
 public:
  // `characterUs`: what a character takes on the line.
  explicit RecordingReader(uint32_t characterUs = CharacterUs) : _characterUs(characterUs) {}

  // The next line, without its LF. Does nothing once something was wrong.
  void line(std::string_view text);

  // After the last line. If there is an error, `characters` holds what came before it.
  Recording finish();

 private:
  const uint32_t _characterUs;
  Recording _recording;
  unsigned _number = 0;  // of the last line
};

// A whole recording's text.
Recording parseRecording(std::string_view text, uint32_t characterUs = CharacterUs);

}  // namespace line
