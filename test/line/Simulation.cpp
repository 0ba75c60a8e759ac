#include "Simulation.h"

#include <algorithm>
#include <type_traits>

#include "support/UartPort.h"

#include "support/PaperDecoder.h"

#include <DecodeSBus.h>

namespace {

// Ways of receiving. newFrame(): since the last call, and so newExtra(). Judged are the frames, not the link: failsafe is
// then the frame's own, and one that waited while loop() was blocked for longer than the timeout is still read.
template <typename Decoder, typename Format, unsigned Mask>
class OursOf {
 public:
  static constexpr unsigned Size = Format::Size, FlagsMask = Mask;

  explicit OursOf(HardwareSerial &port) : _sbus(port) {
    _sbus.setLossLimit(0);
    _sbus.setTimeout(0);
  }
  void begin(unsigned long baud) { _sbus.begin(baud); }
  void parse() { _sbus.parseSBusFrame(); }
  bool newFrame(LongFrame &frame) {
    if (!_sbus.newFrame()) {
      return false;
    }
    LongChannels channels{};
    bool failsafe = false;
    bool lostFrame = false;
    _sbus.decodeSBusFrame(channels.data(), failsafe, lostFrame);
    Format::pack(frame.data(), channels.data(), failsafe, lostFrame);
    return true;
  }
  bool newExtra(LongFrame &) { return false; }
  uint32_t breaks() const { return _sbus.counters().overflows; }

 protected:
  Decoder _sbus;
};

class Ours : public OursOf<DecodeSBus, sbus::Frame16, 0x0F> {
 public:
  using OursOf::OursOf;
  bool newExtra(LongFrame &frame) {
    const uint32_t count = _sbus.counters().extraFrames;
    Channels channels{};
    if (count == _extras || !_sbus.decodeExtraChannels(channels.data())) {
      return false;
    }
    _extras = count;
    sbus::pack(frame.data(), channels.data(), false, false);
    return true;
  }

 private:
  uint32_t _extras = 0;
};

using Ours24 = OursOf<DecodeSBus24, sbus::Frame24, 0x0C>;

class Papers {
 public:
  static constexpr unsigned Size = sbus::FrameSize, FlagsMask = 0x0F;

  explicit Papers(HardwareSerial &port) : _paper(port) {}
  void begin(unsigned long baud) { _paper.begin(baud); }
  void parse() { _paper.parseSBusFrame(); }
  bool newFrame(LongFrame &frame) {
    if (_paper.frames() == _seen) {
      return false;
    }
    _seen = _paper.frames();
    std::copy_n(_paper.frame(), Size, frame.begin());
    return true;
  }
  bool newExtra(LongFrame &) { return false; }
  uint32_t breaks() const { return 0; }

 private:
  PaperDecoder _paper;
  uint32_t _seen = 0;
};

template <typename Receiver>
class Simulation {
 public:
  Simulation(const Run &run, uint64_t seed)
      : _run(run),
        _random(seed),
        _beginUs(MicrosWrap - randomUs(std::min(run.line.frames * run.setup.periodUs, MicrosWrap / 2))),
        _line(run.line, run.joining ? _beginUs - run.joinUs : _beginUs + 20000 + randomUs(9000), _random),
        _port(run.line.baud, run.setup.driver, run.setup.buffer, [this] { takeFrame(); }),
        _judge(learning(run.setup), Receiver::Size, Receiver::FlagsMask),
        _extraJudge(learning(run.setup), Receiver::Size, 0) {}

  Tally run() {
    fakeMicros = _beginUs;
    _receiver.begin(_run.line.baud);
    _nextBlockUs = _run.blockEveryUs != 0 ? fakeMicros + _run.blockEveryUs : UINT64_MAX;
    do {
      loop();
      receive();
      if (_port.available() > 0) {
        poll();
      }
    } while (!_line.finished(fakeMicros) || fakeMicros < _lastEndUs + 50000);
    Tally tally = _judge.finish();
    if constexpr (std::is_same<Receiver, Ours>::value) {
      Tally extra = _extraJudge.finish();
      extra.late = 0;
      tally += extra;
    }
    tally.disturbed = _line.noiseCharacters() + _blocks;
    return tally;
  }

