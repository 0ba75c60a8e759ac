// Bits as an oscilloscope's picture shows them and somebody has typed them: 0 and 1, one bit after the other, from a
// start bit on; blanks do not count, and # begins a comment. 100000 baud.
#pragma once

#include "Capture.h"

namespace line {

class BitsReader : public CaptureReader {
 public:
  explicit BitsReader(LevelSink &sink) : CaptureReader(sink) {}

  std::string put(std::string_view lines) override;
  std::string format() const override { return "bits, 10 us each"; }

 private:
  static constexpr int64_t BitNs = 10000;

  bool _begun = false;
  bool _high = false;
};

}  // namespace line
