// Reads samples as sigrok-cli -O bits and -O hex print them (libsigrok, src/output/bits.c and hex.c, gen_header() and
// receive()): one line for each signal in turn.
#pragma once

#include "line/capture/Capture.h"

namespace line {

class SigrokTextReader : public CaptureReader {
 public:
  // Returns true if a text begins as these do.
  static bool isHead(std::string_view head);

  // `head` is the beginning of the text, `periodNs` the time between two samples, whatever the text says; 0: as it
  // says.
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
  std::vector<std::string> _rows;  // the lines at hand, one of each signal, as 0 and 1
  std::string _levels;             // of the signals, at the end of the rows before
  uint64_t _samples = 0;           // of each signal, before these rows
};

}  // namespace line
