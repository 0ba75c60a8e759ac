// The line that the page shows, and its decoder.
#pragma once

#include <deque>
#include <memory>
#include <string_view>
#include <vector>

#include "BoardRows.h"
#include "Damage.h"
#include "FedLine.h"
#include "SimulatedLine.h"
#include "StalledReads.h"
#include "VerdictOfSecond.h"
#include "line/Condition.h"
#include "line/Examination.h"
#include "line/LineSettings.h"
#include "line/Observer.h"
#include "line/ports/PortReads.h"
#include "line/recording/RecordingWriter.h"
#include "line/telemetry/Readings.h"

namespace scope {

constexpr size_t TransferSize = 65536;  // bytes that the page can hand over at once

// How long a recording goes on after its last character, in us: the silence shows that the last frame is whole.
constexpr size_t EndUs = 3000;

// The buffer for them: bytes of a port, text of a recording.
alignas(8) extern uint8_t transfer[TransferSize];
inline std::string_view transferred(size_t count) { return {reinterpret_cast<const char *>(transfer), count}; }

// In a record's flags, which a frame does not use: it is in failsafe by its losses, not by its flag.
constexpr uint8_t FlagByLosses = 0x80;

// In the flags of a record: the condition becomes true there.
constexpr uint8_t FlagEvent = 0x10;

// In a frame's flags, which a frame does not use: see Values::hasNoPulses().
constexpr uint8_t FlagNoPulses = 0x20;

// In a row's flags: it has columns for failsafe and lost frame, or for CH17 and CH18.
constexpr uint8_t FlagHasFlags = 0x40;
constexpr uint8_t FlagHasSwitches = 0x20;

// The range by which raw values are scaled.
enum class Scale { FrSky, Futaba, Calibrated };

// Of a record. The first ones are those of line::Stretch.
enum class Kind : uint8_t {
  Frame,    // 16 channels and two switches
  Frame24,  // 24 channels
  Extra,    // header 2F: CH17..CH32
  NoFrame,  // bytes between frames
  Row,      // numbers that a board has printed
  Silence,  // nothing came, but a condition became true
};
static_assert(static_cast<int>(Kind::NoFrame) == static_cast<int>(line::Stretch::Kind::NoFrame), "others follow");

// A stretch of the line; the page reads it, by border.mjs.
struct Record {
  static constexpr size_t ChannelsMax = 32;
  static constexpr size_t BytesMax = sbus::FrameSize24;
  static constexpr size_t ReadingsMax = sbus::SlotCount + 1;  // see readingOf()

  double endUs;
  double beginUs;                // of its first character's start bit
  double lateUs;                 // it may have come this much earlier
  double damagedUs;              // when the first damaged bytes since the last frame came (Damage.h); 0: none
  double channels[ChannelsMax];  // of a frame: the newest values of all channels
  double readings[ReadingsMax];  // what sensors have measured within the last second, by readingOf(); NaN: nothing
  uint8_t kind;                  // Kind
  uint8_t flags;                 // as in a frame's flags byte; failsafe also by losses
  uint8_t channelCount;
  uint8_t readingCount;     // ReadingsMax, or 0 without any
  uint8_t size;             // bytes
  uint8_t slots;            // telemetry slots in it, if it is no frame
  uint8_t state;            // sbus::LinkState to show at its end
  uint8_t bytes[BytesMax];  // of the line
  char why[88];             // why it is no frame
};

// A condition that was read from a text.
struct ReadCondition {
  const char *error;  // "": it is good
  size_t errorAt;
  size_t errorLength;
  const line::Condition::Step *steps;  // for watchFor()
  size_t size;                         // of the steps, in bytes
};

// Returns the place of a quantity among a record's readings: its slot. The receiver has two in slot 0.
size_t readingOf(const line::Quantity &quantity);

class ShownLine {
 public:
  static constexpr size_t Enough = 256;  // records: the page takes them away before there are more

  ShownLine();

  void reset(uint64_t nowUs, const line::LineSettings &settings);
  void received(const uint8_t *bytes, size_t count, uint64_t nowUs);
  void receivedBad(uint64_t nowUs);
  // Takes all characters complete by `nowUs`; fewer if there are enough records, or if the recording needs its next
  // part.
  void advance(uint64_t nowUs);
  // Returns up to when the line is known: the PC may be late.
  uint64_t knownUs(uint64_t nowUs) const;
  // Returns the line's newest time: it stands still while a recording does.
  uint64_t nowUs() const { return _turnUs; }
  // Forgets what was found: only what comes from now on counts.
  void mark();
  // Returns the state of the link to show.
  sbus::LinkState state(uint64_t nowUs) {
    return rows.recognised() ? rows.heldState(nowUs) : observer.heldState(nowUs);
  }
  // Marks the records from now on at which a condition becomes true.
  void watchFor(std::optional<line::Condition> condition);
  // Returns when the newest character was complete; 0 before the first.
  uint64_t characterUs() const { return _characterUs; }
  // Returns how many reads were 0.1 s late or more: the PC was busy.
  unsigned lateReads() const { return _lateReads; }
  // Hands over once more what the page shows of the line: the newest records, and the newest that is a frame or a row.
  void recall();
  // Begins a recording, from the last advance() on; or ends it.
  void record(bool on);

  line::Observer observer;
  line::SensorsBySlot sensors = {{uint8_t{0}, line::sensorOf("receiver")}};
  line::Readings readings;
  line::Examination examination;  // of what came since the port was opened, or since mark()
  VerdictOfSecond verdict;
  BoardRows rows;                            // of a port that carries text
  line::LineSettings settings;               // of the port, or of a recording
  std::unique_ptr<SimulatedLine> simulated;  // at most one of the two; none for a port, which the browser reads
  std::unique_ptr<FedLine> played;
  std::vector<Record> records;
  line::RecordingWriter recorder;

 private:
  void takeReads(uint64_t nowUs);
  void put(const line::Character &character, uint64_t readUs);
  void take(const line::Stretch &stretch);
  void add(const Record &record);
  void takeRow(uint64_t nowUs, uint64_t lateUs);
  bool happens(uint64_t nowUs);

  static constexpr size_t Shown = 8;  // records

  std::deque<Record> _lately;
  std::optional<Record> _newest;  // frame or row
  line::PortReads _reads;         // of a port
  StalledReads _stalled;          // of a port
  Damage _damage;
  std::optional<line::Condition> _condition;
  bool _isRecording = false;
  uint64_t _recordedUs = 0;  // from when on
  bool _holds = false;       // the condition
  bool _isRejected = false;  // the newest stretch
  uint64_t _characterUs = 0;
  unsigned _lateReads = 0;
  uint32_t _lateUs = 0;  // of the newest character
  uint64_t _turnUs = 0;  // of the last picture
  // From one look at a port to the next, so that the browser hands over what has come meanwhile: after it was busy, its
  // timers come at once, perhaps before the reads.
  static constexpr uint64_t LookUs = 5000;
  uint64_t _lookUs = 0;
  bool _finished = false;  // the recording has ended: nothing waits any more
};

extern ShownLine shownLine;

}  // namespace scope

// A function that the page calls.
#define EXPORT(name) extern "C" __attribute__((export_name(#name))) auto name
