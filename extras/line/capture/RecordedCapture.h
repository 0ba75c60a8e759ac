// A capture as a recording: the characters of the signal that carries S.Bus, from time 0 on.
#pragma once

#include <string>

#include "line/capture/CaptureText.h"
#include "line/capture/CaptureTimes.h"
#include "line/capture/EdgeStore.h"
#include "line/recording/Recording.h"

namespace line {

class RecordedCapture {
 public:
  explicit RecordedCapture(const Overrides &overrides = {});
  RecordedCapture(const RecordedCapture &) = delete;
  RecordedCapture &operator=(const RecordedCapture &) = delete;

  // Returns the decoder, which takes the capture.
  WireDecoder &wire() { return _wire; }

  // Returns, after the end, why it cannot be played; nothing if it can. `name`: the file's.
  std::string failure(const std::string &name, const CaptureEnd &end) const;

  const LineSettings &settings() const { return _wire.wire().settings; }

  // Return the edges of the signal, and the recording's time 0 in the capture's time.
  const EdgeStore &edges() const { return _edges; }
  int64_t zeroNs() const { return _times.zeroNs(); }

  Recording recording;

 private:
  WireDecoder _wire;
  CaptureTimes _times;
  EdgeStore _edges;
};

}  // namespace line
