// The link quality of lines with lost, failsafe and missing frames, in loops of several periods.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <functional>

#include "sbus/LinkQuality.h"

namespace {

constexpr uint32_t StaleUs = 100000;

enum class Came { Good, Lost, Failsafe, Both, Not };

struct Extent {
  int low = 101;
  int high = -1;
  bool operator==(const Extent &other) const { return low == other.low && high == other.high; }
};

// A decoder's counters on a line, and a loop that reads the quality.
class Line {
 public:
  Line(uint32_t periodUs, uint32_t loopUs, uint32_t startUs = 0)
      : _periodUs(periodUs), _loopUs(loopUs), _us(startUs), _frameUs(startUs) {}

  // Returns the lowest and the highest quality in these seconds.
  Extent run(double seconds, const std::function<Came(unsigned)> &came) {
    Extent extent;
    for (double left = seconds * 1e6; left > 0; left -= _loopUs) {
      block(_loopUs, came);
      const int percent = _quality.update(_counters, _state, _us);
      extent.low = std::min(extent.low, percent);
      extent.high = std::max(extent.high, percent);
    }
    return extent;
  }

  // The sketch calls begin() again: the counters are 0.
  void begin() { _counters = {}; }

  // The sketch calls setTimeout(0): the link is never stale.
  void disableTimeout() { _staleUs = UINT32_MAX; }

  // Time goes on without a call.
  void block(uint32_t us, const std::function<Came(unsigned)> &came) {
    _us += us;
    while (static_cast<int32_t>(_us - _frameUs) >= static_cast<int32_t>(_periodUs)) {
      _frameUs += _periodUs;
      take(came(_number++));
    }
    _state = _counters.frames == 0         ? sbus::LinkState::NeverSeen
             : _us - _newestUs >= _staleUs ? sbus::LinkState::Stale
                                           : _state;
  }

 private:
  void take(Came came) {
    if (came == Came::Not) {
      return;
    }
    _newestUs = _frameUs;
    _counters.frames++;
    _counters.lostFrames += came == Came::Lost || came == Came::Both;
    _counters.failsafeFrames += came == Came::Failsafe || came == Came::Both;
    _state = came == Came::Good   ? sbus::LinkState::Ok
             : came == Came::Lost ? sbus::LinkState::Lossy
                                  : sbus::LinkState::Failsafe;
  }

  const uint32_t _periodUs;
  const uint32_t _loopUs;
  uint32_t _us;
  uint32_t _frameUs;
  uint32_t _newestUs = 0;
  uint32_t _staleUs = StaleUs;
  unsigned _number = 0;
  sbus::Counters _counters{};
  sbus::LinkState _state = sbus::LinkState::NeverSeen;
  sbus::LinkQuality _quality;
};

Came good(unsigned) { return Came::Good; }

}  // namespace

TEST_CASE(
    "the quality is the share of the expected frames that came without a flag, whatever the period and the loop") {
  const struct {
    const char *what;
    std::function<Came(unsigned)> came;
    Extent quality;  // between 2 and 12 s after such frames began
  } rows[] = {
      {"all good", good, {100, 100}},
      {"every tenth lost", [](unsigned i) { return i % 10 == 3 ? Came::Lost : Came::Good; }, {88, 92}},
      {"every fourth missing", [](unsigned i) { return i % 4 == 3 ? Came::Not : Came::Good; }, {72, 82}},
      {"a fourth missing, a fourth lost",
       [](unsigned i) { return i % 4 == 3   ? Came::Not
                               : i % 4 == 1 ? Came::Lost
                                            : Came::Good; },
       {47, 55}},
      {"all lost", [](unsigned) { return Came::Lost; }, {0, 0}},
      {"failsafe without the lost-frame flag", [](unsigned) { return Came::Failsafe; }, {0, 0}},
      {"both flags", [](unsigned) { return Came::Both; }, {0, 0}},
      {"nothing", [](unsigned) { return Came::Not; }, {0, 0}},
  };
  for (const auto &row : rows) {
    for (const uint32_t periodUs : {4000u, 6300u, 9000u, 15000u}) {
      for (const uint32_t loopUs : {500u, 3000u, 20000u, 200000u}) {
        CAPTURE(row.what);
        CAPTURE(periodUs);
        CAPTURE(loopUs);
        Line line(periodUs, loopUs, UINT32_MAX - 3000000);  // the clock wraps on the way
        line.run(5, good);
        line.run(2, row.came);
        const Extent quality = line.run(10, row.came);
        CHECK(quality.low >= row.quality.low);
        CHECK(quality.high <= row.quality.high);
      }
    }
  }
}

TEST_CASE("the quality is 0 before the first frame and while the link is stale; then it is back at once") {
  Line line(9000, 3000);
  CHECK(line.run(1, [](unsigned) { return Came::Not; }) == Extent{0, 0});
  line.run(0.02, good);
  CHECK(line.run(3, good) == Extent{100, 100});
  CHECK(line.run(0.09, [](unsigned) { return Came::Not; }).high >= 90);
  line.run(0.02, [](unsigned) { return Came::Not; });
  CHECK(line.run(5, [](unsigned) { return Came::Not; }) == Extent{0, 0});
  line.run(0.02, good);
  CHECK(line.run(3, good) == Extent{100, 100});
}

TEST_CASE("asked once in 1 to 2 s, the quality is the share of the frames since four calls before") {
  for (const uint32_t loopUs : {999000u, 1000000u, 1100000u, 1900000u}) {
    CAPTURE(loopUs);
    Line line(9000, loopUs);
    const auto half = [](unsigned i) { return i % 2 == 0 ? Came::Lost : Came::Good; };
    line.run(8, half);
    const Extent quality = line.run(60, half);
    CHECK(quality.low >= 45);
    CHECK(quality.high <= 51);
  }
}

TEST_CASE("missing frames still lower it after a minute; if a receiver stays slower, its new rate is expected") {
  Line line(9000, 3000);
  const auto half = [](unsigned i) { return i % 2 == 0 ? Came::Not : Came::Good; };
  line.run(5, good);
  line.run(60, half);
  CHECK(line.run(1, half).high < 60);
  line.run(600, half);
  CHECK(line.run(5, half) == Extent{100, 100});
}

TEST_CASE("begin() restarts the measurement, also in a loop that reads every 250 ms, and so sees no state but Ok") {
  for (const uint32_t loopUs : {3000u, 250000u}) {
    CAPTURE(loopUs);
    Line line(9000, loopUs);
    line.run(5, good);
    line.begin();
    CHECK(line.run(5, good) == Extent{100, 100});
  }
}

TEST_CASE("without a timeout, a silent line has the quality 0, even when no rate is expected any more") {
  Line line(15000, 3000);
  line.disableTimeout();
  line.run(5, good);
  const auto nothing = [](unsigned) { return Came::Not; };
  line.run(2, nothing);
  CHECK(line.run(1800, nothing) == Extent{0, 0});
  line.run(2, good);
  CHECK(line.run(5, good) == Extent{100, 100});
}
