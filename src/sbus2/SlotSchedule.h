/// @file
/// What a board answers on an S.BUS2 line, and when each slot is due. It knows no clock: times come in.
#pragma once

#include <stdint.h>

#include "Slots.h"
#include "Telemetry.h"

namespace sbus {

/// The times of the slots, from the end of the frame's last stop bit: measured on a Futaba R7008SB (PX4-Autopilot,
/// test_data/sbus2_r7008SB.txt) and on a line with eight occupied slots (github.com/mstrens/oXs_on_RP2040).
constexpr uint16_t FirstSlotTime = 2030;  ///< us, of the first slot of a group
constexpr uint16_t SlotPitch = 660;       ///< us, from the start of a slot to the next
constexpr uint16_t SlotTime = 360;        ///< us, of its three characters

/// Keeps the data of the slots that a board fills, and plans the answers to each frame that announces their group. The
/// board hears its own characters; they do not count as a sensor's telemetry.
///
/// No answer starts more than 100 us off its time: if the end of a frame is known less exactly, or a slot's time has
/// passed, the rest of the group is skipped. Nothing is ever sent in slot 0, which belongs to the receiver.
///
/// The context that reads the port calls the events and plan(), and the context that sends calls start(). Both may
/// interrupt write().
class SlotSchedule : public Telemetry {
 public:
  static constexpr uint8_t DeviationMax = 100;  ///< us: the most that a slot may start too early or too late

  /// Sets the data of `count` slots from slot `first` on. An answer never mixes the data of two calls. Returns false,
  /// and changes nothing, if slot 0 is among them or they do not lie within one group.
  bool write(uint8_t first, uint8_t count, const SlotData *data);

  /// Stops answering in `count` slots from slot `first` on.
  void stop(uint8_t first, uint8_t count);

  /// What became of the answers between the two newest frames.
  enum class Outcome : uint8_t {
    None,     ///< nothing was sent
    Fine,     ///< nothing else was heard
    Collided  ///< see SBus2Sensor::collisions()
  };
  Outcome outcome() const { return _outcome; }  ///< Returns the outcome since the previous frame.

  /// Returns true, once, if the newest byte is the last one of an accepted frame.
  bool takeFrameEnd();

  /// Plans the answers to the accepted frame, which ended between `earliest` and `latest`, us. Skips the answers if the
  /// two are more than 100 us apart, and any answer that might not be complete before the next frame, `gap` us after
  /// the end.
  void plan(uint32_t earliest, uint32_t latest, uint32_t gap);

  /// Returns how many us after `now` a timer must poll the port next, 0..500: 0 while the end of a frame is expected.
  uint16_t nextPoll(uint32_t now) const;

  /// Returns true while an answer is planned.
  bool isPlanned() const { return _left != 0; }

  /// Returns when the next planned answer is due, us.
  uint32_t due() const { return _due; }

  /// Takes the next planned answer, which starts at `now`, us. Returns false if that would be too late: then the rest
  /// of the group is skipped. Otherwise writes three characters to `characters`; send them at once.
  bool start(uint32_t now, uint8_t *characters);

  /// Takes back the answer of the newest start(), because the port could not send it. It counts as skipped.
  void unsent();

  /// Skips what is planned.
  void skip();

  uint32_t sent() const { return steady(_sent); }              ///< Returns how many slots were sent since begin().
  uint32_t skipped() const { return steady(_skipped); }        ///< Returns how many slots were skipped since begin().
  uint32_t collisions() const { return steady(_collisions); }  ///< See SBus2Sensor::collisions().

  // The events of a FrameFinder.
  void begin();                                        ///< see NoEvents
  void accepted(const uint8_t *frame);                 ///< see NoEvents
  void lost();                                         ///< see NoEvents
  void discarded(const uint8_t *bytes, int count);     ///< see NoEvents
  static constexpr bool wantsTimes() { return true; }  ///< see NoEvents
  /// See NoEvents.
  void polled(int found, uint32_t time) {
    _pollFound = static_cast<uint16_t>(found > 0 ? found : 0);
    _pollTime = time;
  }

  uint16_t pollFound() const { return _pollFound; }  ///< Returns how many bytes the newest poll has found.
  uint32_t pollTime() const { return _pollTime; }    ///< Returns the time by which these had come, us.

 private:
  static constexpr uint16_t Unsure = UINT16_MAX;

  static uint32_t steady(const uint32_t &counter);
  bool isEchoWrong(bool isWrong);
  void goTo(uint8_t left);

  // The data of the board's own slots.
  struct Own {
    uint32_t slots;  // bit k: it fills slot k
    SlotData data[SlotCount];
  };

  Own &editBack();
  void swap();

  Own _own[2] = {};
  volatile uint8_t _front = 0;  // plan() reads this one of the two; write() changes the other
  Outcome _outcome = Outcome::None;
  bool _isFrameEnd = false;         // the newest byte is the last one of an accepted frame
  uint8_t _endByte = 0;             // of that frame
  uint8_t _group = 0;               // first slot of the announced group
  uint8_t _wanted = 0;              // bit k: slot _group + k is announced, and not yet planned or skipped
  uint8_t _left = 0;                // bit k: slot _group + k is planned
  uint8_t _out = 0;                 // bit k: it was sent after the newest frame
  uint8_t _slack = 0;               // us: how late a slot may start
  uint8_t _at = 0;                  // the next planned slot, from _group
  SlotData _planned[SlotsOfGroup];  // of the moment of the plan
  uint32_t _end = 0;                // us: estimated end of the newest frame
  uint16_t _spread = Unsure;        // us: uncertainty of _end
  uint16_t _pollFound = 0;
  uint32_t _pollTime = 0;
  bool _hasEcho = false;  // RX has heard TX
  uint32_t _due = 0;
  uint32_t _sent = 0;
  uint32_t _skipped = 0;
  uint32_t _collisions = 0;
};

}  // namespace sbus
