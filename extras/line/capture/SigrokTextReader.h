// Reads samples as printed by sigrok-cli -O bits and -O hex (libsigrok, src/output/bits.c and hex.c, gen_header() and
// receive()): one line for each signal in turn.
#pragma once

#include "line/capture/Capture.h"

namespace line {

class SigrokTextReader : public CaptureReader {
 public:
  // Returns true if a text begins like these.
  static bool isHead(std::string_view head);

  // `head` is the beginning of the text, `periodNs` the time between two samples, which overrides the text's; 0: the
  // text's.
  SigrokTextReader(std::string_view head, LevelSink &sink, double periodNs);

  std::string put(std::string_view lines) override;
  std::string finish() override;
  std::string format() const override { return _hex ? "sigrok hex" : "sigrok bits"; }

 private:
  std::string take(std::string_view line);
  std::string header(std::string_view line);
  std::string samplesOf(std::string_view text, std::string &samples) const;
  std::string tell();

  const bool _hex;
  size_t _signals = 0;  // 0 before the header
  std::vector<std::string> _names;
  std::vector<std::string> _rows;  // the current lines, one per signal, as 0 and 1
  std::string _levels;             // the signals', at the end of the previous rows
  uint64_t _samples = 0;           // of each signal, before these rows
};

}  // namespace line
