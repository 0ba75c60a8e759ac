#include "Simulation.h"

#include <algorithm>
#include <type_traits>

#include "Receivers.h"

namespace {

template <typename Receiver>
class Simulation {
 public:
  Simulation(const Run &run, uint64_t seed)
      : _run(run),
        _random(seed),
        _beginUs(MicrosWrap - randomUs(std::min(run.line.frames * run.setup.periodUs, MicrosWrap / 2))),
        _line(run.line, run.joining ? _beginUs - run.joinUs : _beginUs + run.silenceUs + randomUs(9000), _random),
        _port(run.line.baud, run.setup.driver, run.setup.buffer, [this] { takeFrame(); }),
        _judge(Learning, Receiver::Size, Receiver::FlagsMask),
        _extraJudge(Learning, Receiver::Size, 0),
        _joinedUs(run.joining ? _beginUs : _line.joinedUs()) {}

  Tally run() {
    fakeMicros = _beginUs;
    fakeStoodStillUs = 0;
    _receiver.begin(_run.line.baud);
    _nextBlockUs = _run.blockEveryUs != 0 ? fakeMicros + _run.blockEveryUs : UINT64_MAX;
    _maskUs = _run.maskedUs != 0 ? fakeMicros + randomUs(_run.maskEveryUs) : UINT64_MAX;
    do {
      loop();
      receive();
      call();
      passSilence();
    } while (_nextUs != UINT64_MAX || !isSilent());
    Tally tally = _judge.finish();
    if constexpr (std::is_same<Receiver, Ours32>::value) {
      Tally extra = _extraJudge.finish();
      extra.late = 0;
      tally += extra;
    }
    tally.disturbed = _line.noiseCharacters() + _blocks;
    tally.countLine();
    return tally;
  }

 private:
  Receiver receiver() {
    UartPort &port = _port;
    const Driver &driver = _run.setup.driver;
    return _run.setup.callsBack()  ? Receiver(_port)
           : driver.isBoards()     ? Receiver(static_cast<BoardsPort &>(port))
           : driver.fromCallback() ? Receiver(static_cast<PromptPort &>(port))
                                   : Receiver(port);
  }
  uint64_t randomUs(uint64_t limitUs) { return _random.below(static_cast<uint32_t>(limitUs)); }

  void loop() {
    const uint32_t periodUs = _run.setup.loopUs;
    if (fakeMicros >= _nextBlockUs) {
      _nextBlockUs = fakeMicros + _run.blockEveryUs - randomUs(_run.setup.periodUs);
      const uint64_t beganUs = fakeMicros;
      fakeMicros += _run.blockFromUs + randomUs(_run.blockToUs - _run.blockFromUs + 1);
      _blocks++;
      if (_run.blocksInterrupts) {
        receiveWithoutInterrupts(beganUs);
      }
      return;
    }
    fakeMicros += _run.inStep ? periodUs : periodUs * 9 / 10 + randomUs(periodUs / 5 + 1);
  }

  void receiveWithoutInterrupts(uint64_t beganUs) {
    _port.interruptsOff();
    receive();
    _lostLater = _port.interruptsOn();
    _lostAfterRead = _port.bytesRead() + static_cast<uint64_t>(_port.available());
    if (const uint64_t overflowUs = _run.setup.driver.overflowUs) {
      const uint64_t overflows = fakeMicros / overflowUs - beganUs / overflowUs;
      fakeStoodStillUs += overflows > 1 ? (overflows - 1) * overflowUs : 0;
    }
  }

  // Returns true if every driver has handed over what came, and a call has found nothing.
  bool isSilent() const {
    return _emptyLoops > 0 && _callUs == UINT64_MAX && fakeMicros >= _lastEndUs + LongestIdle * _characterUs;
  }

  // Runs all loops up to the last one before the next character, or a block. Each takes exactly the loop period.
  void passSilence() {
    if (_nextUs == UINT64_MAX || !isSilent()) {
      return;
    }
    const uint64_t untilUs = std::min(_nextUs, _nextBlockUs);
    const uint64_t loops = untilUs > fakeMicros ? (untilUs - 1 - fakeMicros) / _run.setup.loopUs : 0;
    for (uint64_t i = _run.everyLoop || loops == 0 ? 0 : loops - 1; i < loops; i++) {
      fakeMicros += (_run.everyLoop ? 1 : loops) * _run.setup.loopUs;
      call();
    }
  }

