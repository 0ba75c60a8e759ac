#include "Diagnosis.h"

#include "Slots.h"

namespace sbus {

namespace {

constexpr uint32_t ImpairedSize = FrameSize - 1;  // bytes: mostly one character is missing
constexpr uint32_t ImpairedPart = 100;            // more than 1/100 of the frames, and one more, impaired: noise
constexpr uint32_t LossyPart = 10;                // more than 1/10 lost: lossy
constexpr uint32_t NoRadioPart = 2;               // more than 1/2 lost: no radio

uint32_t rejected(const Counters &counters) {
  return counters.rejectedByEnd + counters.rejectedByFlags + counters.rejectedByLength;
}

// Returns how many frames with header 2F are missing: FASSTest 26 sends one before each frame, and the first is never
// accepted. (A single one on another line is noise.)
uint32_t missingExtraFrames(const Counters &counters) {
  const bool expected = counters.extraFrames > counters.frames / 2;
  return expected && counters.extraFrames + 1 < counters.frames ? counters.frames - 1 - counters.extraFrames : 0;
}

uint32_t framesOfEitherSize(const Counters &counters) {
  return counters.frames + counters.otherSizeFrames;
}

// By Finding.
struct Words {
  const char *text;
  const char *remedy;
};
constexpr Words WordsOf[] = {
    {"No signal: not a byte with any setting.",
     "Check wire, pin and receiver: is it powered and bound, and its port set to S.Bus, not CPPM?"},
    {"No frames: bytes come, but few frames or none.",
     "Connect GND. Is it S.Bus? Is an inverter missing, or one too many? No nRF52 can do 100000 8E2."},
    {"24 channels: frames come, but of 24 channels, not of 16.",
     "Use DecodeSBus24 and the setting with the most bytes, or set the receiver to 16 channels."},
    {"Wrong polarity: frames come only with the other polarity.",
     "Open the port with the other polarity, or add or remove an inverter."},
    {"Wrong baud rate: frames come only with the other baud rate.",
     "Open the port with the setting that has frames: Fast S.Bus has 200000 baud."},
    {"Wrong polarity and baud rate: frames come only with the others.",
     "Open the port with the setting that has frames: Fast S.Bus has 200000 baud."},
    {"Polled too seldom: the port's buffer overflows.",
     "Poll the port at least every 5 ms, at 200000 baud every 2.5 ms."},
    {"Interrupts off: the port lost bytes meanwhile.",
     "Write flash or EEPROM, and update long LED strips, only while frames may be missed."},
    {"Noise: frames are damaged.", "Connect the grounds, check the supply, shorten the wire."},
    {"Failsafe: the receiver works, but has lost the link.", "Switch the radio on, or bind them."},
    {"No radio: the receiver works, but hears nothing.", "Switch the radio on, or bind them."},
    {"Lossy: the receiver works, but misses radio frames.", "Check distance and aerials."},
    {"All well, and other bytes come between the frames.",
     "No fault: telemetry (S.BUS2), or the tail that some Futaba receivers send after a frame."},
    {"All well.", "Nothing to do."},
};
static_assert(sizeof WordsOf / sizeof WordsOf[0] == static_cast<uint8_t>(Finding::AllWell) + 1,
              "a row for each finding");

}  // namespace

const char *text(Finding finding) {
  return WordsOf[static_cast<uint8_t>(finding)].text;
}

const char *remedy(Finding finding) {
  return WordsOf[static_cast<uint8_t>(finding)].remedy;
}

uint32_t impairedFrames(const Counters &counters) {
  if (counters.resyncs == 0) {
    return 0;
  }
  const uint32_t discarded = (counters.discardedBytes + ImpairedSize / 2) / ImpairedSize;
  const uint32_t headers = rejected(counters);
  return (discarded < headers ? discarded : headers) + missingExtraFrames(counters);
}

void Diagnosis::add(const Trial &trial) {
  if (_count == 0) {
    _meantBaud = trial.baud;
    _meantInverted = trial.inverted;
  }
  if (_count == 0 || framesOfEitherSize(trial.counters) > framesOfEitherSize(seen())) {
    _trial = trial;
    _best = _count;
  }
  _anyByte = _anyByte || trial.counters.frames != 0 || trial.counters.discardedBytes != 0;
  _count++;
}

// The setting is judged first, by whether frames come, then the line, and last the flags, if the frames are intact.
Finding Diagnosis::finding() const {
  const Counters &counters = seen();
  const bool framesCome = counters.frames * PeriodMax > _trial.ms;
  const bool otherPolarity = _trial.inverted != _meantInverted;
  const bool otherBaud = _trial.baud != _meantBaud;
  if (!_anyByte) {
    return Finding::NoSignal;
  }
  if (framesCome && otherPolarity) {
    return otherBaud ? Finding::WrongPolarityAndBaud : Finding::WrongPolarity;
  }
  if (framesCome && otherBaud) {
    return Finding::WrongBaud;
  }
  if (counters.overflows != 0) {
    return Finding::PolledTooSeldom;
  }
  if (counters.shortfalls != 0) {
    return Finding::InterruptsOff;
  }
  if (!framesCome) {
    // Of 55 frames 54 are recognised by their size, and 45 with 30 disturbances a second; in a wrong setting at most
    // one, and 3 on a line of 16 channels with 3000.
    return counters.otherSizeFrames * PeriodMax > _trial.ms ? Finding::Channels24 : Finding::NoFrames;
  }
  const uint32_t damaged = impairedFrames(counters);
  if (damaged > 1 + counters.frames / ImpairedPart) {
    return Finding::Noise;
  }
  if (counters.discardedBytes > (counters.frames + 1) * GroupSizeMax) {
    return Finding::NoFrames;
  }
  if (counters.failsafeFrames != 0) {
    return Finding::Failsafe;
  }
  if (counters.lostFrames > counters.frames / NoRadioPart) {
    return Finding::NoRadio;
  }
  if (counters.lostFrames > counters.frames / LossyPart) {
    return Finding::Lossy;
  }
  // The first bytes may be the end of a frame.
  const bool more = damaged == 0 && counters.discardedBytes >= counters.frames + FrameSize;
  return more ? Finding::AllWellAndMore : Finding::AllWell;
}

}  // namespace sbus
