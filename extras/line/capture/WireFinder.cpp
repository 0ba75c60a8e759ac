#include "line/capture/WireFinder.h"

#include <algorithm>
#include <cmath>

#include "line/uart/Levels.h"
#include "line/Observer.h"

namespace line {

namespace {

constexpr double ShortestBitNs = 5000;
constexpr double BaudTolerance = 0.03;  // of the receiver's and the analyser's clocks together
constexpr int LongestPulse = 10;        // bits between two edges of a character: start bit, 00 and parity bit

// Returns the number of bits in a pulse; 0 if it is not a whole number.
int bitsOf(double pulseNs, double bitNs) {
  constexpr double Tolerance = 0.36;  // 3 % of 10 bits, plus sampling and slopes
  const double bits = std::round(pulseNs / bitNs);
  return bits >= 1 && bits <= LongestPulse && std::abs(pulseNs - bits * bitNs) <= Tolerance * bitNs
             ? static_cast<int>(bits)
             : 0;
}

// Returns the bit time near `bitNs` that fits the pulses best; 0 if nearly all last an even number of bits, and so are
// bits at half the speed. All high pulses may be longer than the low ones, if the threshold is not half way up the
// slopes: hence least squares over two unknowns.
double fit(const std::vector<Level> &levels, double bitNs) {
  double bits2 = 0, bitsSign = 0, bitsNs = 0, signNs = 0;
  int fitting = 0;
  int odd = 0;
  for (size_t i = 0; i + 1 < levels.size(); i++) {
    const double ns = static_cast<double>(levels[i + 1].ns - levels[i].ns);
    const int bits = bitsOf(ns, bitNs);
    if (bits == 0) {
      continue;  // idle, or a glitch
    }
    const double sign = levels[i].high ? 1 : -1;
    fitting++;
    odd += bits % 2;
    bits2 += bits * bits;
    bitsSign += bits * sign;
    bitsNs += bits * ns;
    signNs += sign * ns;
  }
  const double determinant = bits2 * fitting - bitsSign * bitsSign;
  if (fitting < 4 || odd < fitting / 8 || determinant <= 0) {
    return 0;
  }
  return (bitsNs * fitting - bitsSign * signNs) / determinant;
}

FoundWire judge(const std::vector<Level> &levels, const LineSettings &settings, double bitNs) {
  FoundWire wire;
  wire.settings = settings;
  wire.bitNs = bitNs;
  Observer observer;
  observer.reset(0, settings.characterUs());
  bool extra = false;
  observer.listen([&extra](const Stretch &stretch) { extra = extra || stretch.kind == Stretch::Kind::Extra; });
  CharacterDecoder decoder(settings, bitNs);
  WireCharacter character;
  unsigned early = 0;  // characters that begin within the second stop bit of the one before
  int64_t beforeNs = INT64_MIN / 2;
  const auto take = [&] {
    (character.bad() ? wire.bad : wire.good)++;
    early += static_cast<double>(character.startNs - beforeNs) < (settings.format.bits() - 0.5) * bitNs;
    beforeNs = character.startNs;
    observer.put(character.since(levels.front().ns, settings.format.bits() * bitNs));
  };
  for (const Level &level : levels) {
    if (decoder.level(level.ns, level.high, character)) {
      take();
    }
  }
  if (decoder.until(INT64_MAX / 2, character)) {
    take();
  }
  observer.idleUntil(static_cast<uint64_t>((levels.back().ns - levels.front().ns) / 1000) + EndSilenceUs);
  observer.finish();
  wire.settings.format.stopBits = 2 * early > wire.good + wire.bad ? 1 : settings.format.stopBits;
  wire.frames = observer.counters().frames;
  wire.channels = observer.has24() ? 24 : extra ? 32 : 16;
  wire.protocol = observer.otherProtocol();
  return wire;
}

// Returns the pulses in order of length, without the first, which began before the sample.
std::vector<int64_t> pulses(const std::vector<Level> &levels) {
  std::vector<int64_t> lengths;
  for (size_t i = 1; i + 1 < levels.size(); i++) {
    lengths.push_back(levels[i + 1].ns - levels[i].ns);
  }
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

// Returns the length of the shortest pulse that is not a glitch; 0 without pulses.
double shortest(const std::vector<int64_t> &lengths) {
  return lengths.empty() ? 0 : static_cast<double>(lengths[lengths.size() / 20]);
}

bool isOneBitLong(double ns) {
  constexpr double SampleNs = 1100;  // at 1 MHz, with a margin
  return std::abs(ns - ShortestBitNs) < SampleNs || std::abs(ns - 2 * ShortestBitNs) < SampleNs;
}

std::string microseconds(double ns) {
  const auto tenths = static_cast<unsigned long long>(std::llround(ns / 100));
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " us";
}

// Returns what pulses far longer than a bit are; "" for others.
std::string pulseTrain(const std::vector<Level> &levels, double shortestNs) {
  if (shortestNs < 100000 || shortestNs > 2500000) {
    return {};
  }
  size_t channels = 0;  // from one edge to the next of the same direction
  size_t frames = 0;
  for (size_t i = 1; i + 2 < levels.size(); i++) {
    const int64_t us = (levels[i + 2].ns - levels[i].ns) / 1000;
    channels += us >= 700 && us <= 2300;
    frames += us > 2300 && us < 30000;
  }
  const bool isTrain = channels + frames >= 4 && channels + frames + 3 >= levels.size();
  return !isTrain || frames == 0 ? ""
         : channels >= frames    ? "carries PPM: set the receiver's port to S.BUS, not to CPPM"
                                 : "carries a servo's pulses: use the receiver's S.BUS port, or set this one to S.BUS";
}

// Returns what another protocol is, and the remedy; "" without one.
std::string otherProtocol(const std::vector<Level> &levels) {
  for (const unsigned long baud : {115200ul, 420000ul}) {
    for (const Polarity polarity : {Polarity::Inverted, Polarity::Uninverted}) {
      const LineSettings settings = {baud, polarity, {8, Parity::None, 1}};
      const sbus::Finding found = judge(levels, settings, settings.bitNs()).protocol;
      if (found != sbus::Finding::NoSignal) {
        const std::string why =
            "is n" + std::string(sbus::text(found)).substr(1) + " " + std::string(sbus::remedy(found));
        return why.substr(0, why.size() - 1);  // the caller ends the sentence
      }
    }
  }
  return {};
}

FoundWire findWire(const std::vector<Level> &levels, const Overrides &overrides, const Format &format) {
  FoundWire best;
  const bool told = overrides.baud != 0;
  for (const unsigned long baud : told ? std::vector{overrides.baud} : std::vector{sbus::Baud, 2 * sbus::Baud}) {
    LineSettings settings;
    settings.baud = baud;
    settings.format = format;
    const double nominalNs = settings.bitNs();
    double bitNs = fit(levels, nominalNs);
    if (std::abs(bitNs - nominalNs) > BaudTolerance * nominalNs) {
      if (!told || levels.empty()) {
        continue;
      }
      bitNs = nominalNs;
    }
    for (const Polarity polarity : {Polarity::Inverted, Polarity::Uninverted}) {
      settings.polarity = polarity;
      const FoundWire wire = judge(levels, settings, bitNs);
      best = wire.betterThan(best) ? wire : best;
    }
  }
  return best;
}

}  // namespace

std::string tooSlow(double sampledNs, double bitNs) {
  constexpr double SamplesPerBit = 4;
  if (sampledNs * SamplesPerBit <= bitNs) {
    return {};
  }
  return "was sampled every " + microseconds(sampledNs) + ", but a bit lasts " + microseconds(bitNs) +
         ": at least 4 samples a bit are expected, better 10; record it at 1 MHz or more";
}

FoundWire findWire(const std::vector<Level> &levels, const Overrides &overrides) {
  return findWire(levels, overrides, Format());
}

bool hasPulses(const std::vector<Level> &levels) { return !pulses(levels).empty(); }

bool hasBits(const std::vector<Level> &levels) { return isOneBitLong(shortest(pulses(levels))); }

std::string whyNotFound(const std::vector<Level> &levels, const FoundWire &best, double periodNs) {
  const std::vector<int64_t> lengths = pulses(levels);
  if (lengths.empty()) {
    return "has no pulses: is the probe on S-BUS_OUT, and the receiver on?";
  }
  const double pulseNs = shortest(lengths);
  if (const std::string train = pulseTrain(levels, pulseNs); !train.empty()) {
    return train;
  }
  const std::string slow = tooSlow(periodNs, 2 * ShortestBitNs);
  if (!slow.empty()) {
    return slow;
  }
  if (const std::string other = otherProtocol(levels); !other.empty()) {
    return other;
  }
  const std::string seen = "is not S.Bus: its shortest pulses last " + microseconds(pulseNs);
  if (best.good + best.bad == 0 || !isOneBitLong(pulseNs)) {
    const double baud = 1e9 / std::max(pulseNs, 1.0);
    return seen + ", as bits of " + std::to_string(static_cast<unsigned long>(baud)) +
           " baud do: 10 us or 5 us are expected, within 3 %";
  }
  if (findWire(levels, {}, {8, Parity::None, 1}).frames > 0) {
    return "has frames, but without parity: the sender has 8N1 or 8N2, and S.Bus has 8E2";
  }
  if (best.good >= 2 * best.bad) {
    return "has " + std::to_string(best.good) + " good characters at " + text(best.settings) + ", but no frame";
  }
  return seen + ", but of " + std::to_string(best.good + best.bad) + " characters " + std::to_string(best.bad) +
         " have a wrong parity or stop bit: 8 data bits, even parity and 2 stop bits are expected";
}

}  // namespace line
