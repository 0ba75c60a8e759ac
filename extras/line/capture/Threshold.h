// Turns a wire's voltages into levels.
#pragma once

#include <vector>

namespace line {

// Finds where low ends and high begins, by the voltages alone. Voltages between the two change nothing, so that a noisy
// slope is one edge.
class Threshold {
 public:
  Threshold() = default;
  // Takes a wire that goes up and down by `swing` volts around `middle`; 0: each crossing of the middle is an edge.
  Threshold(double middle, double swing) : _low(middle - Hysteresis * swing), _high(middle + Hysteresis * swing) {}

  // Takes the range of voltages. An infinite voltage, beyond the instrument's range, counts as two spans beyond the
  // others.
  struct Range {
    double least;
    double span;
  };
  static Range rangeOf(const std::vector<double> &volts);

  // Looks for two levels among the voltages. Returns false if there is only one, with noise.
  bool find(const std::vector<double> &volts);

  // Returns the level at this voltage of a wire that was `high` before.
  bool isHigh(double volts, bool high) const { return high ? volts > _low : volts >= _high; }

  double middle() const { return (_low + _high) / 2; }
  double swing() const { return (_high - _low) / (2 * Hysteresis); }

 private:
  static constexpr double Hysteresis = 0.15;  // of the swing, on either side of the middle

  // Returns true if the levels last as long as bits: the last digit of a converter toggles faster.
  bool lasts(const std::vector<double> &volts) const;

  double _low = 0;   // up to here it is low
  double _high = 0;  // from here on it is high
};

}  // namespace line
