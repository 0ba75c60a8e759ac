// Reads a recording of the wire itself, made by a logic analyser or an oscilloscope: text in one of several formats,
// line by line, in constant memory.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "line/LineSettings.h"

namespace line {

constexpr int64_t CaptureTimeMaxNs = int64_t{366} * 24 * 3600 * 1000000000;  // a year: later times are a mistake
constexpr size_t SignalsMax = 4096;                                          // in a capture
constexpr size_t CaptureHeadMax = 65536;                                     // characters; they must show the format

// Options that overrule a capture's own information.
struct Overrides {
  std::string signal;               // the only signal to decode; empty: all
  unsigned long baud = 0;           // 0: 100000 or 200000, whichever fits
  double periodNs = 0;              // between two samples; 0: the capture's own
  std::optional<double> threshold;  // for voltages, in the capture's unit; nothing: detected
};

// Receives levels from a reader.
class LevelSink {
 public:
  virtual ~LevelSink() = default;

  // Called before signals() if the levels are made from characters decoded by an analyser: they do not show the wire's
  // speed and polarity.
  virtual void fromCharacters() {}

  // Takes the names of the signals. Called once, before the first level.
  virtual void signals(const std::vector<std::string> &names) = 0;

  // Takes a signal's level from `ns` on. Called at the beginning and at each change. A signal's times never go back.
  virtual void level(size_t signal, int64_t ns, bool high) = 0;
};

class CaptureReader {
 public:
  explicit CaptureReader(LevelSink &sink) : _sink(sink) {}
  virtual ~CaptureReader() = default;

  // Takes the next lines, each with its LF; only the file's last line may lack it. Returns what is wrong and what is
  // expected, or nothing; after an error it must not be called again.
  virtual std::string put(std::string_view lines) = 0;

  // Takes the end, after the last line. Returns what is wrong, or nothing.
  virtual std::string finish() { return {}; }

  // Returns "VCD", "PulseView CSV, 1 MHz" ...
  virtual std::string format() const = 0;

  // Returns true if a threshold is found block by block, so blocks should be as large as possible.
  virtual bool needsFullBlocks() const { return false; }

  // Returns the number of lines read; after an error the last of them is wrong.
  uint64_t lines() const { return _lines; }

  // Returns the time of the last sample read.
  int64_t endNs() const { return _endNs; }

  // Returns the time between two samples; 0 if unknown.
  double periodNs() const { return _periodNs; }

 protected:
  // Sets _endNs to the time of the next sample of a fixed rate. Returns what is wrong, or nothing.
  std::string nextSample(double periodNs);

  // Passes a signal's level at _endNs on, unless the signal has it already.
  void tell(size_t signal, bool high);

  LevelSink &_sink;
  uint64_t _lines = 0;
  int64_t _endNs = 0;
  double _periodNs = 0;
  uint64_t _samples = 0;  // by nextSample()

 private:
  std::string _told;  // by signal: 0, 1 or x
};

// The reader of a capture, or why it cannot be read.
struct OpenedCapture {
  std::unique_ptr<CaptureReader> reader;
  std::string error;
};

// Recognises the format of a capture. `head` is its first CaptureHeadMax characters, or all of it; the reader must get
// them afterwards.
OpenedCapture openCapture(std::string_view head, LevelSink &sink, const Overrides &overrides = {});

constexpr const char *OscilloscopeFormat = "oscilloscope's CSV";

// The CaptureReader::format() and the period of a capture that begins with `head`; "" if it is not a capture.
struct CaptureForm {
  std::string name;
  double periodNs = 0;
};
CaptureForm captureForm(std::string_view head);

}  // namespace line