 private:
  // How many frames the first six polls and two more take, at most.
  static uint64_t learning(const Setup &setup) {
    return 2 + 6 * std::max<uint64_t>(setup.loopUs, setup.periodUs) / setup.periodUs;
  }

  uint64_t randomUs(uint64_t limitUs) { return _random.below(static_cast<uint32_t>(limitUs)); }

  void loop() {
    const uint32_t periodUs = _run.setup.loopUs;
    if (fakeMicros >= _nextBlockUs) {
      _nextBlockUs = fakeMicros + _run.blockEveryUs - randomUs(_run.setup.periodUs);
      fakeMicros += _run.blockFromUs + randomUs(_run.blockToUs - _run.blockFromUs + 1);
      _blocks++;
      return;
    }
    fakeMicros += _run.inStep ? periodUs : periodUs * 9 / 10 + randomUs(periodUs / 5 + 1);
    // Loops in which nothing can come are not worth the time.
    if (!_line.finished(fakeMicros) && fakeMicros >= _lastEndUs + 5 * _characterUs + 2 * periodUs) {
      const uint64_t nextUs = std::min(_line.nextUs(), _nextBlockUs);
      if (nextUs > fakeMicros + periodUs) {
        fakeMicros += (nextUs - fakeMicros) / periodUs * periodUs;
      }
    }
  }

  void receive() {
    line::Character character;
    while (_line.next(fakeMicros, character)) {
      for (SentFrame frame; _line.nextSent(frame);) {
        (frame.extra ? _extraJudge : _judge).sent(frame);
      }
      if (character.endUs < _beginUs + _characterUs && !character.bad) {
        lose(1);
      }
      _port.receive(character);
      _lastEndUs = character.endUs;
    }
    _port.advance(fakeMicros);
  }

  void poll() {
    const uint64_t has = position() + static_cast<uint64_t>(_port.available());
    _judge.poll(has);
    _extraJudge.poll(has);
    const uint32_t breaks = _receiver.breaks();
    _receiver.parse();
    takeFrame();
    if (_receiver.breaks() != breaks) {
      _judge.broken();
    }
    // What the full buffer had no place for stood after all that was in it, and has been read now.
    lose(_port.droppedFull() - _droppedFull);
    _droppedFull = _port.droppedFull();
  }

  void takeFrame() {
    LongFrame frame;
    if (_receiver.newExtra(frame)) {
      _extraJudge.given(frame.data(), position());
    }
    if (_receiver.newFrame(frame)) {
      _judge.given(frame.data(), position());
    }
  }

  // All characters before it have been read or lost.
  uint64_t position() const { return _port.bytesRead() + _lost; }
  void lose(uint64_t characters) {
    _judge.lost(position(), position() + characters);
    _extraJudge.lost(position(), position() + characters);
    _lost += characters;
  }

  const Run _run;
  const uint32_t _characterUs = _run.line.characterUs();
  Random _random;
  const uint64_t _beginUs;  // such that micros() wraps during the run
  DamagedLine _line;
  UartPort _port;
  Receiver _receiver{_port};
  Judge _judge;
  Judge _extraJudge;  // of frames with header 2F
  uint64_t _nextBlockUs = 0;
  uint64_t _blocks = 0;
  uint64_t _lastEndUs = 0;
  uint64_t _lost = 0;
  uint64_t _droppedFull = 0;
};

}  // namespace

Tally simulate(const Run &run, Decoder decoder, uint64_t seed) {
  if (decoder == Decoder::Papers) {
    return Simulation<Papers>(run, seed).run();
  }
  return run.reads24 ? Simulation<Ours24>(run, seed).run() : Simulation<Ours>(run, seed).run();
}
