// What people really do with their sticks, many times: random makes, directions, trims, noise and hands. No wrong
// calibration is ever stored. RUNS=5000 prints the table: play, accepted, reversed, off.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "support/Radio.h"

using sbus::CalibrationError;

namespace {

constexpr int DefaultRuns = 60;

// One channel of one radio, the hand on it, and the steps. Positions are -1..+1: + is up or right.
class Play {
 public:
  explicit Play(unsigned seed) : _random(seed) {
    _make = chance() ? sbus::FrSky : sbus::Futaba;
    _direction = chance() ? 1 : -1;
    _trim = between(-20, 20) / 100.0;
    _noise = between(0, 12);
  }

  int between(int low, int high) { return std::uniform_int_distribution<int>(low, high)(_random); }
  bool chance() { return between(0, 1) == 1; }

  Play &untrimmed() {
    _trim = 0;
    return *this;
  }
  Play &wrongOnceIn(int frames) {
    _wrongIn = between(1, frames);
    return *this;
  }

  void frame() {
    const double half = (_make.high - _make.low) / 2.0;
    const double moved = _at + _trim * (1 - std::abs(_at));
    int raw = static_cast<int>(std::lround((_make.low + _make.high) / 2.0 + _direction * half * moved)) +
              between(-_noise, _noise);
    if (_wrongIn > 0 && --_wrongIn == 0) {
      raw = chance() ? 0 : 2047;
    }
    if (_flagged && chance()) {  // failsafe values, or a lost frame's
      _radio.channels[0] = chance() ? 0 : 2047;
      const int flags = between(1, 3);
      _radio.calibrator.feed(_radio.channels.data(), (flags & 1) != 0, (flags & 2) != 0);
    }
    _radio.channels[0] = static_cast<uint16_t>(raw < 0 ? 0 : raw > 2047 ? 2047 : raw);
    _radio.feed();
  }
  Play &loseFrames() {
    _flagged = true;
    return *this;
  }

  Play &hold(int frames) {
    while (frames-- > 0) {
      frame();
    }
    return *this;
  }
  Play &put(double to) {
    _at = to;
    return *this;
  }
  Play &glide(double to) {
    const int frames = between(15, 60);
    const double from = _at;
    for (int i = 1; i <= frames; i++) {
      _at = from + (to - from) * i / frames;
      frame();
    }
    return *this;
  }
  // Circles once in `period` frames.
  Play &stir(int frames, double reach) {
    const int period = between(60, 200);
    for (int i = 0; i < frames; i++) {
      _at = reach * std::cos(6.2831853 * i / period);
      frame();
    }
    return *this;
  }
  Play &sweep(double low, double high) {
    const bool lowFirst = chance();
    for (int i = between(1, 3); i > 0; i--) {
      glide(lowFirst ? low : high);
      hold(between(2, 20));
      glide(lowFirst ? high : low);
      hold(between(2, 20));
    }
    return *this;
  }

  Play &centre() {
    _radio.calibrator.centre();
    return *this;
  }
  Play &high() {
    _radio.calibrator.high();
    return *this;
  }
  Play &restAt(double at) {
    glide(at);
    centre();
    hold(between(50, 200));
    return *this;
  }
  Play &pushTo(double at) {
    high();
    glide(at);
    hold(between(100, 300));
    return *this;
  }

  double switchPosition(int count) { return 2.0 * between(0, count - 1) / (count - 1) - 1; }

  struct Outcome {
    bool accepted, turned, off;
    CalibrationError error;
  };
  Outcome outcome(unsigned wanted) {
    const Finished finished(_radio.calibrator, wanted);
    const Radio::Numbers found = finished[0];
    Outcome out = {finished.error == CalibrationError::None && found[0] != found[2], false, false, finished.error};
    if (out.accepted) {
      const int half = (_make.high - _make.low) / 2;
      const int low = _direction > 0 ? _make.low : _make.high;
      const int high = _direction > 0 ? _make.high : _make.low;
      const int middle = (low + high) / 2;
      const int centre = middle + static_cast<int>(_direction * half * (_throttle ? 0 : _trim));
      out.turned = (found[0] < found[2]) != (low < high);
      const int ends[] = {found[0] - (out.turned ? high : low), found[2] - (out.turned ? low : high),
                          found[1] - centre};
      for (const int error : ends) {
        out.off = out.off || std::abs(error) > half / 10;
      }
    }
    return out;
  }
  Play &isThrottle() {
    _throttle = true;
    return *this;
  }

