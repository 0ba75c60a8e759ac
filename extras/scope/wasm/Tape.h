// The file that is played.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "line/LineSettings.h"
#include "line/recording/Recording.h"

namespace scope {

struct Tape {
  std::string name;  // of the file
  line::LineSettings settings;
  line::Recording recording;
  bool hasTimes = true;            // of the line
  std::optional<int64_t> startUs;  // when its time 0 was, in us since 1970
};

extern Tape theTape;

}  // namespace scope
