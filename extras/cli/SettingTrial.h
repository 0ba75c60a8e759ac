// What a port with one setting receives from a line, for `sbus doctor`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/Input.h"
#include "cli/Json.h"
#include "line/Examination.h"
#include "line/Observer.h"
#include "line/recording/CsvRows.h"
#include "line/report/FlagSpans.h"
#include "line/telemetry/Readings.h"

namespace tool {

class SettingTrial {
 public:
  static constexpr uint64_t ToItsEnd = UINT64_MAX;

  explicit SettingTrial(const line::LineSettings &settings);
  SettingTrial(const SettingTrial &) = delete;  // its observer's listener points to it
  SettingTrial &operator=(const SettingTrial &) = delete;

  // Listens for `us`, or for `framesUs` if there are frames. ToItsEnd: until the source ends.
  void listen(Input &input, uint64_t us, uint64_t framesUs);

  bool isCsv() const { return _isCsv; }
  bool hasFrames() const {
    sbus::Diagnosis diagnosis;
    diagnosis.add(trial());
    return uint64_t{counters().frames} * sbus::Diagnosis::PeriodMax > trial().ms ||
           diagnosis.finding() > sbus::Finding::InterruptsOff;  // they come seldom
  }
  sbus::Trial trial() const { return _examination.trial(_observer, _settings, _endUs); }

  // Returns "S.BUS", "S.BUS2" ...; empty without frames.
  std::string variant() const { return _observer.variant().text(); }

  // Returns a line: "100000 baud, 8E2, inverted: 55 frames, 0 discarded bytes".
  std::string text() const;

  // Returns Observer::packets() as a line; empty without them.
  std::string packets() const { return _observer.packets().empty() ? "" : _observer.packets() + "\n"; }

  Json json(bool hasTimes) const;

  // Returns a line: "S.BUS: 111 frames a second and 0 damaged, frame interval 9000 us; 1 % with the lost-frame flag".
  // All figures come from the times of the frames: a single frame has no rate, and without `hasTimes` there are none.
  std::string figures(bool hasTimes) const;

  // Returns a line: "Telemetry: receiver voltage 4.6 V; slots 0, 1; 3 of 40 groups rejected: ..."; empty without slots.
  std::string telemetry() const;

  // Returns true if more groups of telemetry slots were rejected than read.
  bool rejectsTelemetry() const { return _observer.telemetry().rejectedGroups() > _observer.telemetry().groups(); }

  // Returns true if the line was silent for 0.5 s in all, in silences of 0.1 s and of 2.5 periods or more. Late reads
  // by a busy PC do not count as silence.
  bool isInterrupted() const { return silentUs(&Silence::provedUs) >= 500000; }

  // Returns, in a sentence, when bytes came but no frame, or that the line went silent, for 0.3 s in all; otherwise "".
  std::string framesInPart() const;

  // See Observer.
  unsigned long readAtBaud() const { return _observer.readAtBaud(); }

  // Returns how many frames had a channel that jumped: line::Jumps.
  uint32_t jumps() const { return _observer.jumps(); }

  // Returns the frame period in ms; 0 if it is not known.
  unsigned periodMs() const;

  // Returns a line that explains why this source's times are not exact; empty if they are.
  std::string note() const { return _note.empty() ? "" : _note + "\n"; }

 private:
  struct Silence {
    uint64_t beginUs;
    uint64_t us;
    uint64_t provedUs;  // without what a late read may hide
  };

  void take(const line::Stretch &stretch);
  void heardUntil(uint64_t us, uint64_t lateUs = 0);
  uint64_t silenceUs() const;
  uint64_t silentUs(uint64_t Silence::*us) const;
  std::vector<uint64_t> periods() const;
  uint64_t usualPeriodUs(const std::vector<uint64_t> &periods, uint64_t us) const;
  uint64_t gapUs() const;
  sbus::Counters counters() const { return _observer.counters(); }

  const line::LineSettings _settings;
  line::Observer _observer;
  line::Examination _examination;
  line::Readings _readings;
  std::vector<uint64_t> _ends;  // of the frames, in us
  line::FlagSpans _spans;
  std::vector<Silence> _silences;
  line::CsvRows _rows;
  bool _isCsv = false;
  uint64_t _lastUs = 0;  // the newest character's end
  uint64_t _endUs = 0;   // the end of listening
  uint32_t _lateUs = 0;  // how late the port delivers bytes, at most
  std::string _note;
};

}  // namespace tool
