// Prints how the receiver and the paper's way do on every line: a table in Markdown, one row a line.
//   FRAMES=n   frames of each line, timing and kind of sticks; 20000
//   SEED=n     20181
//   ONLY=x     only the lines whose name has x in it
//   FULL=1     one row for each line, timing and kind of sticks
#include <cstdio>
#include <string>

#include "Conditions.h"
#include "Settings.h"

namespace {

constexpr uint64_t Frames = 20000;

// "0.0003", or a plain count if there is nothing to hold it against.
std::string perDamage(uint64_t count, const Tally &tally) {
  if (tally.damages() == 0 || count == 0) {
    return std::to_string(count);
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", static_cast<double>(count) / static_cast<double>(tally.damages()));
  return text;
}

// One way of receiving on one line: the sum, and the worst sticks, over all timings.
struct Column {
  Tally sum;
  Tally worst;
  Sticks worstSticks = Sticks::Neutral;

  void add(const Tally &tally, Sticks sticks) {
    sum += tally;
    // missed / damages, without a division by 0
    if (tally.missed * (worst.damages() + 1) > worst.missed * (tally.damages() + 1)) {
      worst = tally;
      worstSticks = sticks;
    }
  }

  std::string missed() const {
    return worst.missed == 0 ? "0" : perDamage(worst.missed, worst) + " (" + name(worstSticks) + ")";
  }
};

Tally allTimings(const Condition &condition, Sticks sticks, Way way) {
  Tally sum;
  for (const Timing &timing : condition.timings) {
    sum += torture(condition, timing, sticks, way, framesPerCase(Frames), seedOfAll());
  }
  return sum;
}

void printRow(const Condition &condition) {
  Column ours;
  Column papers;
  for (const Sticks sticks : allSticks()) {
    ours.add(allTimings(condition, sticks, Way::Ours), sticks);
    papers.add(allTimings(condition, sticks, Way::Papers), sticks);
  }
  std::printf("| %-42s | %8llu | %-22s | %6llu | %-22s | %7llu |\n", condition.name.c_str(),
              static_cast<unsigned long long>(ours.sum.damages()), ours.missed().c_str(),
              static_cast<unsigned long long>(ours.sum.wrong), papers.missed().c_str(),
              static_cast<unsigned long long>(papers.sum.wrong));
}

void printTable(const std::string &lines) {
  std::printf("| %-42s | %-8s | %-22s | %-6s | %-22s | %-7s |\n", "line", "damaged", "missed per damaged", "wrong",
              "the paper's: missed", "wrong");
  std::printf("| --- | --- | --- | --- | --- | --- |\n");
  for (const Condition &condition : conditions()) {
    if (condition.name.find(lines) != std::string::npos) {
      printRow(condition);
      std::fflush(stdout);
    }
  }
}

void printFullRow(const Condition &condition, const Timing &timing, Sticks sticks) {
  std::printf("| %s | %s | %s |", condition.name.c_str(), name(timing).c_str(), name(sticks));
  for (const Way way : {Way::Ours, Way::Papers}) {
    const Tally tally = torture(condition, timing, sticks, way, framesPerCase(Frames), seedOfAll());
    for (const uint64_t count : {tally.damages(), tally.intact, tally.missed, tally.wrong,
                                 tally.late + tally.lateDoubtful, tally.outdated + tally.outdatedDoubtful}) {
      std::printf(" %llu |", static_cast<unsigned long long>(count));
    }
    std::printf(" %s |", perDamage(tally.missed, tally).c_str());
  }
  std::printf("\n");
}

void printFullTable(const std::string &lines) {
  std::printf("| line | timing | sticks | damaged | intact | missed | wrong | late | outdated | missed per damaged "
              "| the paper's: damaged | intact | missed | wrong | late | outdated | missed per damaged |\n");
  std::printf("|");
  for (int column = 0; column < 17; column++) {
    std::printf(" --- |");
  }
  std::printf("\n");
  for (const Condition &condition : conditions()) {
    if (condition.name.find(lines) == std::string::npos) {
      continue;
    }
    for (const Timing &timing : condition.timings) {
      for (const Sticks sticks : allSticks()) {
        printFullRow(condition, timing, sticks);
      }
    }
  }
}

}  // namespace

int main() {
  const char *const lines = std::getenv("ONLY");
  std::printf("seed %llu, %llu frames of each line, timing and kind of sticks\n\n",
              static_cast<unsigned long long>(seedOfAll()), static_cast<unsigned long long>(framesPerCase(Frames)));
  (setting("FULL", 0) != 0 ? printFullTable : printTable)(lines != nullptr ? lines : "");
  return 0;
}
