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

// Returns true if little else comes between the frames.
bool areFrames(const Counters &counters) {
  return counters.discardedBytes <= (counters.frames + 1) * GroupSizeMax;
}

// Returns true if the frames come seldom: at that period they fill half of the time or more.
bool isLongPeriod(const Trial &trial) {
  const uint32_t period = trial.counters.period / 1000;
  return period >= Diagnosis::PeriodLong && trial.counters.frames * period >= trial.ms / 2 && areFrames(trial.counters);
}

uint32_t framesOfEitherSize(const Counters &counters) {
  return counters.frames + counters.otherSizeFrames;
}

}  // namespace

Text text(Finding finding) {
  switch (finding) {
    case Finding::NoSignal:
      return SBUS_TEXT("No signal: not a byte with any setting.");
    case Finding::IBus:
      return SBUS_TEXT("Not S.Bus: the receiver sends i-BUS, FlySky's protocol.");
    case Finding::Crsf:
      return SBUS_TEXT("Not S.Bus: the receiver sends CRSF, the protocol of ExpressLRS, mLRS and Crossfire.");
    case Finding::FPort:
      return SBUS_TEXT("Not S.Bus: the receiver sends F.Port, FrSky's protocol.");
    case Finding::Sumd:
      return SBUS_TEXT("Not S.Bus: the receiver sends SUMD, Graupner's protocol.");
    case Finding::Spektrum:
      return SBUS_TEXT("Not S.Bus: the receiver sends Spektrum's satellite protocol.");
    case Finding::NoParity:
      return SBUS_TEXT("No parity: the sender has 8N1 or 8N2; S.Bus has 8E2.");
    case Finding::IdleLevel:
      return SBUS_TEXT("Wrong idle level: between frames the line has the level of a start bit.");
    case Finding::NoFrames:
      return SBUS_TEXT("No frames: bytes come, but few frames or none.");
    case Finding::Channels24:
      return SBUS_TEXT("24 channels: frames come, but of 24 channels, not of 16.");
    case Finding::WrongPolarity:
      return SBUS_TEXT("Wrong polarity: frames come only with the other polarity.");
    case Finding::WrongBaud:
      return SBUS_TEXT("Wrong baud rate: frames come only with the other baud rate.");
    case Finding::WrongPolarityAndBaud:
      return SBUS_TEXT("Wrong polarity and baud rate: frames come only with the others.");
    case Finding::PolledTooSeldom:
      return SBUS_TEXT("Polled too seldom: the port's buffer overflows.");
    case Finding::InterruptsOff:
      return SBUS_TEXT("Interrupts off: the port lost bytes meanwhile.");
    case Finding::Noise:
      return SBUS_TEXT("Noise: frames are damaged.");
    case Finding::NoPulses:
      return SBUS_TEXT("No pulses: CH1 to CH4 are 0 without a flag. The receiver has lost the radio.");
    case Finding::Failsafe:
      return SBUS_TEXT("Failsafe: the receiver works, but has lost the link.");
    case Finding::NoRadio:
      return SBUS_TEXT("No radio: the receiver works, but hears nothing.");
    case Finding::Lossy:
      return SBUS_TEXT("Lossy: the receiver works, but misses radio frames.");
    case Finding::LongPeriod:
      return SBUS_TEXT("Long period: the link is stale between frames, or once one is missing.");
    case Finding::AllWellAndMore:
      return SBUS_TEXT("All well, and other bytes come between the frames.");
    case Finding::AllWell:
      return SBUS_TEXT("All well.");
  }
  return SBUS_TEXT("");
}

Text remedy(Finding finding) {
  switch (finding) {
    case Finding::NoSignal:
      return SBUS_TEXT("Check wire, pin and receiver: is it powered and bound, and its port set to S.Bus, not CPPM?");
    case Finding::IBus:
      return SBUS_TEXT("Set the receiver's output to S.BUS on the radio: RX setup, output mode.");
    case Finding::Crsf:
      return SBUS_TEXT("Set the receiver's serial protocol to SBUS, with its web page or the radio's Lua script.");
    case Finding::FPort:
      return SBUS_TEXT("Choose S.Bus in the receiver's options, or give it FrSky's firmware for S.Bus.");
    case Finding::Sumd:
      return SBUS_TEXT("Set the receiver's serial output to S.Bus, if it has one, or use another receiver.");
    case Finding::Spektrum:
      return SBUS_TEXT("Use a receiver with an S.Bus output.");
    case Finding::NoParity:
      return SBUS_TEXT("Open the sender's port with even parity and two stop bits: SERIAL_8E2.");
    case Finding::IdleLevel:
      return SBUS_TEXT("Mend the sender: between frames S.Bus rests at the level of a stop bit, 0 V.");
    case Finding::NoFrames:
      return SBUS_TEXT("Connect GND. Is it S.Bus? Is an inverter missing, or one too many?");
    case Finding::Channels24:
      return SBUS_TEXT("Use DecodeSBus24 and the setting with the most bytes, or set the receiver to 16 channels.");
    case Finding::WrongPolarity:
      return SBUS_TEXT("Open the port with the other polarity, or add or remove an inverter.");
    case Finding::WrongBaud:
    case Finding::WrongPolarityAndBaud:
      return SBUS_TEXT("Open the port with the setting that has frames: Fast S.Bus has 200000 baud.");
    case Finding::PolledTooSeldom:
      return SBUS_TEXT("Poll the port at least every 5 ms, at 200000 baud every 2.5 ms.");
    case Finding::InterruptsOff:
      return SBUS_TEXT("Write flash or EEPROM, and update long LED strips, only while frames may be missed.");
    case Finding::Noise:
      return SBUS_TEXT("Connect the grounds, check the supply, shorten the wire.");
    case Finding::NoPulses:
      return SBUS_TEXT("Use DecodeSBusNoPulses. Set the receiver's failsafe to Hold or Custom, not to No Pulses.");
    case Finding::Failsafe:
    case Finding::NoRadio:
      return SBUS_TEXT("Switch the radio on, or bind them.");
    case Finding::Lossy:
      return SBUS_TEXT("Check distance and aerials.");
    case Finding::LongPeriod:
      return SBUS_TEXT("Call setTimeout() with three periods, or set the receiver to a shorter period.");
    case Finding::AllWellAndMore:
      return SBUS_TEXT("No fault: telemetry (S.BUS2), or the tail that some Futaba receivers send after a frame.");
    case Finding::AllWell:
      return SBUS_TEXT("Nothing to do.");
  }
  return SBUS_TEXT("");
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
  _other = trial.other != Finding::NoSignal ? trial.other : _other;
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
  if (!framesCome && _other != Finding::NoSignal) {
    return _other;
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
  if (!areFrames(counters)) {
    return Finding::NoFrames;
  }
  if (_trial.pulseless != 0) {
    return Finding::NoPulses;
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
  if (isSlow) {
    return Finding::LongPeriod;
  }
  // The first bytes may be the end of a frame.
  const bool more = damaged == 0 && counters.discardedBytes >= counters.frames + FrameSize;
  return more ? Finding::AllWellAndMore : Finding::AllWell;
}

}  // namespace sbus
