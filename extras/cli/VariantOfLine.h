// What kind of line it is, in words: "S.BUS", "S.BUS2", "R7003SB" ... The end bytes of its frames tell.
#pragma once

#include <array>
#include <string>

#include "line/Observer.h"

namespace tool {

class VariantOfLine {
 public:
  void take(const line::Stretch &stretch);

  // Returns the variant that most of the 16-channel frames have; empty before the first frame.
  std::string text() const;

 private:
  std::array<unsigned long, sbus::UnknownVariant> _ofKind{};
  unsigned long _of24 = 0;
  unsigned long _extra = 0;
};

}  // namespace tool
