// An S.BUS2 wire: a Futaba receiver, sensors that answer, and a board that may also answer.
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "line/Line.h"
#include "line/simulation/BusJudge.h"
#include "line/simulation/SimulatedReceiver.h"
#include "sbus2/Slots.h"

namespace line {

// The receiver's mode.
enum class BusMode : uint8_t {
  Slots,       // FASSTest 14CH: a frame every 15 ms, end bytes 04 14 24 34 in turn, 32 slots
  OnlySlot0,   // FASSTest 12CH: a frame every 6.3 ms, end byte 08; slot 0 follows after 310 us, no sensor may answer
  NoTelemetry  // end byte 00
};

// A sensor in one slot.
struct BusSensor {
  uint8_t slot;
  sbus::SlotData data;
  int32_t offUs = 0;  // it answers this much too late; negative: too early
};

// Two that send at once destroy each other's characters: the wire is HIGH if either is, and parity fails.
class SimulatedBus : public Line {
 public:
  explicit SimulatedBus(const Choreography &choreography = Flight, BusMode mode = BusMode::Slots);

  // Adds a sensor; two in the same slot collide.
  void add(const BusSensor &sensor) { _sensors.push_back(sensor); }

  // Replaces the frame interval of 15 ms: `interval` returns the time from start to start, us, 4000 or more.
  void pace(std::function<uint32_t()> interval) { _interval = std::move(interval); }

  // Delivers a character only after its end, when no board can destroy it any more: a UART asks a character ahead.
  bool next(uint64_t nowUs, Character &character) override;

  // Connects a board's TX to the wire, through a diode.
  void share(const LineSettings &tx) override;
  void hear(const Character &character) override;
  std::string report() const override;

  const BusJudge &judge() const { return _judge; }

 private:
  struct Sent : Character {
    bool isFramesEnd = false;
  };

  void makeCycle();
  void send(uint64_t startUs, const uint8_t *bytes, size_t size);
  void put(const Sent &sent);
  uint64_t frameAt(uint64_t endUs) const;

  const BusMode _mode;
  SimulatedReceiver _receiver;
  std::vector<BusSensor> _sensors;
  uint32_t _cycles = 0;
  uint64_t _madeUs = 0;  // everything before is in `_wire`
  std::function<uint32_t()> _interval;
  int64_t _shiftUs = 0;            // of frames that are not 15 ms apart
  std::deque<uint64_t> _framesUs;  // the beginnings of the newest frames
  std::deque<Sent> _wire;          // ordered by their ends
  LineSettings _tx;
  bool _isHeld = false;
  bool _isShared = false;
  BusJudge _judge;
};

}  // namespace line
