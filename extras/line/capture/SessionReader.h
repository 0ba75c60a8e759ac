// Reads a session of sigrok and PulseView (.sr): "metadata" and samples, both unpacked already; libsigrok,
// src/session_file.c, sr_session_load(), and src/session_driver.c, stream_session_data().
#pragma once

#include "line/capture/Capture.h"

namespace line {

class SessionReader : public CaptureReader {
 public:
  // `periodNs` is the time between two samples, whatever the metadata say; 0: as they say.
  SessionReader(LevelSink &sink, double periodNs) : CaptureReader(sink) { _periodNs = periodNs; }

  static constexpr const char *NoMetadata =
      "is a ZIP, but no session of sigrok or PulseView, which has metadata: export it as VCD or as CSV";

  // Takes all of "metadata". Returns what is wrong and what is expected, or nothing.
  std::string metadata(std::string_view text);

  // Returns the name of the ZIP's entry with the samples. If there is no such entry, there are NAME-1, NAME-2 and so on.
  const std::string &samplesName() const { return _samplesName; }

  // Returns what is wrong if there are none.
  std::string noSamples() const {
    return "has no samples: " + _samplesName + " or " + _samplesName + "-1 is expected in it";
  }

  // Takes the next bytes of samples.
  std::string put(std::string_view bytes) override;

  std::string format() const override { return "sigrok session"; }

 private:
  std::string take(std::string_view sample);

  std::string _samplesName;
  std::vector<size_t> _bits;  // of each signal: its place in a sample
  size_t _sampleSize = 0;     // bytes
  std::string _rest;          // the first bytes of a sample
  std::string _before;        // the sample before
  uint64_t _samples = 0;
};

}  // namespace line
