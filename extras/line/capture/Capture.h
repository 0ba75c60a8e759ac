// A recording of the wire itself, as a logic analyser or an oscilloscope makes it: text of one of several formats,
// taken line by line with constant memory.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "line/capture/Overrules.h"

namespace line {

constexpr int64_t CaptureTimeMaxNs = int64_t{366} * 24 * 3600 * 1000000000;  // a year: what is later is a mistake
constexpr size_t CaptureLineMax = size_t{1} << 16;                           // characters of text
constexpr size_t SignalsMax = 4096;                                          // of a capture
constexpr size_t CaptureHeadMax = size_t{1} << 16;  // characters in which the format must show itself

// Where a reader's levels go.
class LevelSink {
 public:
  virtual ~LevelSink() = default;

  // Called before signals() if the levels are made of characters that an analyser has decoded: they tell nothing of the
  // wire's speed and polarity.
  virtual void ofCharacters() {}

  // Called once, before the first level: the names of the signals.
  virtual void signals(const std::vector<std::string> &names) = 0;

  // From `ns` on the signal is so. Called at its beginning and at each change; the times of a signal never go back.
  virtual void level(size_t signal, int64_t ns, bool high) = 0;
};

class CaptureReader {
 public:
  explicit CaptureReader(LevelSink &sink) : _sink(sink) {}
  virtual ~CaptureReader() = default;

  // The next lines, each with its LF; only the file's last line may lack it. Returns what is wrong and what is
  // expected, or nothing; after an error it must not be called again.
  virtual std::string put(std::string_view lines) = 0;

  // After the last line.
  virtual std::string finish() { return {}; }

  // "VCD", "PulseView CSV, 1 MHz"
  virtual std::string format() const = 0;

  // True if a threshold is found block by block: then a block is as large as it can be.
  virtual bool wantsFullBlocks() const { return false; }

  // The lines read; after an error the last one is wrong.
  uint64_t lines() const { return _lines; }

  // How far the capture is known: the time of the last sample that was read.
  virtual int64_t endNs() { return _endNs; }

  // Between two samples; 0 if the format does not tell.
  double periodNs() const { return _periodNs; }

 protected:
  LevelSink &_sink;
  uint64_t _lines = 0;
  int64_t _endNs = 0;
  double _periodNs = 0;
};

// A capture whose format it has recognised: `head` is its first CaptureHeadMax characters, or all of it, and is put to
// the reader afterwards. `error`: why there is no reader.
struct OpenedCapture {
  std::unique_ptr<CaptureReader> reader;
  std::string error;
};
OpenedCapture openCapture(std::string_view head, LevelSink &sink, const Overrules &overrules = {});

constexpr const char *OscilloscopeFormat = "oscilloscope's CSV";

// The format of a capture that begins with `head`, as CaptureReader::format(); nothing if it is no capture.
// Not of bits either: a recording may look like them.
std::string captureFormat(std::string_view head);

}  // namespace line
