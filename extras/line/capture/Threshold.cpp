#include "line/capture/Threshold.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace line {

namespace {

constexpr int Bins = 256;

}  // namespace

Threshold::Range Threshold::rangeOf(const std::vector<double> &volts) {
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  for (const double v : volts) {
    least = std::fmin(least, v);  // leaves NaN out
    most = std::fmax(most, v);
  }
  return {least, most - least};
}

bool Threshold::find(const std::vector<double> &volts) {
  const auto [least, span] = rangeOf(volts);
  if (!(span > 0)) {
    return false;
  }
  std::array<double, Bins> histogram{};
  for (const double v : volts) {
    if (std::isnan(v)) {
      continue;
    }
    histogram[static_cast<size_t>((v - least) / span * (Bins - 1))]++;
  }
  // Otsu's method: choose the cut with the least variance within its two sides.
  double all = 0, sum = 0, squares = 0;
  for (int i = 0; i < Bins; i++) {
    all += histogram[static_cast<size_t>(i)];
    sum += i * histogram[static_cast<size_t>(i)];
    squares += static_cast<double>(i) * i * histogram[static_cast<size_t>(i)];
  }
  double best = 0, lowMean = 0, highMean = 0;
  double count = 0, below = 0;
  for (int i = 0; i + 1 < Bins; i++) {
    count += histogram[static_cast<size_t>(i)];
    below += i * histogram[static_cast<size_t>(i)];
    if (count == 0 || count == all) {
      continue;
    }
    const double low = below / count;
    const double high = (sum - below) / (all - count);
    const double between = count / all * (all - count) / all * (high - low) * (high - low);
    if (between > best) {
      best = between;
      lowMean = low;
      highMean = high;
    }
  }
  constexpr double TwoLevels = 0.8;  // share of the variance between the sides; noise alone has 0.64
  const double variance = squares / all - sum / all * (sum / all);
  const double perBin = span / (Bins - 1);
  const double middle = least + (lowMean + highMean) / 2 * perBin;
  const Threshold found(middle, (highMean - lowMean) * perBin);
  if (best < TwoLevels * variance || !found.lasts(volts)) {
    return false;
  }
  *this = found;
  return true;
}

bool Threshold::lasts(const std::vector<double> &volts) const {
  size_t high = 0;
  size_t changes = 0, run = 2, singles = 0;
  bool wasHigh = volts.front() > middle();
  for (const double v : volts) {
    const bool is = std::isnan(v) ? wasHigh : isHigh(v, wasHigh);
    changes += is != wasHigh;
    singles += is != wasHigh && run == 1;
    run = is != wasHigh ? 1 : run + 1;
    high += is;
    wasHigh = is;
  }
  constexpr size_t SamplesMin = 2;
  const size_t pulses = changes / 2 + 1;
  const bool isEachLong = singles == 0;  // a simulator may print the ends of each pulse alone
  return changes > 0 && (isEachLong || std::min(high, volts.size() - high) >= SamplesMin * pulses);
}

// Starts over if the swing is now much larger than before: then everything before was noise.
void AnalogueLevel::learn(const std::vector<double> &volts) {
  if (!_isGiven && (!_found || Threshold::rangeOf(volts).span > 2.5 * _threshold.swing())) {
    _found = _threshold.find(volts) || _found;
  }
}

bool AnalogueLevel::changes(double volts) {
  const bool high = _threshold.isHigh(volts, _isHigh);
  if (!_found || std::isnan(volts) || (_begun && high == _isHigh)) {
    return false;
  }
  _begun = true;
  _isHigh = high;
  return true;
}

}  // namespace line
