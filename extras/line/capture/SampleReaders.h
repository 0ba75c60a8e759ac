// Reads samples taken at a fixed rate: bits, the rows that sigrok-cli prints, and sessions of sigrok and PulseView.
#pragma once

#include "line/capture/Capture.h"

namespace line {

// Bits copied from an oscilloscope's picture: 0 and 1, from a start bit on. Blanks are ignored, # begins a comment.
class BitsReader : public CaptureReader {
 public:
  // `periodNs`: the period of a bit or a sample; 0: a bit at 100000 baud.
  BitsReader(LevelSink &sink, double periodNs);

  std::string put(std::string_view lines) override;
  std::string format() const override { return _periodNs > 0 ? "bits" : "bits, 10 us each"; }
  int64_t endNs() override;

 private:
  const double _bitNs;
};

// Samples as printed by sigrok-cli -O bits and -O hex (libsigrok, src/output/bits.c and hex.c, gen_header() and
// receive()): one line for each signal in turn.
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
  std::string tellRows();

  const bool _hex;
  size_t _signals = 0;  // 0 before the header
  std::vector<std::string> _names;
  std::vector<std::string> _rows;  // the current lines, one per signal, as 0 and 1
};

// A session (.sr): the unpacked "metadata" and samples. Source: libsigrok, src/session_file.c, sr_session_load(), and
// src/session_driver.c, stream_session_data().
class SessionReader : public CaptureReader {
 public:
  // `periodNs` is the time between two samples, which overrides the metadata's; 0: the metadata's.
  SessionReader(LevelSink &sink, double periodNs) : CaptureReader(sink) { _periodNs = periodNs; }

  static constexpr const char *NoMetadata =
      "is a ZIP, but not a session of sigrok or PulseView, which has metadata: export it as VCD or as CSV";

  // Takes all of "metadata". Returns what is wrong and what is expected, or nothing.
  std::string metadata(std::string_view text);

  // Returns the name of the ZIP's entry with the samples. If it does not exist, there are NAME-1, NAME-2 and so on.
  const std::string &samplesName() const { return _samplesName; }

  // Returns the error if there are none.
  std::string noSamples() const {
    return "has no samples: " + _samplesName + " or " + _samplesName + "-1 is expected in it";
  }

  // Takes the next bytes of samples.
  std::string put(std::string_view bytes) override;

  std::string format() const override { return "sigrok session"; }

 private:
  std::string take(std::string_view sample);

  std::string _samplesName;
  std::vector<size_t> _bits;  // each signal's place in a sample
  size_t _sampleSize = 0;     // bytes
  std::string _rest;          // the first bytes of an incomplete sample
  std::string _before;        // the previous sample
};

}  // namespace line
