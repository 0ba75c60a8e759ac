#include "Diagnosis.h"

#include "Frame.h"

namespace sbus {

namespace {

// In the order of Finding: what it is, and what to do.
const char Words[] SBUS_FLASH =
    "No signal: not a byte with any setting.\0"
    "Check wire, pin and receiver: is it powered and bound, and its port set to S.Bus, not CPPM?\0"
    "Not S.Bus: the receiver sends i-BUS, FlySky's protocol.\0"
    "Set the receiver's output to S.BUS on the radio: RX setup, output mode.\0"
    "Not S.Bus: the receiver sends CRSF, the protocol of ExpressLRS, mLRS and Crossfire.\0"
    "Set the receiver's serial protocol to SBUS, with its web page or the radio's Lua script.\0"
    "Not S.Bus: the receiver sends F.Port, FrSky's protocol.\0"
    "Choose S.Bus in the receiver's options, or give it FrSky's firmware for S.Bus.\0"
    "Not S.Bus: the receiver sends SUMD, Graupner's protocol.\0"
    "Set the receiver's serial output to S.Bus, if it has one, or use another receiver.\0"
    "Not S.Bus: the receiver sends Spektrum's satellite protocol.\0"
    "Use a receiver with an S.Bus output.\0"
    "Not S.Bus: the receiver sends DBUS, the protocol of DJI and RoboMaster.\0"
    "Use a receiver with an S.Bus output, or a library for DBUS: 18 bytes, 100000 baud, 8E1.\0"
    "No parity: the sender has 8N1 or 8N2; S.Bus has 8E2.\0"
    "Open the sender's port with even parity and two stop bits: SERIAL_8E2.\0"
    "Wrong idle level: between frames the line has the level of a start bit.\0"
    "Mend the sender: between frames S.Bus rests at the level of a stop bit, 0 V.\0"
    "No frames: bytes come, but few frames or none.\0"
    "Connect GND. Is it S.Bus? Is an inverter missing, or one too many?\0"
    "Wrong packets: all have one length, but they do not have the form of a frame.\0"
    "Is it S.Bus? A frame has 25 bytes: header 0F, 22 with the channels, flags, end byte 00.\0"
    "24 channels: frames come, but of 24 channels, not of 16.\0"
    "Use DecodeSBus24 and the setting with the most bytes, or set the receiver to 16 channels.\0"
    "Wrong polarity: frames come only with the other polarity.\0"
    "Open the port with the other polarity, or add or remove an inverter.\0"
    "Wrong baud rate: frames come only with the other baud rate.\0"
    "Open the port with the setting that has frames: Fast S.Bus has 200000 baud.\0"
    "Wrong polarity and baud rate: frames come only with the others.\0"
    "Open the port with the setting that has frames: Fast S.Bus has 200000 baud.\0"
    "Polled too seldom: the port's buffer overflows.\0"
    "Poll the port at least every 5 ms, at 200000 baud every 2.5 ms.\0"
    "Interrupts off: the port lost bytes meanwhile.\0"
    "Write flash or EEPROM, and update long LED strips, only while frames may be missed.\0"
    "Wrong flags: frames come, but bits 4 to 7 of the flags are set.\0"
    "Mend the sender: bit 0 is CH17, 1 is CH18, 2 frame lost, 3 failsafe; 4 to 7 are 0.\0"
    "Noise: frames are damaged.\0"
    "Connect the grounds, check the supply, shorten the wire.\0"
    "Seven data bits: frames come, but not a byte has bit 7, and so channels are wrong.\0"
    "Open the port with 8 data bits (8E2), and without stripping: stty cs8 -istrip.\0"
    "No pulses: CH1 to CH4 are 0 without a flag. The receiver has lost the radio.\0"
    "Use DecodeSBusNoPulses. Set the receiver's failsafe to Hold or Custom, not to No Pulses.\0"
    "Failsafe: the receiver works, but has lost the link.\0"
    "Switch the radio on, or bind them.\0"
    "No radio: the receiver works, but hears nothing.\0"
    "Switch the radio on, or bind them.\0"
    "Lost in turn: the lost-frame flag comes and goes at a steady rhythm.\0"
    "Choose a higher packet rate: the radio sends fewer packets than the receiver frames.\0"
    "Lossy: the receiver works, but misses radio frames.\0"
    "Check distance and aerials.\0"
    "Long period: the link is stale between frames, or once one is missing.\0"
    "Call setTimeout() with three periods, or set the receiver to a shorter period.\0"
    "All well, and other bytes come between the frames.\0"
    "No fault: telemetry (S.BUS2), or the tail that some Futaba receivers send after a frame.\0"
    "All well.\0"
    "Nothing to do.\0";

constexpr uint32_t ImpairedSize = FrameSize - 1;  // bytes: mostly one character is missing
constexpr uint32_t ImpairedPart = 100;            // more than 1/100 of the frames, and one more, impaired: noise
constexpr uint32_t OtherSizeMax = 8;              // frames of the other size may come beside these
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

// Returns true if little else comes between the frames.
bool areFrames(const Counters &counters) { return counters.discardedBytes <= (counters.frames + 1) * GroupSizeMax; }

// Returns true if the frames come seldom: at that period they fill half of the time or more.
bool isLongPeriod(const Trial &trial) {
  const uint32_t period = trial.counters.period / 1000;
  return period >= Diagnosis::PeriodLong && trial.counters.frames * period >= trial.ms / 2 && areFrames(trial.counters);
}

// Returns the fault to name of two: bytes from a wrong setting may look like IdleLevel.
Finding firstOf(Finding a, Finding b) { return a == Finding::NoSignal || (b != Finding::NoSignal && b < a) ? b : a; }

uint32_t framesOfEitherSize(const Counters &counters) { return counters.frames + counters.otherSizeFrames; }

}  // namespace

Text text(Finding finding) { return textOf(Words, 2 * static_cast<uint8_t>(finding)); }

Text remedy(Finding finding) { return textOf(Words, 2 * static_cast<uint8_t>(finding) + 1); }

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
  _other = trial.other == Finding::IdleLevel && _count != 0 ? _other : firstOf(_other, trial.other);
  _anyByte = _anyByte || trial.counters.frames != 0 || trial.counters.discardedBytes != 0;
  _count++;
}

