// Searches for the longest call of parseSBusFrame(), by annealing: it changes at random which bytes come, in which
// calls and when, and also continues from what costs a little less, but less and less.
#include "Bench.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "line/Line.h"
#include "line/simulation/Random.h"
#include "support/Bytes.h"
#include "support/FakeClock.h"
#include "support/KnownFrames.h"

#include "Cost.h"  // last: Arduino.h has a type named byte

namespace {

// Calls of parseSBusFrame(), of which the last is measured: the calls before it bring the receiver into its state.
struct Attack {
  struct Call {
    size_t size;       // bytes that wait; 0: none do
    uint32_t quietUs;  // since the call before, plus the time that the bytes take: no line is faster

    uint32_t gapUs() const { return static_cast<uint32_t>(size) * line::CharacterUs + quietUs; }
  };
  std::vector<Call> calls;
  Bytes bytes;  // of all calls

  // Adds the last call.
  void add(const Bytes &more, uint32_t quietUs) {
    calls.push_back({more.size(), quietUs});
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
};

// Returns an attack as a text: a call a line, "+US HEX HEX ...", the time since the call before, or begin().
std::string textOf(const Attack &attack) {
  std::string text;
  auto next = attack.bytes.begin();
  for (const Attack::Call &call : attack.calls) {
    text += "+" + std::to_string(call.gapUs());
    for (size_t i = 0; i < call.size; i++) {
      char hex[4];
      std::snprintf(hex, sizeof hex, " %02X", *next++);
      text += hex;
    }
    text += "\n";
  }
  return text;
}

// Three times this frame, every 9 ms: the receiver is in sync.
Attack inSync(const Frame &frame) {
  Attack attack;
  for (int i = 0; i < 3; i++) {
    const Bytes bytes = bytesOf(frame) + tailOf(frame[24]);
    attack.add(bytes, 9000 - static_cast<uint32_t>(bytes.size()) * line::CharacterUs);
  }
  return attack;
}

// Returns the cost of the last call. If it finds a full buffer, the driver hands over a burst more meanwhile.
template <typename Receiver>
Cost costOf(const Attack &attack) {
  fakeMicros = 0;
  Receiver both;
  both.receiver.begin();
  Cost cost;
  const uint8_t *next = attack.bytes.data();
  constexpr size_t Full = 64, Burst = 16;
  for (const Attack::Call &call : attack.calls) {
    fakeMicros += call.gapUs();
    cost = take(both, next, call.size, call.size == Full ? Burst : 0);
    next += call.size;
  }
  return cost;
}

constexpr uint64_t Seed = 20181;
constexpr uint32_t Tries = TRIES;  // from each start; build.mk
constexpr size_t Sizes[] = {16, 32, 48, 64};
constexpr size_t LongestCall = Sizes[3];

// The board's port hands over what has come when the line has been idle for a character.
constexpr uint32_t IdleUs = 2 * line::CharacterUs;

// A little more than was found with GCC 12.2: 7987, and 3637 for 16 bytes.
constexpr uint32_t MostPerCall = 8400;
constexpr uint32_t MostPerByte = 270;

// In instructions. A call of the port takes more on the board: an emulated Grasshopper takes 1.54 cycles for each
// instruction, 226 for each call of its port, and 10 for each byte.
constexpr uint32_t PortCall = 150;
uint32_t weigh(const Cost &cost) {
  return cost.instructions + PortCall * cost.portCalls;
}

size_t startOf(const Attack &attack, size_t call) {
  size_t start = 0;
  for (size_t i = 0; i < call; i++) {
    start += attack.calls[i].size;
  }
  return start;
}

class Search {
 public:
  // Returns the costliest attack that the search finds from this one.
  Attack climb(const Attack &start, uint32_t tries) {
    constexpr uint32_t Slack = 200;
    Attack longest = start, current = start, next;
    uint32_t cost = weigh(costOf<Ours>(start));
    uint32_t most = cost;
    for (uint32_t left = tries; left > 0; left--) {
      next = current;
      for (size_t changes = below(2) == 0 ? 1 : 1 + below(4); changes > 0; changes--) {
        change(next);
      }
      const uint32_t found = weigh(costOf<Ours>(next));
      if (found + below(static_cast<uint32_t>(uint64_t{Slack} * left / tries) + 1) >= cost) {
        cost = found;
        std::swap(current, next);
      }
      if (cost > most) {
        most = cost;
        longest = current;
      }
    }
    return longest;
  }

 private:
  static constexpr size_t MostCalls = 16;
  static constexpr size_t MostBefore = 192;  // bytes before the call measured

  // Random::below() divides, which takes an M0 as long as half a try.
  size_t below(size_t limit) { return static_cast<size_t>((_random.next() >> 32) * limit >> 32); }

  uint8_t telling() {
    constexpr uint8_t Telling[] = {0x0F, 0x0F, 0x0F, 0x0F, 0x00, 0x00, 0x04, 0x04,
                                   0x08, 0x08, 0x14, 0x34, 0x2F, 0x0C, 0x10, 0xFF};
    return Telling[below(sizeof Telling)];
  }

