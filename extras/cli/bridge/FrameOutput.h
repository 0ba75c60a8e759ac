// Sends the frames of `sbus bridge` to a port, to a pseudo-terminal, or as JSON lines to standard output.
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
  line::Values values;  // with the frame's own switches and flags

  std::vector<uint8_t> bytes() const { return line::frameBytes(kind, values); }
};

class FrameOutput {
 public:
  // `to`: a port; "" for a pseudo-terminal; "-" for JSON lines. Throws std::runtime_error.
  FrameOutput(const std::string &to, const line::LineSettings &settings);

  // Sends a frame at once; on a wire, not before 2 ms after the previous frame's end, since receivers find a frame by
  // the gap before it. A newer frame of the same kind replaces a waiting one. Returns false if the frame waits.
  bool put(const BridgedFrame &frame);

  // Sends the waiting frames that are due. Returns true if a frame still waits.
  bool tick();

  // Returns "1000 frames sent, 3 replaced by newer ones before their turn".
  std::string summary() const;

 private:
  using Clock = std::chrono::steady_clock;

  void send(const BridgedFrame &frame);
  void print(const BridgedFrame &frame);

  std::unique_ptr<Destination> _destination;  // null: standard output
  const uint32_t _characterUs;
  const Clock::time_point _start = Clock::now();
  Clock::time_point _freeFrom{};  // the next frame may begin now
  std::deque<BridgedFrame> _waiting;
  unsigned long _sent = 0;
  unsigned long _replaced = 0;
  unsigned long _lost = 0;
};

}  // namespace tool
