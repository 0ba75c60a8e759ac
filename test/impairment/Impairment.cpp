// Prints how the receiver and the baseline perform on every line: a table in Markdown, with a row for each line as it
// is done.
//   FRAMES=n    frames of each line, setup and kind of sticks; 2000
//   SEED=n      20181
//   ONLY=x      only the lines whose names contain x
//   FULL=1      one row for each line, setup and kind of sticks
//   SUMMARY=1   only the receiver, sums only; FRAMES: 1000 by default
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "Company.h"
#include "Joins.h"
#include "Settings.h"

namespace {

uint64_t frames = 0;

struct Row {
  std::string name;
  std::vector<Setup> setups;
  std::vector<Payload> sticks;
  std::function<Tally(const Setup &setup, Payload sticks, Decoder decoder)> impairment;
};

Row rowOf(const Condition &condition) {
  return {condition.name, condition.setups, condition.sticks(),
          [&condition](const Setup &setup, Payload sticks, Decoder decoder) {
            return impairment(condition, setup, sticks, decoder, frames, seedOfAll());
          }};
}

// Each join counts as an impaired frame, and a join without a frame as missed.
Row rowOf(const JoinLine &line) {
  return {line.name, line.setups, JoinLine::sticks(),
          [&line](const Setup &setup, Payload sticks, Decoder decoder) {
            const JoinTally joins = impairment(line, setup, sticks, decoder, joinStride(frames), seedOfAll());
            Tally tally = joins.frames;
            tally.damaged = joins.joins;
            tally.missed = joins.unseen;
            return tally;
          }};
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

  Column(const Row &row, Decoder decoder) {
    for (const Payload sticks : row.sticks) {
      Tally tally;
      for (const Setup &setup : row.setups) {
        tally += row.impairment(setup, sticks, decoder);
      }
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

void printWorst(const Row &row) {
  const Column ours(row, Decoder::Ours);
  const Column papers(row, Decoder::Papers);
  printRow({row.name, std::to_string(ours.sum.damages()), ours.missed(), std::to_string(ours.sum.wrong),
            std::to_string(ours.sum.late), std::to_string(ours.sum.tooYoung), std::to_string(ours.sum.altered),
            papers.missed(), std::to_string(papers.sum.wrong)});
}

void printSum(const Row &row) {
  const Tally sum = Column(row, Decoder::Ours).sum;
  printRow({row.name, std::to_string(sum.damages()), std::to_string(sum.missed), std::to_string(sum.wrong),
            std::to_string(sum.late), std::to_string(sum.tooYoung)});
}

void printAll(const Row &row) {
  for (const Setup &setup : row.setups) {
    for (const Payload sticks : row.sticks) {
      std::vector<std::string> cells = {row.name, name(setup), name(sticks)};
      for (const Decoder decoder : {Decoder::Ours, Decoder::Papers}) {
        const Tally tally = row.impairment(setup, sticks, decoder);
        for (const uint64_t count :
             {tally.damages(), tally.intact, tally.missed, tally.wrong, tally.late, tally.tooYoung, tally.altered}) {
          cells.push_back(std::to_string(count));
        }
      }
      printRow(cells);
    }
  }
}

}  // namespace

int main() {
  const char *const only = std::getenv("ONLY");
  const bool full = setting("FULL", 0) != 0;
  const bool summary = setting("SUMMARY", 0) != 0;
  frames = framesPerCase(summary ? 1000 : 2000);
  const uint64_t seed = seedOfAll();

  std::vector<Row> chosen;
  const auto choose = [&](const auto &lines) {
    for (const auto &line : lines) {
      if (only == nullptr || line.name.find(only) != std::string::npos) {
        chosen.push_back(rowOf(line));
      }
    }
  };
  choose(conditions());
  choose(companyLines());
  choose(joinLines());
  if (chosen.empty()) {
    std::fprintf(stderr, "ONLY=%s: no line has this in its name\n", only);
    return 2;
  }
  std::printf("seed %llu, %llu frames of each line, setup and kind of sticks\n\n",
              static_cast<unsigned long long>(seed), static_cast<unsigned long long>(frames));
  if (summary) {
    printHeading({"line", "damaged", "missed", "wrong", "late", "too young"});
  } else if (full) {
    printHeading({"line", "setup", "sticks", "damaged", "intact", "missed", "wrong", "late", "too young",
                  "altered, handed over", "the paper's: damaged", "intact", "missed", "wrong", "late", "too young",
                  "altered, handed over"});
  } else {
    printHeading({"line", "damaged", "missed per damaged", "wrong", "late", "too young", "altered, handed over",
                  "the paper's: missed per damaged", "wrong"});
  }
  size_t number = 0;
  for (const Row &row : chosen) {
    std::fprintf(stderr, "%zu of %zu: %s\n", ++number, chosen.size(), row.name.c_str());
    (summary ? printSum : full ? printAll : printWorst)(row);
  }
  return 0;
}