// The setting is judged first, by whether frames come, then the line, and last the flags, if the frames are intact.
Finding Diagnosis::finding() const {
  const Counters &counters = seen();
  const bool isSlow = isLongPeriod(_trial);
  const bool framesCome = counters.frames * PeriodMax > _trial.ms || isSlow;
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
  if (!framesCome && _other != Finding::NoSignal && _other <= Finding::IdleLevel) {
    return _other;
  }
  if (counters.overflows != 0) {
    return Finding::PolledTooSeldom;
  }
  if (counters.shortfalls != 0) {
    return Finding::InterruptsOff;
  }
  // Of 55 frames 54 are recognised by their size, and 45 with 30 disturbances a second; in a wrong setting at most one,
  // and 3 on a line of 16 channels with 3000. A line may also change from one size to the other.
  const uint32_t byChance = framesCome ? OtherSizeMax + counters.frames / ImpairedPart : _trial.ms / PeriodMax;
  if (counters.otherSizeFrames > byChance) {
    return Finding::Channels24;
  }
  const bool areWrong = _other == Finding::WrongPackets || _other == Finding::UnusedFlags;
  if (!framesCome) {
    return areWrong ? _other : Finding::NoFrames;
  }
  const uint32_t damaged = impairedFrames(counters);
  if (damaged > 1 + counters.frames / ImpairedPart) {
    return areWrong ? _other : Finding::Noise;
  }
  if (!areFrames(counters)) {
    return areWrong ? _other : Finding::NoFrames;
  }
  if (_other == Finding::SevenBits) {
    return _other;
  }
  if (_trial.pulseless != 0) {
    return Finding::NoPulses;
  }
  if (counters.failsafeFrames != 0) {
    return Finding::Failsafe;
  }
  if (_other == Finding::LostInTurn && counters.lostFrames > counters.frames / LossyPart) {
    return _other;
  }
  if (counters.lostFrames > counters.frames / NoRadioPart) {
    return Finding::NoRadio;
  }
  if (counters.lostFrames > counters.frames / LossyPart) {
    return Finding::Lossy;
  }
  if (isSlow) {
    return Finding::LongPeriod;
  }
  // The first bytes may be the end of a frame.
  const bool more = damaged == 0 && counters.discardedBytes >= counters.frames + FrameSize;
  return more ? Finding::AllWellAndMore : Finding::AllWell;
}

}  // namespace sbus
