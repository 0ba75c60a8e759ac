// A recording of a line, as a text file:
//
//   # a comment
//   120 0F E5 03        microseconds at which the first character was complete, then characters back to back
#pragma once

#include <istream>
#include <string>
#include <vector>

#include "Line.h"

namespace host {

struct Recording {
  std::vector<Character> characters;
  std::string error;       // what is wrong and what is expected; empty if nothing is
  unsigned errorLine = 0;  // where, counted from 1; 0 if it is wrong as a whole
};

constexpr size_t RecordingLineMax = 4096;                                     // characters of text
constexpr uint64_t RecordingTimeMaxUs = uint64_t{366} * 24 * 3600 * 1000000;  // a year: what is later is a mistake

// Reads to the end of `in`, or to the first mistake: then `error` is set, and `characters` holds what came before it.
// `characterUs`: what a character takes on the wire.
Recording parseRecording(std::istream &in, uint32_t characterUs = CharacterUs);

}  // namespace host
