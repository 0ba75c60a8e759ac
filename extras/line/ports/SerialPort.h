// A real receiver at a serial port of this PC: an adapter with inverted RXD, or with an inverter in front of it.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "line/ports/LowLatency.h"
#include "line/ports/PortFile.h"
#include "line/Line.h"
#include "line/ports/PortReads.h"

namespace line {

class SerialPort : public Line {
 public:
  // Opens the port. Throws std::runtime_error that says what is wrong and what to do.
  explicit SerialPort(const std::string &device, const LineSettings &settings = {});

  bool next(uint64_t nowUs, Character &character) override;
  uint64_t knownUs(uint64_t) const override { return _reads.knownUs(); }
  bool wait() override;
  std::string failure() const override { return _failure; }
  std::string note() const override;

 private:
  // PortFile puts FF 00 before a character with an error, and doubles each FF.
  enum class Mark { None, Escape, Bad };

  uint64_t nowUs() const;
  void poll();
  void take(const uint8_t *bytes, size_t count);
  bool unmark(uint8_t byte, Character &character);

  std::string _device;
  PortFile _port;
  LowLatency _lowLatency;
  std::string _latencyFile;
  std::optional<unsigned> _latencyMs;  // nothing if unknown
  PortReads _reads;
  std::string _failure;

  Mark _mark = Mark::None;
  std::deque<Character> _waiting;
  bool _started = false;
  uint64_t _zeroUs = 0;  // by clockUs()
  uint64_t _lastReadUs = 0;
  uint64_t _sinceUs;       // nothing waited at that time of clockUs()
  bool _isSilent = false;  // for longer than bytes can be delayed
};

}  // namespace line
