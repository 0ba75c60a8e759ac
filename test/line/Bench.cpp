#include "Bench.h"

#include <algorithm>
#include <memory>

// Last: Arduino.h's macros min and max break the standard headers behind it.
#include "PaperReceiver.h"
#include "UartPort.h"

#include <DecodeSBus.h>

#undef min
#undef max

namespace {

constexpr uint64_t ClockWrapUs = uint64_t(1) << 32;
constexpr uint64_t LongestRunUs = ClockWrapUs / 2;  // before the wrap

class Receiver {
 public:
  virtual ~Receiver() = default;
  virtual void begin(unsigned long baud) = 0;
  virtual void parse() = 0;
  virtual bool newFrame(Frame &frame) = 0;  // since the last call
};

class Ours : public Receiver {
 public:
  // Judged are the frames, not the link: failsafe is then the frame's own, and one that waited while loop() was blocked
  // for longer than the timeout is still read.
  explicit Ours(HardwareSerial &port) : _sbus(port) {
    _sbus.setLossLimit(0);
    _sbus.setTimeout(0);
  }
  void begin(unsigned long baud) override { _sbus.begin(baud); }
  void parse() override { _sbus.parseSBusFrame(); }
  bool newFrame(Frame &frame) override {
    if (!_sbus.newFrame()) {
      return false;
    }
    Channels channels{};
    bool failsafe = false;
    bool lostFrame = false;
    _sbus.decodeSBusFrame(channels.data(), failsafe, lostFrame);
    sbus::pack(frame.data(), channels.data(), failsafe, lostFrame);
    return true;
  }

 private:
  DecodeSBus _sbus;
};

class Papers : public Receiver {
 public:
  explicit Papers(HardwareSerial &port) : _paper(port) {}
  void begin(unsigned long baud) override { _paper.begin(baud); }
  void parse() override { _paper.parseSBusFrame(); }
  bool newFrame(Frame &frame) override {
    if (_paper.frames() == _seen) {
      return false;
    }
    _seen = _paper.frames();
    std::copy_n(_paper.frame(), frame.size(), frame.begin());
    return true;
  }

 private:
  PaperReceiver _paper;
  uint32_t _seen = 0;
};

class Bench : private ReadObserver {
 public:
  Bench(const Run &run, Way way, uint64_t seed)
      : _run(run),
        _random(seed),
        _beginUs(ClockWrapUs - randomUs(std::min(run.line.frames * run.line.periodUs, LongestRunUs))),
        _wire(run.line, run.joining ? _beginUs - run.joinUs : _beginUs + 20000 * grainUs() + randomUs(9000 * grainUs()),
              _random),
        _port(*this, run.line.baud) {
    if (way == Way::Ours) {
      _receiver = std::make_unique<Ours>(_port);
    } else {
      _receiver = std::make_unique<Papers>(_port);
    }
  }

  Tally run() {
    fakeMicros = _beginUs;
    _receiver->begin(_run.line.baud);
    _nextBlockUs = _run.blockUs != 0 ? fakeMicros + _run.blockEveryUs : UINT64_MAX;
    do {
      passOfLoop();
      receive();
      if (_port.available() > 0) {
        look();
      }
    } while (!_wire.finished(fakeMicros) || fakeMicros < _lastEndUs + 20000);
    Tally tally = _judge.finish();
    tally.noise = _wire.noiseCharacters();
    return tally;
  }

 private:
  void beforeRead() override { takeFrame(); }

  uint32_t grainUs() const { return _run.line.grainUs; }
  uint32_t randomUs(uint64_t limitUs) { return _random.time(static_cast<uint32_t>(limitUs), grainUs()); }

  void passOfLoop() {
    _blocked = fakeMicros >= _nextBlockUs;
    if (_blocked) {
      _nextBlockUs = fakeMicros + _run.blockEveryUs - randomUs(_run.line.periodUs);
      fakeMicros += _run.blockUs;
      return;
    }
    fakeMicros += _run.steady ? _run.loopUs : _run.loopUs * 9 / 10 + randomUs(_run.loopUs / 5 + grainUs());
    // Passes in which nothing can come are not worth the time.
    if (!_wire.finished(fakeMicros) && fakeMicros >= _lastEndUs + 2 * _characterUs + 2 * _run.loopUs) {
      const uint64_t nextUs = std::min(_wire.nextUs(), _nextBlockUs);
      if (nextUs > fakeMicros + _run.loopUs) {
        fakeMicros += (nextUs - fakeMicros) / _run.loopUs * _run.loopUs;
      }
    }
  }

  void receive() {
    host::Character character;
    while (_wire.next(fakeMicros, character)) {
      for (SentFrame frame; _wire.nextSent(frame);) {
        _judge.sent(frame);
      }
      if (character.endUs < _beginUs + _characterUs && !character.bad) {
        _judge.lost(_position, _position + 1);
        _position++;
      }
      _port.receive(character);
      if (_run.byteByByte) {
        _port.uart.advance(character.endUs + _characterUs);
      }
      _lastEndUs = character.endUs;
    }
    _port.uart.advance(fakeMicros);
  }

  void look() {
    _judge.lookBegins(_position);
    _readBefore = _port.bytesRead;
    _receiver->parse();
    takeFrame();
    _position += _port.bytesRead - _readBefore;
    _readBefore = _port.bytesRead;
    _judge.lookEnds(_position, _blocked);
    // What the full buffer had no place for stood behind all that was in it.
    const uint64_t dropped = _port.uart.droppedFull() - _dropped;
    _judge.lost(_position, _position + dropped);
    _position += dropped;
    _dropped += dropped;
  }

  void takeFrame() {
    Frame frame;
    if (_receiver->newFrame(frame)) {
      _judge.given(frame, _position + _port.bytesRead - _readBefore);
    }
  }

  const Run _run;
  const uint32_t _characterUs = _run.line.characterUs();
  Random _random;
  const uint64_t _beginUs;  // such that micros() wraps during the run
  WireLine _wire;
  UartPort _port;
  std::unique_ptr<Receiver> _receiver;
  Judge _judge;
  bool _blocked = false;
  uint64_t _nextBlockUs = 0;
  uint64_t _lastEndUs = 0;
  uint64_t _position = 0;    // characters that have been read or lost
  uint64_t _readBefore = 0;  // bytesRead before this look
  uint64_t _dropped = 0;
};

}  // namespace

Run slowMotion(Run run) {
  run.line.baud /= 2;
  for (uint32_t *const us : {&run.line.periodUs, &run.line.grainUs, &run.loopUs, &run.blockUs, &run.blockEveryUs,
                             &run.joinUs}) {
    *us *= 2;
  }
  return run;
}

Tally simulate(const Run &run, Way way, uint64_t seed) {
  return Bench(run, way, seed).run();
}
