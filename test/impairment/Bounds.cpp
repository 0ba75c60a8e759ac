#include "Bounds.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <stdexcept>

namespace {

constexpr double FalseAlarm = 1e-6;  // of one check
constexpr double Beyond = 0.025;     // at each end of an interval

struct Measure {
  const char *name;
  uint64_t Tally::*lines;
  bool isWrong;
};
constexpr Measure Measures[] = {
    {"missed", &Tally::linesMissed, false},     {"mostly missed", &Tally::linesDead, false},
    {"wrong", &Tally::linesWrong, true},        {"late", &Tally::linesLate, false},
    {"too young", &Tally::linesTooYoung, true}, {"wrong after a gap", &Tally::linesOutlived, true}};

// No lines: nothing has been measured.
struct Counts {
  uint64_t lines;
  uint64_t of[std::size(Measures)];
};
struct Rates {
  const char *condition;
  Counts ordinary, deceptive;
};
constexpr Rates Known[] = {
#include "Rates.inc"
};

constexpr const char *Ordinary = "ordinary", *Deceptive = "deceptive";

Counts known(const Condition &condition, const std::string &sticks) {
  for (const Rates &rates : Known) {
    if (condition.name == rates.condition) {
      return sticks == Ordinary ? rates.ordinary : rates.deceptive;
    }
  }
  return {};
}

// Returns the probability of `count` events or more where `mean` are expected (Poisson).
double atLeast(uint64_t count, double mean) {
  if (count == 0) {
    return 1;
  }
  if (mean <= 0) {
    return 0;
  }
  const auto isSmall = [](double term, double sum) { return term <= sum * 1e-12; };  // both are 0 far from the mean
  const auto probability = [mean](double k) { return std::exp(k * std::log(mean) - mean - std::lgamma(k + 1)); };
  auto k = static_cast<double>(count);
  double sum = 0;
  if (k > mean) {
    for (double term = probability(k); !isSmall(term, sum); term *= mean / ++k) {
      sum += term;
    }
    return sum;
  }
  for (double term = probability(--k); k >= 0 && !isSmall(term, sum); term *= k-- / mean) {
    sum += term;
  }
  return 1 - sum;
}

// Returns the mean at which `count` events or more have this probability.
double meanOf(uint64_t count, double probability) {
  double low = 0;
  double high = 10 + 2 * static_cast<double>(count);
  for (int i = 0; i < 60; i++) {
    const double mean = (low + high) / 2;
    (atLeast(count, mean) < probability ? low : high) = mean;
  }
  return high;
}

uint64_t mostOf(double mean) {
  auto most = static_cast<uint64_t>(mean);
  while (atLeast(most + 1, mean) > FalseAlarm) {
    most++;
  }
  return most;
}

bool isPromised(const Measure &measure, Promise promise) {
  return promise == Promise::Faultless || (promise == Promise::NeverWrong && measure.isWrong);
}

double ratio(uint64_t count, uint64_t of) { return static_cast<double>(count) / static_cast<double>(of); }

}  // namespace

double Rate::low() const { return meanOf(count, Beyond) / static_cast<double>(lines); }

double Rate::high() const { return std::min(1.0, meanOf(count + 1, 1 - Beyond) / static_cast<double>(lines)); }

std::vector<Group> groups(const std::string &only) {
  std::vector<Group> all;
  for (const Condition &condition : conditions()) {
    const auto add = [&](const char *name, const std::vector<Payload> &sticks) {
      if (!sticks.empty() && condition.name.find(only) != std::string::npos) {
        all.push_back({&condition, name, sticks});
      }
    };
    add(Ordinary, condition.ordinarySticks());
    add(Deceptive, condition.deceptiveSticks());
  }
  return all;
}

Tally impairment(const Group &group, uint64_t frames, uint64_t seed) {
  return impairment(*group.condition, group.condition->setups, group.sticks, Decoder::Ours, frames, seed);
}

std::vector<Check> checks(const std::vector<Group> &groups, const std::vector<Tally> &tallies) {
  std::vector<Check> all;
  for (const Measure &measure : Measures) {
    Check rare = {"all lines on which it is rare", measure.name, {}, {}, 0};
    double largest = 0;  // share of the lines of Rates.inc
    for (size_t i = 0; i < groups.size(); i++) {
      const Counts rates = known(*groups[i].condition, groups[i].name);
      if (rates.lines == 0) {
        throw std::out_of_range(groups[i].condition->name + ", " + groups[i].name + ": no rates, see Bounds.h");
      }
      Check check = {groups[i].condition->name + ", " + groups[i].name,
                     measure.name,
                     {tallies[i].*measure.lines, tallies[i].lines},
                     {rates.of[&measure - Measures], rates.lines},
                     0};
      const double share = ratio(check.seen.lines, check.measured.lines);
      if (!isPromised(measure, groups[i].condition->promise)) {
        check.most = mostOf(check.measured.high() * static_cast<double>(check.seen.lines));
        if (static_cast<double>(check.measured.count) * share < 1) {
          rare.seen.count += check.seen.count;
          rare.seen.lines += check.seen.lines;
          rare.measured.count += check.measured.count;
          rare.measured.lines += check.measured.lines;
          largest = std::max(largest, share);
          if (check.seen.count != 0) {
            rare.parts += "\n" + check.line + ": " + std::to_string(check.seen.count);
          }
        }
      }
      all.push_back(check);
    }
    rare.most = mostOf(meanOf(rare.measured.count + 1, 1 - Beyond) * largest);
    all.push_back(rare);
  }
  return all;
}

void printRates(const std::vector<Group> &chosen, const std::vector<Tally> &tallies) {
  std::printf(
      "// Written by `make -C test rates`: condition; lines with ordinary sticks, and on how many of them a frame "
      "was\n//");
  for (const Measure &measure : Measures) {
    std::printf("%s %s", &measure == Measures ? "" : ",", measure.name);
  }
  std::printf("; the same for deceptive sticks.\n");
  for (const Condition &condition : conditions()) {
    std::printf("{\"%s\"", condition.name.c_str());
    for (const std::string sticks : {Ordinary, Deceptive}) {
      Counts counts = known(condition, sticks);
      for (size_t i = 0; i < chosen.size(); i++) {
        if (chosen[i].condition == &condition && chosen[i].name == sticks) {
          counts.lines = tallies[i].lines;
          for (const Measure &measure : Measures) {
            counts.of[&measure - Measures] = tallies[i].*measure.lines;
          }
        }
      }
      std::string numbers;
      for (const uint64_t count : counts.of) {
        numbers += (numbers.empty() ? "" : ", ") + std::to_string(count);
      }
      std::printf(counts.lines == 0 ? ", {}" : ", {%llu, {%s}}", static_cast<unsigned long long>(counts.lines),
                  numbers.c_str());
    }
    std::printf("},\n");
  }
}
