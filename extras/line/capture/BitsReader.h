// Bits copied from an oscilloscope's picture: 0 and 1, from a start bit on. Blanks are ignored, # begins a comment.
#pragma once

#include "line/capture/Capture.h"

namespace line {

class BitsReader : public CaptureReader {
 public:
  // `periodNs`: the period of a bit or a sample; 0: a bit at 100000 baud.
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
