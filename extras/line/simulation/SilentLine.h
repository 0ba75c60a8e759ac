// A silent wire: the receiver has no power, or the wire is broken.
#pragma once

#include "line/Line.h"

namespace line {

class SilentLine : public Line {
 public:
  bool next(uint64_t, Character &) override { return false; }
};

}  // namespace line
