// The variant of a line in words, such as "S.BUS2", derived from the end bytes of its frames.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <string>

#include "line/Segments.h"
#include "sbus/Frame.h"

namespace line {

class DetectedVariant {
 public:
  // Takes a frame with its end byte.
  void take(Stretch::Kind kind, uint8_t end) {
    const uint8_t variant = kind == Stretch::Kind::Frame24 ? sbus::VariantCount : sbus::variantOfEnd(end);
    _extra += kind == Stretch::Kind::Extra;
    if (kind == Stretch::Kind::Frame24 || (kind == Stretch::Kind::Frame && variant != sbus::NoVariant)) {
      _frames[variant]++;
    }
  }

  // Return the number of frames with 16 channels and with 24.
  uint32_t frames16() const { return std::accumulate(_frames.begin(), _frames.end() - 1, uint32_t{0}); }
  uint32_t frames24() const { return _frames.back(); }

  // Returns the variant of most frames, and others that are no chance: "S.BUS and S.BUS of 24 channels". Empty before
  // the first frame.
  std::string text() const {
    constexpr const char *Texts[] = {"S.BUS", "S.BUS2", "S.BUS of an R7003SB (end byte 08)", "S.BUS of 24 channels"};
    static_assert(std::size(Texts) == sbus::VariantCount + 1, "a text for each row of LineVariants, and 24 channels");
    constexpr uint32_t ByChance = 8;
    const uint32_t most = *std::max_element(_frames.begin(), _frames.end());
    const uint32_t all = frames16() + frames24();
    std::string text;
    for (size_t i = 0; i < _frames.size() && most > 0; i++) {
      if (_frames[i] == most || _frames[i] > ByChance + all / 100) {
        const bool isExtra = i < sbus::VariantCount && _extra > _frames[i] / 2;
        text += (text.empty() ? "" : " and ") + std::string(isExtra ? "FASSTest 26" : Texts[i]);
      }
    }
    return text;
  }

 private:
  std::array<uint32_t, sbus::VariantCount + 1> _frames{};  // by variant; the last have 24 channels
  uint32_t _extra = 0;
};

}  // namespace line
