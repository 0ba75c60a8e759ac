// A DecodeSBus on a port that calls back, and a line that runs at its own pace, whatever the sketch does.
#pragma once

#include <DecodeSBus.h>

#include "Bytes.h"
#include "FakeClock.h"
#include "KnownFrames.h"
#include "UartPort.h"

template <typename Decoder = DecodeSBus, typename CallingPort = ::CallingPort>
struct ListeningBoardOf {
  static constexpr uint32_t CharacterUs = 120;

  CallingPort port;
  Decoder sbus{port};
  uint64_t heldUpUs = 0;         // how late PendSV's calls are
  bool isHeld = false;           // PendSV does not run
  uint64_t maskedUs = 0;         // of each ms: interrupts are masked
  bool losesEvents = false;      // PendSV's queue is full
  std::function<void()> called;  // after each call

  // Is in STM32L0.sleep() from now on, or no longer. Interrupts still run.
  void sleep(bool isAsleep) {
    _isAsleep = isAsleep;
    if (isAsleep) {
      fakeFallAsleep();
    }
  }

  // Lets time pass on a silent line.
  void pass(uint64_t us) {
    go(us, [this] { port.advance(fakeMicros); });
  }

  // Sends characters, one directly after the other. That at index `bad` has a wrong parity.
  void send(const Bytes &bytes, size_t bad = SIZE_MAX) {
    for (size_t i = 0; i < bytes.size(); i++) {
      go(CharacterUs, [] {});
      line::Character character{fakeMicros, bytes[i]};
      character.bad = i == bad;
      port.receive(character);
      callBack();
    }
  }

  // Sends a frame, and the silence until the next one begins.
  void frame(const Bytes &bytes, uint64_t periodUs) {
    send(bytes);
    pass(periodUs - CharacterUs * bytes.size());
  }

 private:
  template <typename Work>
  void go(uint64_t us, const Work &work) {
    constexpr uint64_t Step = 10;
    for (const uint64_t untilUs = fakeMicros + us; fakeMicros < untilUs;) {
      const uint64_t step = std::min(Step, untilUs - fakeMicros);
      if (maskedUs != 0) {
        _isMasked = fakeMicros % 1000 < maskedUs;
        port.mask(_isMasked);
      }
      if (_isAsleep) {
        fakeSleep(step);
      } else {
        fakeMicros += step;
      }
      work();
      callBack();
    }
  }

  void callBack() {
    if (!_hasEvent) {
      _hasEvent = port.takeEvent(losesEvents);
      _dueUs = fakeMicros + heldUpUs;
    }
    if (isHeld || _isMasked) {
      return;
    }
    if (_hasEvent && fakeMicros >= _dueUs) {
      _hasEvent = false;
      port.call();
      if (called) {
        called();
      }
      callBack();
    }
  }

  bool _isAsleep = false;
  bool _isMasked = false;
  bool _hasEvent = false;
  uint64_t _dueUs = 0;
};

using ListeningBoard = ListeningBoardOf<>;
