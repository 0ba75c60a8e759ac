#include "Expected.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "sbus/Scaling.h"

namespace mega {

namespace {

constexpr uint64_t TimeoutUs = 100000;
constexpr uint64_t BusyUs = 2000;  // a loop() that prints takes so long at most
constexpr double PeriodUs = 9000;  // of the frames that Mixer sends
constexpr double LatestUs = 1500;  // for each of them
constexpr double PulsePeriodUs = 20000;
constexpr double RowTolerance = 0.0006;  // three decimals are printed
constexpr double PulseTolerance = 1;     // us: half of one is the stand-in's, the rest its interrupt's

template <typename Scale>
Numbers scaled(const Channels &channels, size_t count, Scale scale) {
  Numbers numbers;
  for (size_t i = 0; i < count; i++) {
    numbers.push_back(scale(channels[i]));
  }
  return numbers;
}

Numbers decodeSBus(const SeenFrame &frame, bool stale, const sbus::Calibration &) {
  if (stale || frame.number == 0) {
    return {};
  }
  Numbers numbers(frame.channels.begin(), frame.channels.begin() + 4);
  numbers.push_back(frame.failsafe);
  numbers.push_back(frame.lostFrame);
  return numbers;
}

Numbers allChannels(const SeenFrame &frame, bool stale, const sbus::Calibration &) {
  return stale || frame.number == 0 ? Numbers() : Numbers(frame.channels.begin(), frame.channels.end());
}

Numbers normalized(const SeenFrame &frame, bool stale, const sbus::Calibration &) {
  return scaled(frame.channels, stale || frame.number == 0 ? 0 : 4,
                [](uint16_t raw) { return sbus::toUnit(raw, sbus::FrSky); });
}

Numbers calibrate(const SeenFrame &frame, bool stale, const sbus::Calibration &calibration) {
  if (stale || frame.number == 0 || stateOf(calibration) != sbus::StoredState::Good) {
    return {};
  }
  const sbus::CalibratedChannel *channel = calibration.channels;
  return scaled(frame.channels, 4, [&channel](uint16_t raw) { return (channel++)->toNormalised(raw); });
}

Numbers servos(const SeenFrame &frame, bool stale, const sbus::Calibration &) {
  Numbers pulses = scaled(frame.held, 4, [](uint16_t raw) {
    return sbus::limited(sbus::toMicroseconds(raw, sbus::FrSky), sbus::LowPulse, sbus::HighPulse);
  });
  if (frame.failsafe || stale) {
    pulses[2] = sbus::LowPulse;
  }
  return pulses;
}

Numbers mixer(const SeenFrame &frame, bool, const sbus::Calibration &) {
  if (frame.number == 0) {
    return {};
  }
  Numbers row = scaled(frame.channels, 2, [](uint16_t raw) { return sbus::toNormalised(raw, sbus::FrSky); });
  row.push_back(std::clamp(row[1] + row[0], -1000.0, 1000.0));
  row.push_back(std::clamp(row[1] - row[0], -1000.0, 1000.0));
  return row;
}

Numbers numbersOf(const Frame &frame) {
  const Channels channels = readBitByBit(frame);
  Numbers numbers(channels.begin(), channels.end());
  for (const int byte : {frame[23] & 0xFC, int{frame[0]}, int{frame[24]}}) {
    numbers.push_back(byte);
  }
  return numbers;
}

Numbers mixerSends(const SeenFrame &frame, bool stale, const sbus::Calibration &calibration) {
  const Numbers row = mixer(frame, stale, calibration);
  if (row.empty()) {
    return {};
  }
  Channels channels = frame.channels;
  for (size_t i = 0; i < 2; i++) {
    channels[i] = sbus::fromNormalised(static_cast<int16_t>(row[2 + i]), sbus::FrSky);
  }
  channels[2] = stale ? sbus::FrSky.low : channels[2];
  Frame out = writeBitByBit(channels);
  out[23] = static_cast<uint8_t>(out[23] | (frame.lostFrame || stale ? 4 : 0) | (frame.failsafe || stale ? 8 : 0));
  return numbersOf(out);
}

Numbers counters(const SeenFrame &frame, bool, const sbus::Calibration &) {
  return {static_cast<double>(frame.number), static_cast<double>(frame.others)};
}

struct Sketch {
  const char *name;
  Rule row;
  Rule sending;
};
constexpr Sketch Sketches[] = {
    {"DecodeSBus", decodeSBus, nullptr}, {"AllChannels", allChannels, nullptr}, {"Normalized", normalized, nullptr},
    {"Calibrate", calibrate, nullptr},   {"Servos", servos, nullptr},           {"Mixer", mixer, mixerSends},
    {"Counters", counters, nullptr},
};

// Without end: it holds something that is no number.
Numbers parse(const std::string &line) {
  Numbers numbers;
  const char *next = line.c_str();
  char *end = nullptr;
  do {
    numbers.push_back(std::strtod(next, &end));
    if (end == next) {
      return {};
    }
    next = end + 1;
  } while (*end == ',');
  return *end == '\r' ? numbers : Numbers();
}

std::string text(const Numbers &numbers) {
  std::string all;
  for (const double number : numbers) {
    char each[32];
    std::snprintf(each, sizeof each, "%s%g", all.empty() ? "" : ",", number);
    all += each;
  }
  return all.empty() ? "nothing" : all;
}

bool same(const Numbers &left, const Numbers &right, double tolerance) {
  return left.size() == right.size() && !left.empty() &&
         std::equal(left.begin(), left.end(), right.begin(),
                    [tolerance](double a, double b) { return std::abs(a - b) <= tolerance; });
}

// Before the first frame the library says failsafe.
SeenFrame noFrame() {
  SeenFrame frame = {{}, {}, true, false, 0, 0};
  frame.held.fill(sbus::FrSky.centre);
  return frame;
}

}  // namespace

Expected::Expected(const std::string &sketch, Mega &mega, Eeprom &eeprom)
    : _mega(mega),
      _eeprom(eeprom),
      _hasPulses(sketch == "Servos"),
      _hasWords(sketch == "Calibrate" || sketch == "Counters"),
      _newest(noFrame()),
      _before(noFrame()) {
  for (const Sketch &each : Sketches) {
    if (sketch == each.name) {
      _row = each.row;
      _sending = each.sending;
    }
  }
}

void Expected::frame(const Frame &frame, unsigned long others) {
  const bool isWhole = frame[0] == 0x0F && (frame[23] & 0xF0) == 0 && (frame[24] == 0 || (frame[24] & 0xCF) == 4);
  if (!isWhole) {
    return;
  }
  _before = _newest;
  _newestUs = _mega.clockUs();
  const Channels channels = readBitByBit(frame);
  const bool failsafe = (frame[23] & 8) != 0;
  _newest = {channels, failsafe ? _before.held : channels, failsafe, (frame[23] & 4) != 0, _before.number + 1, others};
}

Expected::Candidates Expected::candidates(Rule rule) const {
  const uint64_t age = _mega.clockUs() - _newestUs;
  const sbus::Calibration calibration = _eeprom.calibration();
  Candidates all;
  for (const SeenFrame &frame : {_newest, _before}) {
    if (age < TimeoutUs + BusyUs) {
      all.push_back(rule(frame, false, calibration));
    }
    if (age >= TimeoutUs) {
      all.push_back(rule(frame, true, calibration));
    }
  }
  return all;
}

void Expected::printed(char character) {
  if (_row == nullptr) {
    return;
  }
  if (_line.empty()) {
    _rows = candidates(_row);
  }
  if (character != '\n') {
    _line += character;
    return;
  }
  if (!_hasWords || std::isalpha(static_cast<unsigned char>(_line[0])) == 0) {
    check("row", parse(_line), _rows, RowTolerance);
    _rowCount++;
  }
  _line.clear();
}

void Expected::sent(uint8_t byte) {
  if (_sending == nullptr) {
    return;
  }
  if (_frameSize == 0) {
    const double us = static_cast<double>(_mega.clockUs());
    _frames = candidates(_sending);
    _firstSentUs = _sentCount == 0 ? us : _firstSentUs;
    checkTime("sent frame's time", us - _firstSentUs - PeriodUs * static_cast<double>(_sentCount), -50, LatestUs);
    _sentCount++;
  }
  _frame[_frameSize++] = byte;
  if (_frameSize == _frame.size()) {
    _frameSize = 0;
    check("sent frame", numbersOf(_frame), _frames, 0);
  }
}

void Expected::pulseBegins(unsigned channel) {
  if (!_hasPulses) {
    return;
  }
  _pulses[channel] = candidates(_row);
  if (channel == 0) {
    const double us = static_cast<double>(_mega.clockUs());
    if (_pulseCounts[0] > 0) {
      checkTime("pulse's time", us - _lastPulseUs - PulsePeriodUs, -1, 1);
    }
    _lastPulseUs = us;
  }
}

void Expected::pulseEnds(unsigned channel, double widthUs) {
  if (!_hasPulses) {
    return;
  }
  for (Numbers &candidate : _pulses[channel]) {
    candidate = {candidate[channel]};
  }
  check("pulse", {widthUs}, _pulses[channel], PulseTolerance);
  _pulseCounts[channel]++;
}

void Expected::check(const char *what, const Numbers &found, const Candidates &candidates, double tolerance) {
  for (const Numbers &candidate : candidates) {
    if (same(found, candidate, tolerance)) {
      return;
    }
  }
  std::string mistake = std::to_string(_mega.clockUs()) + " us: " + what + " " + text(found);
  for (const Numbers &candidate : candidates) {
    mistake += (&candidate == &candidates[0] ? ", expected " : " or ") + text(candidate);
  }
  _mistakes.push_back(mistake);
}

void Expected::checkTime(const char *what, double us, double least, double most) {
  if (us < least || us > most) {
    check(what, {us}, {}, 0);
  }
}

bool Expected::report() const {
  std::fprintf(stderr, "rows: %lu\nsent: %lu\npulses: %lu\n", _rowCount, _sentCount,
               *std::min_element(_pulseCounts, _pulseCounts + 4));
  for (const std::string &mistake : _mistakes) {
    std::fprintf(stderr, "wrong at %s\n", mistake.c_str());
  }
  return _mistakes.empty();
}

}  // namespace mega
