// Reads sessions of sigrok and PulseView: samples taken at a fixed rate.
#pragma once

#include "line/capture/Capture.h"

namespace line {

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
