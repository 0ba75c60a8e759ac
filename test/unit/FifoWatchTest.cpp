// When a character came, by the fill level of a receive FIFO: right, or not known, however late driver and polls are.
#include <doctest/doctest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "sbus2/FifoWatch.h"

namespace {

constexpr uint32_t Never = UINT32_MAX;

// The most that things are late by, at random, in us. All others are as on an ESP32 (esp-idf 01b912a,
// driver/uart/uart.c, uart_rx_intr_handler_default()).
struct Lateness {
  uint32_t interrupt;  // of the driver
  uint32_t poll;       // of one poll in 32
  uint32_t frame;      // characters in a row: up to these
};

// A UART with its driver, and a task that polls both, microsecond by microsecond.
class Line {
 public:
  explicit Line(const Lateness &late, uint32_t startUs) : _late(late), _now(startUs), _nextUs(startUs + 100) {}

  void run(uint32_t us) {
    for (const uint32_t end = _now + us; _now != end; _now++) {
      wire();
      driver();
      if (_now == _pollUs) {
        poll();
      }
    }
  }

  unsigned known = 0, wrong = 0, unknown = 0;

 private:
  uint32_t upTo(uint32_t most) { return static_cast<uint32_t>(_random() % (most + 1)); }

  void wire() {
    if (_now != _nextUs) {
      return;
    }
    _fifo.push_back(_now);
    _lastUs = _now;
    _row = _row > 0 ? _row - 1 : upTo(_late.frame - 1);
    _nextUs += _row > 0 ? 120 : 120 + upTo(upTo(4000));
  }

  void driver() {
    constexpr uint32_t Burst = 13, Idle = 240, Longest = 95;
    if (_now == _countsUs) {
      _waiting.insert(_waiting.end(), _taken.begin(), _taken.end());
      _taken.clear();
      _countsUs = Never;
    }
    const bool isRaised = _fifo.size() >= Burst || (!_fifo.empty() && _now - _lastUs >= Idle);
    if (isRaised && _takesUs == Never && _countsUs == Never) {
      _takesUs = _now + upTo(_late.interrupt);
    }
    if (_now == _takesUs) {
      _taken.swap(_fifo);
      _takesUs = Never;
      _countsUs = _now + 1 + upTo(Longest - 1);
    }
  }

  // Each part of a poll may come late.
  void poll() {
    switch (_part) {
      case 0:
        _found = static_cast<unsigned>(_waiting.size());
        _newestUs = _found != 0 ? _waiting.back() : 0;
        _waiting.clear();
        break;
      case 1:
        _byUs = _now;
        break;
      case 2:
        _fromUs = _now;
        break;
      case 3:
        _fill = static_cast<unsigned>(_fifo.size());
        break;
      default:
        judge();
        break;
    }
    _part = (_part + 1) % 5;
    const uint32_t usual = _part == 0 ? 4 : 1;
    _pollUs = _now + usual + (upTo(31 * 5) == 0 ? upTo(_late.poll) : 0);
  }

  // A character is in the FIFO between the middle of its first stop bit, 15 us before its end, and its end.
  void judge() {
    constexpr uint32_t Sure = 100, Early = 15;
    _watch.poll(_found, _byUs, _fromUs, _fill, _now);
    const sbus::FrameEnd end = _watch.end();
    if (_found == 0) {
      return;
    }
    if (end.latest - end.earliest > Sure) {
      unknown++;
      return;
    }
    known++;
    wrong +=
        static_cast<int32_t>(_newestUs - end.earliest) < 0 || static_cast<int32_t>(end.latest - Early - _newestUs) < 0;
  }

  const Lateness _late;
  std::minstd_rand _random{28};
  sbus::FifoWatch _watch;
  std::vector<uint32_t> _fifo, _taken, _waiting;  // when their characters came
  uint32_t _now, _nextUs, _pollUs = _now + 1;
  uint32_t _lastUs = 0, _takesUs = Never, _countsUs = Never, _row = 0;
  unsigned _part = 0, _found = 0, _fill = 0;
  uint32_t _newestUs = 0, _byUs = 0, _fromUs = 0;
};

}  // namespace

TEST_CASE("the last character that was handed over came within the bounds, or there are no bounds") {
  const struct {
    Lateness late;
    unsigned knownOf10;  // at least
  } rows[] = {{{2, 0, 25}, 6},     {{200, 0, 25}, 9}, {{1000, 0, 25}, 9}, {{3000, 0, 25}, 9}, {{2, 200, 25}, 3},
              {{200, 5000, 3}, 0}, {{45, 300, 1}, 4}, {{45, 0, 1}, 9},    {{1000, 300, 2}, 4}};
  for (const auto &row : rows) {
    CAPTURE(row.late.interrupt);
    CAPTURE(row.late.poll);
    CAPTURE(row.late.frame);
    Line line(row.late, UINT32_MAX - 2000000);  // the clock wraps meanwhile
    line.run(5000000);
    MESSAGE(line.known, " known, ", line.unknown, " not");
    CHECK(line.wrong == 0);
    CHECK(line.known > 0);
    CHECK(10 * line.known >= row.knownOf10 * (line.known + line.unknown));
  }
}

TEST_CASE("after 1.9 ms a character in the FIFO is not known to be the newest: others may have come and been lost") {
  for (const uint32_t waitUs : {300u, 1900u, 1901u, 20000u}) {
    CAPTURE(waitUs);
    sbus::FifoWatch watch;
    uint32_t now = 5000;
    for (const unsigned fill : {0u, 0u, 0u, 1u}) {
      watch.poll(0, now, now, fill, now);
      now += 60;
    }
    watch.poll(1, now - 60 + waitUs, now + waitUs, 0, now + waitUs);
    const bool isKnown = watch.end().latest - watch.end().earliest <= 100;
    CHECK(isKnown == (waitUs <= 1900));
  }
}
