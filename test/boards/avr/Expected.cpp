#include "Expected.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <sstream>

#include <doctest/doctest.h>

#include "line/Source.h"
#include "sbus/Scaling.h"

namespace avr {

namespace {

constexpr uint64_t TooOldUs = 1000;  // an age counts from four characters before the last poll without the frame
constexpr uint64_t TimeoutUs = 100000;
constexpr uint64_t BusyUs = 2000;  // the longest loop() that prints
constexpr uint64_t FrameUs = sbus::FrameSize * line::CharacterUs;

bool isUsable(const SeenFrame &frame) { return frame.number != 0 && !frame.stale; }

template <typename Scale>
Numbers scaled(const Channels &channels, size_t count, Scale scale) {
  Numbers numbers(count);
  std::transform(channels.begin(), channels.begin() + static_cast<std::ptrdiff_t>(count), numbers.begin(), scale);
  return numbers;
}

bool isWhole(const Frame &frame) {
  return frame[0] == 0x0F && (frame[23] & 0xF0) == 0 && (frame[24] == 0 || (frame[24] & 0xCF) == 4);
}

std::string text(const Numbers &numbers) {
  std::ostringstream all;
  for (const double number : numbers) {
    all << (all.tellp() > 0 ? "," : "") << number;
  }
  return numbers.empty() ? "nothing" : all.str();
}

bool same(const Numbers &left, const Numbers &right, double tolerance) {
  return !left.empty() && std::equal(left.begin(), left.end(), right.begin(), right.end(),
                                     [=](double a, double b) { return std::abs(a - b) <= tolerance; });
}

}  // namespace

Line lineOf(const std::string &name) {
  line::Source source;
  source.silent = name == "silent";
  source.sticks = name == "calibration" ? line::Sticks::Calibration : line::Sticks::Flight;
  source.noise = name == "noisy" ? 20 : 0;
  if (name != "flight" && name != "cut" && name != "noisy" && name != "calibration" && name != "silent" &&
      name != "wire") {
    source.name = "../../recordings/" + name + ".txt";
  }
  Line line;
  line.source = name == "wire" ? nullptr : source.open();
  line.cutUs = name == "cut" ? 2000000 : line.cutUs;
  return line;
}

Numbers decodeSBus(const SeenFrame &frame) {
  Numbers numbers = allChannels(frame);
  if (!numbers.empty()) {
    numbers.resize(4);
    numbers.push_back(frame.failsafe);
    numbers.push_back(frame.lostFrame);
  }
  return numbers;
}

Numbers allChannels(const SeenFrame &frame) {
  return isUsable(frame) ? Numbers(frame.channels.begin(), frame.channels.end()) : Numbers();
}

Numbers normalized(const SeenFrame &frame) {
  return scaled(frame.channels, isUsable(frame) ? 4 : 0, [](uint16_t raw) { return sbus::toUnit(raw, sbus::FrSky); });
}

Rule calibrated(const sbus::Calibration &calibration) {
  return [calibration](const SeenFrame &frame) {
    const sbus::CalibratedChannel *channel = calibration.channels;
    return scaled(frame.channels, isUsable(frame) ? 4 : 0,
                  [&channel](uint16_t raw) { return (channel++)->toNormalized(raw); });
  };
}

Numbers servos(const SeenFrame &frame) {
  Numbers pulses = scaled(frame.held, 4, [](uint16_t raw) {
    return sbus::limited(sbus::toMicroseconds(raw, sbus::FrSky), sbus::LowPulse, sbus::HighPulse);
  });
  if (frame.failsafe || frame.stale) {
    pulses[2] = sbus::LowPulse;
  }
  return pulses;
}

Numbers mixer(const SeenFrame &frame) {
  if (frame.number == 0) {
    return {};
  }
  Numbers row = scaled(frame.channels, 2, [](uint16_t raw) { return sbus::toNormalized(raw, sbus::FrSky); });
  row.push_back(std::clamp(row[1] + row[0], -1000.0, 1000.0));
  row.push_back(std::clamp(row[1] - row[0], -1000.0, 1000.0));
  return row;
}

Numbers mixerSends(const SeenFrame &frame) {
  const Numbers row = mixer(frame);
  if (row.empty()) {
    return {};
  }
  Channels channels = frame.channels;
  channels[0] = sbus::fromNormalized(static_cast<int16_t>(row[2]), sbus::FrSky);
  channels[1] = sbus::fromNormalized(static_cast<int16_t>(row[3]), sbus::FrSky);
  channels[2] = frame.stale ? sbus::FrSky.low : channels[2];
  Frame out = writeBitByBit(channels);
  out[23] = static_cast<uint8_t>(out[23] | (frame.lostFrame || frame.stale ? 4 : 0) |
                                 (frame.failsafe || frame.stale ? 8 : 0));
  return numbersOf(out);
}

Numbers counters(const SeenFrame &frame) {
  return {static_cast<double>(frame.number), static_cast<double>(frame.others)};
}

Numbers numbersOf(const Frame &frame) {
  const Channels channels = readBitByBit(frame);
  Numbers numbers(channels.begin(), channels.end());
  for (const int byte : {frame[23] & 0xFC, int{frame[0]}, int{frame[24]}}) {
    numbers.push_back(byte);
  }
  return numbers;
}

void figure(const std::string &what, const std::string &value) { MESSAGE("| ", what, " | ", value, " |"); }

std::string rounded(double value, int places) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(places) << value;
  return text.str();
}

