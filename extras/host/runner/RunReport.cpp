#include "Options.h"

#include <algorithm>
#include <cstdio>

#include "board/Board.h"

namespace host {

namespace {

using Number = unsigned long;

// Prints "25 characters, 1 frame, of them 0 with lost frame, 0 with failsafe".
void reportTraffic(line::Observer &observer, uint64_t nowUs) {
  observer.idleUntil(nowUs);
  const sbus::Counters &counters = observer.counters();
  std::fprintf(stderr, "%lu characters", observer.characters());
  if (observer.characterErrors() > 0) {
    std::fprintf(stderr, " (%lu with errors)", observer.characterErrors());
  }
  std::fprintf(stderr, ", %s, of them %lu with lost frame, %lu with failsafe", observer.frames().c_str(),
               Number{counters.lostFrames}, Number{counters.failsafeFrames});
  if (counters.extraFrames > 0) {
    std::fprintf(stderr, ", and %lu with CH17..CH32", Number{counters.extraFrames});
  }
}

// Prints what was received with these settings of port and line.
void reportReception(const Reception &reception, int number) {
  std::fprintf(stderr, "Serial%d at %s: %lu characters arrived, %lu good, %lu with errors", number,
               text(reception.settings.rx).c_str(), reception.sent, reception.good, reception.bad);
  const std::string wrong = mismatch(reception.settings.rx, reception.wire);
  if (!wrong.empty()) {
    std::fprintf(stderr, "; wrong %s: the line is %s", wrong.c_str(), text(reception.wire).c_str());
  }
  std::fputc('\n', stderr);
}

// Prints why the port did not receive all characters.
void reportLosses(const BoardPort &port, int number) {
  if (port.missedClosed() > 0) {
    std::fprintf(stderr, "Serial%d was closed while %lu characters arrived\n", number, port.missedClosed());
  }
  if (port.everOpened()) {
    std::fprintf(stderr,
                 "Serial%d dropped %lu bytes with a wrong parity or stop bit, %lu because its buffer was full\n",
                 number, port.uart().droppedBad(), port.uart().droppedFull());
  }
}

// Prints that onReceive() has replaced somebody's callback: two decoders on one port, most often.
void reportListeners(Board &board) {
  for (int number = 1; number <= Board::PortCount; number++) {
    if (board.port(number).changedListener()) {
      std::fprintf(stderr,
                   "Serial%d calls only its last listener: a second decoder, or an onReceive() of the sketch, has "
                   "replaced the first\n",
                   number);
    }
  }
}

// Reports the port with the line.
void reportLine(Board &board, int on) {
  BoardPort &port = board.port(on);
  if (port.everOpened()) {
    for (const Reception &reception : port.receptions()) {
      reportReception(reception, on);
    }
    reportLosses(port, on);
    return;
  }
  std::fprintf(stderr, "Serial%d received nothing: the sketch never opened it\n", on);
  for (int other = 1; other <= Board::PortCount; other++) {
    if (board.port(other).everOpened()) {
      std::fprintf(stderr, "  it opened Serial%d: try --on %d\n", other, other);
    }
  }
}

// Reports a port that is wired to another one.
void reportWire(Board &board, const WireOption &wire) {
  const BoardPort &port = board.port(wire.to);
  const bool any = std::any_of(port.receptions().begin(), port.receptions().end(),
                               [](const Reception &reception) { return reception.sent > 0; });
  if (!any) {
    std::fprintf(stderr, "Serial%d received nothing: %s\n", wire.to,
                 port.everOpened() ? "nothing was sent while it was open" : "the sketch never opened it");
  }
  for (const Reception &reception : port.receptions()) {
    if (reception.sent > 0) {
      reportReception(reception, wire.to);
    }
  }
  reportLosses(port, wire.to);
}

// Reports a port that sent something, or should have.
void reportSender(Board &board, int number, bool recorded) {
  bool any = false;
  for (Transmission &sent : board.port(number).sender().transmissions()) {
    if (sent.observer.characters() == 0) {
      continue;
    }
    any = true;
    std::fprintf(stderr, "Serial%d sent at %s: ", number, text(sent.settings.tx).c_str());
    reportTraffic(sent.observer, board.clock().nowUs());
    const unsigned long period = sent.observer.counters().period;
    if (period > 0) {
      std::fprintf(stderr, ", one every %lu us", period);
    }
    std::fputc('\n', stderr);
  }
  if (recorded && !any) {
    std::fprintf(stderr, "Serial%d sent nothing\n", number);
  }
}

void reportSenders(Board &board, const Options &options) {
  for (int number = 1; number <= Board::PortCount; number++) {
    const bool recorded = std::any_of(options.sent.begin(), options.sent.end(),
                                      [number](const SentOption &sent) { return sent.port == number; });
    reportSender(board, number, recorded);
  }
}

void reportPins(const Pins &pins) {
  // Indexed by Pins::Way, with the unit of a value.
  constexpr const char *Names[][2] = {
      {"digitalWrite()", ""}, {"analogWrite()", ""}, {"tone()", " Hz"}, {"servo", " us"}};
  for (const auto &[key, use] : pins.uses()) {
    const auto &[way, pin] = key;
    const auto &[name, unit] = Names[way];
    if (use.times == 0) {
      std::fprintf(stderr, "%s at pin %u: never set\n", name, pin);
    } else {
      std::fprintf(stderr, "%s at pin %u: %d..%d%s, %lu times set\n", name, pin, use.low, use.high, unit, use.times);
    }
  }
}

void reportOutput(const SketchOutput &output) {
  if (output.lostBeforeBegin() > 0) {
    std::fprintf(stderr, "the sketch printed %lu bytes before Serial.begin(): they are lost\n",
                 output.lostBeforeBegin());
  }
  std::fprintf(stderr, "the sketch printed %lu lines\n", output.lines());
}

// Prints why a recording has brought no output: most sketches print a few times a second, and only while frames come.
void reportSilence(Board &board, const Options &options) {
  constexpr uint64_t ShortUs = 1000000;
  if (options.source.isSimulated() || options.on == 0 || board.output().lines() > 0) {
    return;
  }
  if (board.port(options.on).observer().counters().frames == 0) {
    std::fprintf(stderr, "the line has no frame; SKETCH=examples/Diagnose says what is wrong with a line\n");
  } else if (board.clock().nowUs() < ShortUs) {
    std::fprintf(stderr,
                 "the recording ends before this sketch prints: the examples print every 0.2 s, and only while frames "
                 "come. Record a second or more\n");
  }
}

}  // namespace

void printReport(Board &board, const Options &options) {
  const uint64_t nowUs = board.clock().nowUs();
  std::fprintf(stderr, "%.3f s", static_cast<double>(nowUs) / 1e6);
  if (options.on != 0) {
    std::fprintf(stderr, "; on the line: ");
    reportTraffic(board.port(options.on).observer(), nowUs);
  }
  if (options.second) {
    std::fprintf(stderr, "; on the second: ");
    reportTraffic(board.port(SecondPort).observer(), nowUs);
  }
  std::fputc('\n', stderr);
  for (const int number : {options.on, options.second ? SecondPort : 0}) {
    if (number != 0) {
      reportLine(board, number);
    }
  }
  reportListeners(board);
  for (const WireOption &wire : options.wires) {
    reportWire(board, wire);
  }
  reportSenders(board, options);
  reportPins(board.pins());
  reportOutput(board.output());
  reportSilence(board, options);
}

}  // namespace host
