#include "Worst.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include "support/FakeClock.h"
#include "support/KnownFrames.h"
#include "support/Random.h"

// Last: its macros min and max break the standard headers after it.
#include "Cost.h"
#undef min
#undef max

namespace {

constexpr uint32_t CharacterUs = 120;

template <typename Both>
uint32_t costWith(const Attack &attack, size_t count) {
  alignas(Both) static uint8_t place[sizeof(Both)];
  fakeMicros = 0;
  Both &both = *new (place) Both();
  both.receiver.begin();
  if (attack.locked) {
    for (unsigned i = 0; i < 3; i++) {
      fakeMicros += 9000;
      take(both, Neutral.bytes.data(), Neutral.bytes.size());
    }
    fakeMicros += 4000;
  }
  const uint8_t *const last = attack.bytes.data() + LongestLead;
  for (const uint8_t *next = last - attack.lead; next < last;) {
    const size_t size = std::min<size_t>(attack.burst, static_cast<size_t>(last - next));
    fakeMicros += std::max<uint64_t>(attack.gapUs, size * CharacterUs);  // no line is faster
    take(both, next, size);
    next += size;
  }
  fakeMicros += std::max<uint64_t>(attack.gapUs, count * CharacterUs);
  return take(both, last, count).instructions;
}

template <typename Both>
uint32_t streamWith(const BadLine &line, size_t count) {
  constexpr size_t Burst = 16;  // what the board's driver hands over
  fakeMicros = 0;
  Both both;
  both.receiver.begin();
  uint32_t sum = 0;
  for (size_t at = 0; at < count; at += Burst) {
    uint8_t bytes[Burst];
    for (size_t i = 0; i < Burst; i++) {
      bytes[i] = line[at + i];
    }
    fakeMicros += Burst * CharacterUs;
    sum += take(both, bytes, Burst).instructions;
  }
  return sum;
}

// What means something to a receiver.
constexpr uint8_t Telling[] = {0x0F, 0x0F, 0x0F, 0x00, 0x00, 0x04, 0x08, 0x0C, 0x10, 0x2F, 0x34, 0xFF};

uint8_t tellingByte(Random &random) {
  return Telling[random.below(sizeof Telling)];
}

Attack randomAttack(Random &random) {
  Attack attack;
  attack.locked = random.below(2) != 0;
  attack.lead = static_cast<uint8_t>(random.below(LongestLead + 1));
  attack.burst = static_cast<uint8_t>(1 + random.below(32));
  attack.gapUs = static_cast<uint16_t>(random.below(5000));
  const bool blocks = random.below(2) != 0;
  uint8_t byte = 0x0F;
  for (uint8_t &each : attack.bytes) {
    if (!blocks || random.below(16) == 0) {
      byte = tellingByte(random);
    }
    each = byte;
  }
  return attack;
}

void change(Attack &attack, Random &random) {
  const size_t size = attack.bytes.size();
  switch (random.below(8)) {
    case 0:
      attack.locked = !attack.locked;
      break;
    case 1:
      attack.lead = static_cast<uint8_t>(random.below(LongestLead + 1));
      break;
    case 2:
      attack.burst = static_cast<uint8_t>(1 + random.below(32));
      break;
    case 3:
      attack.gapUs = static_cast<uint16_t>(random.below(5000));
      break;
    case 4: {  // the same bytes some frame's length later
      const size_t distance = 23 + random.below(4);
      const size_t at = random.below(static_cast<uint32_t>(size - distance));
      const size_t count = std::min<size_t>(1 + random.below(24), size - distance - at);
      std::copy_n(attack.bytes.begin() + static_cast<std::ptrdiff_t>(at), count,
                  attack.bytes.begin() + static_cast<std::ptrdiff_t>(at + distance));
      break;
    }
    case 5: {  // a run
      const size_t at = random.below(static_cast<uint32_t>(size));
      std::fill_n(attack.bytes.begin() + static_cast<std::ptrdiff_t>(at),
                  std::min<size_t>(1 + random.below(24), size - at), tellingByte(random));
      break;
    }
    default:
      attack.bytes[random.below(static_cast<uint32_t>(size))] = tellingByte(random);
  }
}

}  // namespace

Attack attackOf(const WorstCall &known, size_t &size) {
  std::vector<uint8_t> bytes;
  size_t lead = 0;
  for (const char *next = known.bytes; *next != '\0'; next += std::strspn(next, " ")) {
    char *end;
    if (*next == '|') {
      lead = bytes.size();
      next++;
    } else {
      bytes.push_back(static_cast<uint8_t>(std::strtoul(next, &end, 16)));
      next = end;
    }
  }
  size = bytes.size() - lead;
  Attack attack = {true, static_cast<uint8_t>(lead), known.burst, known.gapUs, {}};
  std::copy(bytes.begin(), bytes.end(), attack.bytes.begin() + static_cast<std::ptrdiff_t>(LongestLead - lead));
  return attack;
}

uint32_t costOf(const Attack &attack, size_t count, Way way) {
  return way == Way::Ours ? costWith<Ours>(attack, count) : costWith<Papers>(attack, count);
}

uint32_t streamCost(const BadLine &line, size_t count, Way way) {
  return way == Way::Ours ? streamWith<Ours>(line, count) : streamWith<Papers>(line, count);
}

uint32_t worstOf(const BadLine &line, size_t count, Way way) {
  constexpr size_t Starts = 52;  // more than twice a frame
  constexpr uint8_t Leads = 32;  // more than a frame
  uint32_t worst = 0;
  Attack attack;
  for (const bool locked : {false, true}) {
    attack.locked = locked;
    for (const uint8_t burst : {uint8_t{16}, uint8_t{29}}) {
      attack.burst = burst;
      attack.gapUs = static_cast<uint16_t>(burst * CharacterUs);
      for (attack.lead = 0; attack.lead <= Leads; attack.lead++) {
        for (size_t start = 0; start < std::min(line.pattern.size(), Starts); start++) {
          for (size_t i = 0; i < attack.bytes.size(); i++) {
            attack.bytes[i] = line[start + i];
          }
          worst = std::max(worst, costOf(attack, count, way));
        }
      }
    }
  }
  return worst;
}

Attack search(size_t count, uint32_t tries, uint64_t seed) {
  Random random(seed);
  Attack best = randomAttack(random);
  uint32_t most = costOf(best, count, Way::Ours);
  for (uint32_t i = 0; i < tries; i++) {
    Attack attack = best;
    for (uint32_t changes = 1 + random.below(3); changes > 0; changes--) {
      change(attack, random);
    }
    const uint32_t cost = costOf(attack, count, Way::Ours);
    if (cost >= most) {
      most = cost;
      best = attack;
    }
  }
  return best;
}

void print(const Attack &attack, size_t count) {
  for (size_t i = LongestLead - attack.lead; i < LongestLead + count; i++) {
    std::printf("%s%02X", i == LongestLead ? " | " : " ", attack.bytes[i]);
  }
  std::printf(" (%s, calls of %u bytes, %u us apart)\n", attack.locked ? "after three frames" : "after begin()",
              attack.burst, attack.gapUs);
}
