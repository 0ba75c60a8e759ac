// The variant of a line in words, such as "S.BUS2", derived from the end bytes of its frames.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <string>

#include "line/Segments.h"
#include "sbus/Frame.h"

namespace line {

class DetectedVariant {
 public:
  void take(const Stretch &stretch) { take(stretch.kind, stretch.characters.back().value); }
  // Takes a frame with its end byte.
  void take(Stretch::Kind kind, uint8_t end) {
    const uint8_t variant = sbus::variantOfEnd(end);
    _of24 += kind == Stretch::Kind::Frame24;
    _extra += kind == Stretch::Kind::Extra;
    if (kind == Stretch::Kind::Frame && variant != sbus::UnknownVariant) {
      _of16[variant]++;
    }
  }

  // Returns the variant of most 16-channel frames; empty before the first frame.
  std::string text() const {
    constexpr const char *Texts[] = {"S.BUS", "S.BUS2", "S.BUS of an R7003SB (end byte 08)"};
    static_assert(std::size(Texts) == sbus::UnknownVariant, "a text for each row of LineVariants");
    const auto most = std::max_element(_of16.begin(), _of16.end());
    if (_of24 > *most) {
      return "S.BUS of 24 channels";
    }
    if (*most == 0) {
      return {};
    }
    return _extra > *most / 2 ? "FASSTest 26" : Texts[most - _of16.begin()];
  }

 private:
  std::array<unsigned long, sbus::UnknownVariant> _of16{};  // frames of 16 channels, by variant
  unsigned long _of24 = 0;
  unsigned long _extra = 0;
};

}  // namespace line
