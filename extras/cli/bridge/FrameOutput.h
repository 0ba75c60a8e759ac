// Sends frames to a port, to a pseudo-terminal, or as JSON lines to standard output. Here, and only here, it is decided
// whether a frame may still leave.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/Destination.h"
#include "line/FrameBytes.h"
#include "line/Segments.h"
#include "line/Statistics.h"

namespace tool {

struct BridgedFrame {
  line::Stretch::Kind kind;
  std::optional<uint64_t> us;
  line::Values values;   // with the frame's own switches and flags
  uint8_t end = 0;       // its end byte
  uint64_t sinceUs = 0;  // see line::Character
  uint32_t lateUs = 0;

  std::vector<uint8_t> bytes() const { return line::frameBytes(kind, values, end); }
};

class FrameOutput {
 public:
  // `to`: a port; "" for a pseudo-terminal; "-" for JSON lines. Throws std::runtime_error.
  FrameOutput(const std::string &to, const line::LineSettings &settings);

  // Returns false if a frame that has waited since then must not leave: a stick moves in 0.1 s. A time to come is that
  // of another PC's clock.
  static bool mayLeave(uint64_t sinceUs);

  // See Destination.
  bool waitForReader(double seconds) const { return !_destination || _destination->waitForReader(seconds); }

  // See Destination.
  bool isGone() const { return _destination && _destination->isGone(); }

  // Sends a frame at once; on a wire, not before 2 ms after the previous frame's end, since receivers find a frame by
  // the gap before it, and not before the previous frame has left. A newer frame of the same kind replaces a waiting
  // one.
  void put(const BridgedFrame &frame);

  // Sends the waiting frames that are due. Returns true if a frame still waits.
  bool tick();

  // Gives the last frame time to leave.
  void finish();

  // Returns "1000 frames sent, 3 replaced by newer ones before their turn".
  std::string summary() const;

 private:
  using Clock = std::chrono::steady_clock;

  bool isOld(const BridgedFrame &frame);
  uint64_t nowUs() const;
  bool ask(Clock::duration silence);
  void send();
  bool write(const std::vector<uint8_t> &bytes);
  void print(const BridgedFrame &frame);

  std::unique_ptr<Destination> _destination;  // null: standard output
  const uint32_t _characterUs;
  const Clock::time_point _start = Clock::now();
  Clock::time_point _writtenAt{};
  Clock::time_point _freeFrom{};  // the next frame may begin now
  std::deque<BridgedFrame> _waiting;
  size_t _begun = 0;        // bytes of the first of them that have been sent
  uint64_t _printedUs = 0;  // the time of the last line
  unsigned long _sent = 0;
  unsigned long _replaced = 0;
  unsigned long _old = 0;
  unsigned long _lost = 0;
  unsigned long _cutBytes = 0;
};

}  // namespace tool