  void receive() {
    while (_nextUs <= fakeMicros) {
      line::Character character;
      _line.next(fakeMicros, character);
      handOver(character.endUs - _characterUs);
      while (interrupt(character.endUs - 1)) {
      }
      for (SentFrame frame; _line.nextSent(frame);) {
        (frame.extra ? _extraJudge : _judge).sent(frame);
      }
      _nextUs = _line.nextUs();
      if (character.endUs < _beginUs + _characterUs && !character.bad) {
        lose(1);
      }
      _beforeJoin += character.endUs < _joinedUs + _characterUs && !character.bad;
      _port.receive(character);
      _lastEndUs = character.endUs;
      noteEvent(character.endUs);
      while (interrupt(character.endUs)) {
      }
    }
    handOver(std::min(fakeMicros, _nextUs - _characterUs));  // then it is no longer idle
    while (interrupt(fakeMicros)) {
    }
  }

  // Passes the time up to `us`, before the next character begins.
  void handOver(uint64_t us) {
    do {
      const uint64_t untilUs = std::min({us, _isMasked ? UINT64_MAX : _callUs, _maskUs});
      const uint64_t idleUs = _port.idleFromUs();
      _port.advance(untilUs);
      noteEvent(_isMasked ? untilUs : std::min(untilUs, idleUs));
    } while (interrupt(us));
  }

  // Makes the next change of the mask or the call that waits, if it comes by the time `us`, and returns true.
  bool interrupt(uint64_t us) { return changeMask(us) || callBack(us); }

  // Masks interrupts, or no longer, if that is due by the time `us`, and returns true.
  bool changeMask(uint64_t us) {
    if (_maskUs > us || (!_isMasked && _callUs < _maskUs)) {
      return false;
    }
    if (_isMasked && _callUs != UINT64_MAX) {
      _callUs = std::max(_callUs, _maskUs);
    }
    _isMasked = !_isMasked;
    _port.mask(_isMasked);
    noteEvent(_maskUs);
    _maskUs += _isMasked ? _run.maskedUs : _run.maskEveryUs - _run.maskedUs + randomUs(_run.maskUnsteadyUs + 1);
    return true;
  }

  // The port may have handed bytes over at `us`.
  void noteEvent(uint64_t us) {
    if (_run.setup.callsBack() && _port.takeEvent()) {
      _eventUs = us;
      _callUs = callFor(us);
    }
  }

  // Makes the call that waits, if it comes by the time `us`, and returns true. By then other bytes may have followed
  // those of the event; they bring no event of their own.
  bool callBack(uint64_t us) {
    if (_callUs > us || _isMasked) {
      return false;
    }
    const uint64_t nowUs = fakeMicros;
    fakeMicros = _callUs;
    _callUs = UINT64_MAX;
    _lastEmptyUs = _eventUs;
    pollFound();
    fakeMicros = nowUs;
    return true;
  }

  // Returns when the call for an event at `us` comes: once no other work has the level of the port's calls.
  uint64_t callFor(uint64_t us) {
    const uint32_t lateUs = _run.setup.callLateUs;
    us += lateUs != 0 ? randomUs(lateUs + 1) : 0;
    if (_run.workUs == 0) {
      return us;
    }
    while (_workEndUs <= us) {
      _workUs = _workEndUs + randomUs(_run.workEveryUs);
      _workEndUs = _workUs + _run.workUs;
    }
    return us < _workUs ? us : _workEndUs;
  }

  void call() {
    if (!_run.setup.callsBack() && _port.available() > 0) {
      pollFound();
      return;
    }
    _emptyLoops++;
    _lastEmptyUs = fakeMicros;
    if (Receiver::PollsInLoop && _run.setup.polling == Polling::InLoop) {
      _receiver.parse();
      takeFrame();
    }
  }

  void pollFound() {
    _emptyLoops = 0;
    const bool gap = isGap();
    poll();
    if (gap) {
      _judge.gap();  // a frame that ended there has been given by now
    }
  }

  // Returns true if a certain gap stands before the bytes that wait: the silence from the last call that found bytes to
  // the last empty call, less what a driver may hold back, is longer than two characters and what the sender has within
  // frames, but no longer than any frame period. It lies between characters if some were found since the line was
  // joined.
  bool isGap() {
    const uint64_t idle = _run.setup.driver.isBoards() ? 1 : sbus::IdleCharactersMax;  // as far as the library knows
    const auto found = static_cast<uint64_t>(_port.available());
    const uint64_t burst =
        std::min<uint64_t>(sbus::Frame16::spread(static_cast<unsigned>(found)) + idle + 2, sbus::Frame16::SpreadMax);
    const uint64_t silentUs = _lastEmptyUs > _lastFoundUs ? _lastEmptyUs - _lastFoundUs : 0;
    _lastFoundUs = fakeMicros;
    return position() > _beforeJoin && silentUs > burst * _characterUs + _run.line.longestSilenceUs() &&
           silentUs < LongestPeriodUs;
  }

