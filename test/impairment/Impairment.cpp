// Prints how the receiver and the baseline perform on every line: a table in Markdown, with a row for each line as it
// is done.
//   FRAMES=n    frames of each line and kind of sticks; 10000
//   SEED=n      20181, that of the tables in extras/docs
//   ONLY=x      only the lines whose names contain x
//   FULL=1      one row for each line, setup and kind of sticks; FRAMES: 2000 by default
//   SUMMARY=1   only the receiver, sums only
//   BOUNDS=1    what ImpairmentTest checks: what was seen, the rate with its 95 % interval, the most that is allowed
//   RATES=1     writes these rates, Rates.inc; FRAMES: 400000 by default
#include <cstdio>
#include <string>
#include <vector>

#include "Bounds.h"
#include "Settings.h"

namespace {

uint64_t frames = 0;
uint64_t seed = 0;

Tally tallyOf(const Condition &condition, const std::vector<Setup> &setups, Payload sticks, Decoder decoder) {
  return impairment(condition, setups, {sticks}, decoder, frames, seed);
}
std::vector<Payload> sticksOf(const Condition &condition) {
  std::vector<Payload> all = condition.ordinarySticks();
  const std::vector<Payload> more = condition.deceptiveSticks();
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

// Returns "0.0003", or a plain count if there is no number to compare it with.
std::string perDamage(uint64_t count, const Tally &tally) {
  if (tally.damages() == 0 || count == 0) {
    return std::to_string(count);
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", static_cast<double>(count) / static_cast<double>(tally.damages()));
  return text;
}

// Ends the line and shows it at once.
void printRow(const std::vector<std::string> &cells) {
  for (const std::string &cell : cells) {
    std::printf("| %s ", cell.c_str());
  }
  std::printf("|\n");
  std::fflush(stdout);
}

void printHeading(const std::vector<std::string> &cells) {
  printRow(cells);
  printRow(std::vector<std::string>(cells.size(), "---"));
}

// One decoder on one line: the sum, and the worst sticks, over all setups.
struct Column {
  Tally sum;
  Tally worst;
  Payload worstSticks = Payload::Neutral;

  Column(const Condition &condition, Decoder decoder) {
    for (const Payload sticks : sticksOf(condition)) {
      const Tally tally = tallyOf(condition, condition.setups, sticks, decoder);
      sum += tally;
      // missed / damages, without a division by 0
      if (tally.missed * (worst.damages() + 1) > worst.missed * (tally.damages() + 1)) {
        worst = tally;
        worstSticks = sticks;
      }
    }
  }

  std::string missed() const {
    return worst.missed == 0 ? "0" : perDamage(worst.missed, worst) + " (" + name(worstSticks) + ")";
  }
};

void printWorst(const Condition &condition) {
  const Column ours(condition, Decoder::Ours);
  const Column papers(condition, Decoder::Papers);
  printRow({condition.name, std::to_string(ours.sum.damages()), std::to_string(ours.sum.missed), ours.missed(),
            std::to_string(ours.sum.wrong), std::to_string(ours.sum.late), std::to_string(ours.sum.tooYoung),
            std::to_string(ours.sum.altered), papers.missed(), std::to_string(papers.sum.wrong)});
}

void printSum(const Condition &condition) {
  const Tally sum = Column(condition, Decoder::Ours).sum;
  printRow({condition.name, std::to_string(sum.damages()), std::to_string(sum.missed), std::to_string(sum.wrong),
            std::to_string(sum.late), std::to_string(sum.tooYoung)});
}

void printAll(const Condition &condition) {
  for (const Setup &setup : condition.setups) {
    for (const Payload sticks : sticksOf(condition)) {
      std::vector<std::string> cells = {condition.name, name(setup), name(sticks)};
      for (const Decoder decoder : {Decoder::Ours, Decoder::Papers}) {
        const Tally tally = tallyOf(condition, {setup}, sticks, decoder);
        for (const uint64_t count :
             {tally.damages(), tally.intact, tally.missed, tally.wrong, tally.late, tally.tooYoung, tally.altered}) {
          cells.push_back(std::to_string(count));
        }
      }
      printRow(cells);
    }
  }
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", 100 * share);
  return text;
}

void printChecks(const std::vector<Check> &all) {
  printHeading({"line, sticks", "lines on which a frame was", "seen", "rate in %, and its 95 % interval", "bound"});
  for (const Check &check : all) {
    if (check.measured.count != 0 || check.seen.count != 0) {
      const Rate &rate = check.measured;
      printRow({check.line, check.what, std::to_string(check.seen.count) + " of " + std::to_string(check.seen.lines),
                percent(static_cast<double>(rate.count) / static_cast<double>(rate.lines)) + " (" +
                    percent(rate.low()) + " to " + percent(rate.high()) + ")",
                std::to_string(check.most)});
    }
  }
}

std::vector<Tally> talliesOf(const std::vector<Group> &chosen) {
  std::vector<Tally> tallies;
  for (const Group &group : chosen) {
    std::fprintf(stderr, "%zu of %zu: %s, %s\n", tallies.size() + 1, chosen.size(), group.condition->name.c_str(),
                 group.name);
    tallies.push_back(impairment(group, frames, seed));
  }
  return tallies;
}

}  // namespace

int main() {
  const char *const text = std::getenv("ONLY");
  const std::string only = text == nullptr ? "" : text;
  const bool full = setting("FULL", 0) != 0;
  const bool summary = setting("SUMMARY", 0) != 0;
  const bool rates = setting("RATES", 0) != 0;
  frames = setting("FRAMES", rates ? 400000 : full ? 2000 : 10000, 1);
  seed = setting("SEED", 20181);

  const std::vector<Group> chosen = groups(only);
  if (chosen.empty()) {
    std::fprintf(stderr, "ONLY=%s: no line has this in its name\n", only.c_str());
    return 2;
  }
  if (rates) {
    printRates(chosen, talliesOf(chosen));
    return 0;
  }
  std::printf("seed %llu, %llu frames of each line and kind of sticks\n\n", static_cast<unsigned long long>(seed),
              static_cast<unsigned long long>(frames));
  if (setting("BOUNDS", 0) != 0) {
    printChecks(checks(chosen, talliesOf(chosen)));
    return 0;
  }
  if (summary) {
    printHeading({"line", "damaged", "missed", "wrong", "late", "too young"});
  } else if (full) {
    printHeading({"line", "setup", "sticks", "damaged", "intact", "missed", "wrong", "late", "too young",
                  "altered, delivered", "the paper's: damaged", "intact", "missed", "wrong", "late", "too young",
                  "altered, delivered"});
  } else {
    printHeading({"line", "damaged", "missed", "missed per damaged", "wrong", "late", "too young", "altered, delivered",
                  "the paper's: missed per damaged", "wrong"});
  }
  for (const Condition &condition : conditions()) {
    if (condition.name.find(only) != std::string::npos) {
      std::fprintf(stderr, "%s\n", condition.name.c_str());
      (summary ? printSum : full ? printAll : printWorst)(condition);
    }
  }
  return 0;
}
