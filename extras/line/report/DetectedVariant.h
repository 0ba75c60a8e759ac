// The variant of a line in words, such as "S.BUS2", derived from the end bytes of its frames.
#pragma once

#include <array>
#include <string>

#include "line/Observer.h"

namespace line {

class DetectedVariant {
 public:
  void take(const Stretch &stretch);

  // Returns the variant of most 16-channel frames; empty before the first frame.
  std::string text() const;

 private:
  std::array<unsigned long, sbus::UnknownVariant> _of16{};  // frames of 16 channels, by variant
  unsigned long _of24 = 0;
  unsigned long _extra = 0;
};

}  // namespace line
