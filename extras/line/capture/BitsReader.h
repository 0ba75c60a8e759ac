// Bits as an oscilloscope's picture shows them and somebody has typed them: 0 and 1, one bit after the other, from a
// start bit on; blanks do not count, and # begins a comment.
#pragma once

#include "line/capture/Capture.h"

namespace line {

class BitsReader : public CaptureReader {
 public:
  // `periodNs`: of a bit, or of a sample. 0: a bit's of 100000 baud.
  BitsReader(LevelSink &sink, double periodNs);

  std::string put(std::string_view lines) override;
  std::string format() const override;

 private:
  const double _bitNs;
  uint64_t _bits = 0;
  bool _begun = false;
  bool _high = false;
};

}  // namespace line
