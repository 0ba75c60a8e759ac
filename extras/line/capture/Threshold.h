// Turns a wire's voltages into levels.
#pragma once

#include <optional>
#include <vector>

namespace line {

// Finds where low ends and high begins, from the voltages alone. Voltages in between change nothing, so a noisy slope
// is one edge.
class Threshold {
 public:
  Threshold() = default;
  // For a wire that swings by `swing` volts around `middle`; 0: every crossing of the middle is an edge.
  Threshold(double middle, double swing) : _low(middle - Hysteresis * swing), _high(middle + Hysteresis * swing) {}

  // The range of voltages. One that is not a number is missing.
  struct Range {
    double least;
    double span;
  };
  static Range rangeOf(const std::vector<double> &volts);

  // Searches the voltages for two levels. Returns false if there is only one, with noise.
  bool find(const std::vector<double> &volts);

  // Returns the level at this voltage, for a wire that was `high` before.
  bool isHigh(double volts, bool high) const { return high ? volts > _low : volts >= _high; }

  double middle() const { return (_low + _high) / 2; }
  double swing() const { return (_high - _low) / (2 * Hysteresis); }

 private:
  static constexpr double Hysteresis = 0.15;  // of the swing, on either side of the middle

  // Returns true if the levels last as long as bits: the last digit of a converter toggles faster.
  bool lasts(const std::vector<double> &volts) const;

  double _low = 0;   // low up to here
  double _high = 0;  // high from here on
};

// The level of a wire, from its voltages.
class AnalogueLevel {
 public:
  // `threshold`: given by the user; otherwise learn() finds it.
  explicit AnalogueLevel(std::optional<double> threshold = {})
      : _threshold(threshold.value_or(0), 0), _found(threshold.has_value()), _isGiven(_found) {}

  // Searches the voltages that follow for the threshold, if none was given.
  void learn(const std::vector<double> &volts);

  // Takes the next voltage. Returns true if it is the first level or changes it; false while there is no threshold.
  bool changes(double volts);

  bool isHigh() const { return _isHigh; }

 private:
  Threshold _threshold;
  bool _found;  // there are two levels
  bool _isGiven;
  bool _begun = false;  // there is a first level
  bool _isHigh = false;
};

}  // namespace line