 private:
  std::mt19937 _random;
  Radio _radio;
  sbus::Range _make;
  int _direction;
  double _trim;
  int _noise;
  double _at = 0;
  int _wrongIn = 0;
  bool _flagged = false;
  bool _throttle = false;
};

Play &throttle(Play &play) {
  return play.isThrottle().untrimmed().put(-1);
}

// Some are accepted; the direction is the radio's if the channel is not required.
constexpr int Some = -1, NotCounted = -2;

const struct {
  const char *what;
  void (*hands)(Play &play);
  int accepted;  // of a hundred
  int turned, off;
  unsigned wanted;
} Rows[] = {
    {"as told", [](Play &p) { p.sweep(-1, 1).restAt(0).pushTo(1); }, 100, 0, 0, 1},
    {"throttle as told", [](Play &p) { throttle(p).sweep(-1, 1).restAt(-1).pushTo(1); }, 100, 0, 0, 1},
    {"stirred fast", [](Play &p) { p.stir(400, 1).restAt(0).pushTo(1); }, 100, 0, 0, 1},
    {"pushed the wrong way first",
     [](Play &p) { p.sweep(-1, 1).restAt(0).high().glide(-1).hold(100).glide(1).hold(150); }, 100, 0, 0, 1},
    {"moved one way in the first step",
     [](Play &p) {
       const bool up = p.chance();
       p.sweep(up ? 0 : -1, up ? 1 : 0).restAt(0).pushTo(1);
     },
     0, 0, 0, 1},
    {"moved half way in the first step", [](Play &p) { p.sweep(-0.5, 0.5).restAt(0).pushTo(1); }, 0, 0, 0, 1},
    {"third step left out", [](Play &p) { p.sweep(-1, 1).restAt(0); }, 0, 0, 0, 1},
    {"pushed, then stirred", [](Play &p) { p.sweep(-1, 1).restAt(0).pushTo(1).stir(p.between(100, 300), 1); }, Some, 0,
     0, 1},
    {"pushed, then let go", [](Play &p) { p.sweep(-1, 1).restAt(0).pushTo(1).glide(0).hold(p.between(30, 200)); }, 0, 0,
     0, 1},
    {"not pushed", [](Play &p) { p.sweep(-1, 1).restAt(0).pushTo(0); }, 0, 0, 0, 1},
    {"throttle up in the second step, then down and up",
     [](Play &p) { throttle(p).sweep(-1, 1).restAt(1).high().glide(-1).hold(p.between(0, 100)).glide(1).hold(100); }, 0,
     0, 0, 1},
    {"one wrong value in the first step", [](Play &p) { p.wrongOnceIn(60).sweep(-1, 1).restAt(0).pushTo(1); }, 100, 0,
     0, 1},
    {"one wrong value in the second step",
     [](Play &p) { p.sweep(-1, 1).glide(0).centre().wrongOnceIn(50).hold(50).pushTo(1); }, 0, 0, 0, 1},
    {"one wrong value in the third step", [](Play &p) { p.sweep(-1, 1).restAt(0).wrongOnceIn(115).pushTo(1); }, 100, 0,
     0, 1},
    {"one wrong value in the third step's last frame",
     [](Play &p) { p.sweep(-1, 1).restAt(0).pushTo(1).wrongOnceIn(1).hold(1); }, 100, 0, 0, 1},
    {"does not rest", [](Play &p) { p.sweep(-1, 1).centre().stir(200, 1).pushTo(1); }, 0, 0, 0, 1},
    {"a switch of three positions",
     [](Play &p) {
       p.untrimmed();
       for (const double at : {-1, 0, 1, 0, -1}) {
         p.put(at).hold(p.between(20, 60));
       }
       p.put(0).centre().hold(60).high().put(1).hold(100);
     },
     100, 0, 0, 1},
    {"... left where it was in the third step, not wanted",
     [](Play &p) { p.untrimmed().sweep(-1, 1).put(p.switchPosition(3)).centre().hold(60).high().hold(100); }, Some,
     NotCounted, 0, 0},
    {"a switch of six positions, not wanted",
     [](Play &p) {
       p.isThrottle().untrimmed().sweep(-1, 1).put(p.switchPosition(2) * 0.6).centre().hold(60).high().hold(100);
     },
     Some, NotCounted, 0, 0},
    {"a slider left in the middle", [](Play &p) { p.untrimmed().hold(200).centre().hold(60).high().hold(100); }, 0, 0,
     0, 0},
    {"radio off in the first step, stick at one end", [](Play &p) { p.glide(1).hold(50).restAt(0).pushTo(1); }, 0, 0, 0,
     1},
    {"radio off in the second step", [](Play &p) { p.sweep(-1, 1).centre().pushTo(1); }, 0, 0, 0, 1},
    {"radio off in the third step, before the push",
     [](Play &p) { p.sweep(-1, 1).restAt(0).high().hold(p.between(0, 200)); }, 0, 0, 0, 1},
    {"frames lost, failsafe values with their flag", [](Play &p) { p.loseFrames().sweep(-1, 1).restAt(0).pushTo(1); },
     100, 0, 0, 1},
};

}  // namespace

TEST_CASE("whatever hands do, no channel that is reversed or off by more than 10 % is accepted; right channels are") {
  const char *const asked = std::getenv("RUNS");
  const int runs = asked != nullptr ? std::atoi(asked) : DefaultRuns;
  for (const auto &row : Rows) {
    int accepted = 0, turned = 0, off = 0;
    for (int run = 0; run < runs; run++) {
      Play play(static_cast<unsigned>(run));
      row.hands(play);
      const Play::Outcome outcome = play.outcome(row.wanted);
      accepted += outcome.accepted;
      turned += outcome.turned;
      off += outcome.off;
    }
    if (asked != nullptr) {
      std::printf("| %s | %d | %d | %d |\n", row.what, accepted, turned, off);
    }
    CAPTURE(row.what);
    if (row.accepted != Some) {
      CHECK(accepted == runs * row.accepted / 100);
    }
    if (row.turned != NotCounted) {
      CHECK(turned == row.turned);
    }
    CHECK(off == row.off);
  }
}