  uint32_t quietUs() {
    constexpr size_t Longest[] = {1, 500, 5000, 12000, 60000};
    return IdleUs + static_cast<uint32_t>(below(Longest[below(std::size(Longest))]));
  }

  // Adds a call that finds equal bytes, or any; sometimes nothing.
  Bytes some() {
    Bytes bytes(below(4) == 0 ? 0 : below(41), telling());
    if (below(2) == 0) {
      std::generate(bytes.begin(), bytes.end(), [this] { return telling(); });
    }
    return bytes;
  }

  void change(Attack &attack) {
    Bytes &bytes = attack.bytes;
    const size_t last = attack.calls.size() - 1;
    const size_t before = bytes.size() - attack.calls[last].size;
    const size_t call = below(last + 1);
    const size_t start = startOf(attack, call);
    Attack::Call &chosen = attack.calls[call];
    const auto at = [&](size_t index) { return bytes.begin() + static_cast<std::ptrdiff_t>(index); };
    const auto position = attack.calls.begin() + static_cast<std::ptrdiff_t>(call);
    // Mostly, a byte within the measured call is changed.
    const size_t from = below(3) == 0 ? 0 : before;
    const size_t place = from + below(bytes.size() - from);
    switch (below(12)) {
      case 0: {  // some bytes are copied
        const size_t target = from + below(bytes.size() - from);
        const size_t count = std::min(1 + below(30), bytes.size() - std::max(place, target));
        const Bytes copied = part(bytes, place, place + count);
        std::copy(copied.begin(), copied.end(), at(target));
        break;
      }
      case 1:
        chosen.quietUs = quietUs();
        break;
      case 2: {  // another call
        const Bytes more = some();
        if (last + 1 < MostCalls && before + more.size() <= MostBefore) {
          bytes.insert(at(start), more.begin(), more.end());
          attack.calls.insert(position, {more.size(), quietUs()});
        }
        break;
      }
      case 3:  // a call less
        if (call < last) {
          bytes.erase(at(start), at(start + chosen.size));
          attack.calls.erase(position);
        }
        break;
      case 4:  // another byte
        if (call < last && chosen.size < LongestCall && before < MostBefore) {
          bytes.insert(at(start), telling());
          chosen.size++;
        }
        break;
      case 5:  // a byte less
        if (call < last && chosen.size > 0) {
          bytes.erase(at(start));
          chosen.size--;
        }
        break;
      default:
        bytes[place] = telling();
    }
  }

  line::Random _random{Seed};
};

// Returns receivers in sync with each line variant, about to find this number of bytes.
std::vector<Attack> startsInSync(size_t size) {
  std::vector<Attack> starts;
  for (const sbus::LineVariant &kind : sbus::LineVariants) {
    starts.push_back(inSync(withByte(Neutral.bytes, 24, kind.end)));
    starts.back().add(Bytes(size), IdleUs);
  }
  return starts;
}

Attack longestFrom(const std::vector<Attack> &starts, uint32_t tries) {
  Attack longest;
  uint32_t most = 0;
  for (const Attack &start : starts) {
    const Attack found = Search().climb(start, tries);
    const uint32_t cost = weigh(costOf<Ours>(found));
    if (cost > most) {
      most = cost;
      longest = found;
    }
  }
  return longest;
}

struct Row {
  std::string what;
  size_t size;
  Attack attack;
};

std::vector<Row> rows() {
  std::vector<Row> rows;
  for (const size_t size : Sizes) {
    const uint32_t tries = size == LongestCall ? Tries : Tries / 8;
    rows.push_back({std::to_string(size) + " bytes", size, longestFrom(startsInSync(size), tries)});
  }
  return rows;
}

void printSeed() {
  std::printf("Seed %lu, %lu tries from each start.\n", static_cast<unsigned long>(Seed),
              static_cast<unsigned long>(Tries));
}

}  // namespace

void printLongestCall() {
  printSeed();
  std::printf(
      "\n| the longest call found | instructions | calls of the port | the baseline | calls of the port |\n"
      "| --- | --- | --- | --- | --- |\n");
  Attack longest;
  uint32_t most = 0;
  for (const Row &row : rows()) {
    const Cost ours = costOf<Ours>(row.attack);
    const Cost papers = costOf<Papers>(row.attack);
    std::printf("| %s | %lu | %lu | %lu | %lu |\n", row.what.c_str(), static_cast<unsigned long>(ours.instructions),
                static_cast<unsigned long>(ours.portCalls), static_cast<unsigned long>(papers.instructions),
                static_cast<unsigned long>(papers.portCalls));
    if (weigh(ours) > most) {
      most = weigh(ours);
      longest = row.attack;
    }
  }
  std::printf(
      "\nThe longest is the last of these calls. Each has the time since the one before, in us, and what it finds:\n\n"
      "```\n%s```\n",
      textOf(longest).c_str());
}

void checkLongestCall() {
  printSeed();
  for (const Row &row : rows()) {
    atMost("the longest call found, " + row.what + ", " + std::to_string(PortCall) + " for a call of the port",
           weigh(costOf<Ours>(row.attack)), std::min(MostPerCall, MostPerByte * static_cast<uint32_t>(row.size)));
  }
}