  void poll() {
    const uint64_t has = position() + static_cast<uint64_t>(_port.available()) + _lostLater;
    _judge.poll(has);
    _extraJudge.poll(has);
    const uint32_t breaks = _receiver.breaks();
    _run.setup.callsBack() ? _port.call() : _receiver.parse();
    takeFrame();
    if (_receiver.breaks() != breaks) {
      _judge.broken();
    }
    // Bytes that found the buffer full came after those in it, which have been read now.
    loseAfterKept(true);
    lose(_port.droppedFull() - _droppedFull);
    _droppedFull = _port.droppedFull();
  }

  void takeFrame() {
    loseAfterKept(false);
    LongFrame frame;
    if (_receiver.newExtra(frame)) {
      _extraJudge.given(frame.data(), position());
    }
    if (_receiver.newFrame(frame)) {
      _judge.given(frame.data(), position(), fakeMicros - std::min(fakeMicros, _receiver.youngerThanUs()));
    }
  }

  // Returns the position before which all characters have been read or lost.
  uint64_t position() const { return _port.bytesRead() + _lost; }
  void lose(uint64_t characters) {
    _judge.lost(position(), position() + characters);
    _extraJudge.lost(position(), position() + characters);
    _lost += characters;
  }

  // What the UART lost while interrupts were off came before the bytes that have been read after it, if any have.
  void loseAfterKept(bool isAllRead) {
    const uint64_t readAfter = _port.bytesRead() - _lostAfterRead;
    if (_lostLater == 0 || _port.bytesRead() < _lostAfterRead || (readAfter == 0 && !isAllRead)) {
      return;
    }
    const uint64_t first = position() - readAfter;
    _judge.lost(first, first + _lostLater);
    _extraJudge.lost(first, first + _lostLater);
    _lost += _lostLater;
    _lostLater = 0;
  }

  static constexpr uint64_t Learning = 4;     // frames
  static constexpr uint64_t LongestIdle = 5;  // characters; no driver waits longer
  static constexpr uint64_t LongestPeriodUs = 50000;

  const Run _run;
  const uint32_t _characterUs = _run.line.characterUs();
  Random _random;
  const uint64_t _beginUs;  // such that micros() wraps during the run
  ImpairedLine _line;
  CallingPort _port;
  Receiver _receiver = receiver();
  Judge _judge;
  Judge _extraJudge;                  // of frames with header 2F
  uint64_t _nextUs = _line.nextUs();  // when the line's next character will be complete
  const uint64_t _joinedUs;
  uint64_t _beforeJoin = 0;  // characters
  uint64_t _lastEmptyUs = 0;
  uint64_t _lastFoundUs = 0;
  uint64_t _eventUs = 0;          // of the newest event
  uint64_t _callUs = UINT64_MAX;  // when its call comes
  uint64_t _workUs = 0;           // when the newest other work begins, and ends
  uint64_t _workEndUs = _beginUs;
  bool _isMasked = false;
  uint64_t _maskUs = UINT64_MAX;  // when interrupts are next masked, or no longer
  uint64_t _nextBlockUs = 0;
  uint64_t _blocks = 0;
  uint64_t _lastEndUs = 0;
  uint64_t _emptyLoops = 0;  // since the last one that found bytes
  uint64_t _lost = 0;
  uint64_t _lostLater = 0;      // after
  uint64_t _lostAfterRead = 0;  // so many bytes read
  uint64_t _droppedFull = 0;
};

}  // namespace

Tally simulate(const Run &run, Decoder decoder, uint64_t seed) {
  if (decoder == Decoder::Papers) {
    Run papers = run;
    if (run.setup.callsBack()) {
      papers.setup.polling = Polling::ByEvents;
      papers.setup.loopUs = 50;
    }
    return Simulation<Papers>(papers, seed).run();
  }
  return run.reads == Reads::Channels24   ? Simulation<Ours24>(run, seed).run()
         : run.reads == Reads::Channels32 ? Simulation<Ours32>(run, seed).run()
                                          : Simulation<Ours>(run, seed).run();
}