Numbers numbersIn(const std::string &row) {
  Numbers numbers;
  const char *next = row.c_str();
  for (char *end = nullptr;; next = end + 1) {
    numbers.push_back(std::strtod(next, &end));
    if (end == next || (*end != ',' && *end != '\0')) {
      return {};
    }
    if (*end == '\0') {
      return numbers;
    }
  }
}

// The first 25 characters after a gap, if all are good, are a frame. Before the first one the library says failsafe.
Expected::Expected(const std::vector<line::Character> &characters) {
  SeenFrame none{};
  none.held.fill(sbus::FrSky.centre);
  none.failsafe = true;
  _frames.assign(2, none);
  Frame bytes{};
  size_t run = 0;  // characters since the last gap
  uint64_t lastUs = 0;
  unsigned good = 0;  // characters that no frame has taken
  bool isGood = true;
  for (const line::Character &character : characters) {
    if (character.endUs > lastUs + line::CharacterUs * 3 / 2) {
      run = 0;
      isGood = true;
    }
    lastUs = character.endUs;
    isGood = isGood && !character.bad;
    good += !character.bad;
    if (run < bytes.size()) {
      bytes[run] = character.value;
    }
    run++;
    if (run == bytes.size() && isGood && isWhole(bytes)) {
      good -= sbus::FrameSize;
      const SeenFrame &before = _frames.back();
      const Channels channels = readBitByBit(bytes);
      const bool failsafe = (bytes[23] & 8) != 0;
      _frames.push_back({character.endUs, channels, failsafe ? before.held : channels, failsafe, (bytes[23] & 4) != 0,
                         before.number + 1, good, false});
    }
  }
}

std::string Expected::wrong(uint64_t us, const Numbers &found, const Rule &rule, double tolerance) const {
  const auto isLater = [](uint64_t time, const SeenFrame &frame) { return time < frame.us; };
  const auto later = std::upper_bound(_frames.begin() + 2, _frames.end(), us, isLater);
  std::string mistake = std::to_string(us) + " us: " + text(found) + ", expected";
  for (SeenFrame frame : {later[-1], later[-2]}) {
    const uint64_t age = us - frame.us;
    for (const bool stale : {false, true}) {
      if (stale ? age + TooOldUs >= TimeoutUs : age < TimeoutUs + BusyUs) {
        frame.stale = stale;
        const Numbers candidate = rule(frame);
        if (same(found, candidate, tolerance)) {
          return {};
        }
        mistake += " or " + text(candidate);
      }
    }
  }
  return mistake;
}

unsigned Expected::count(uint64_t fromUs, uint64_t toUs) const {
  return static_cast<unsigned>(std::count_if(_frames.begin() + 2, _frames.end(), [=](const SeenFrame &frame) {
    return frame.us >= fromUs + FrameUs && frame.us <= toUs;
  }));
}

}  // namespace avr
