#include "Report.h"

#include <cstdio>

namespace host {

namespace {

using Number = unsigned long;

void reportLine(LineMonitor &line, uint64_t nowUs) {
  line.settle(nowUs);
  const sbus::Counters &counters = line.counters();
  std::fprintf(stderr, "%.3f s; on the line: %lu characters", static_cast<double>(nowUs) / 1e6, line.characters());
  if (line.badCharacters() > 0) {
    std::fprintf(stderr, " (%lu bad)", line.badCharacters());
  }
  std::fprintf(stderr, ", %lu frames, of them %lu with lost frame, %lu with failsafe\n", Number{counters.frames},
               Number{counters.lostFrames}, Number{counters.failsafeFrames});
}

// What the port made of the line with each of the settings that it had.
void reportReceptions(const Port &port, int on) {
  for (const Reception &reception : port.receptions()) {
    std::fprintf(stderr, "Serial%d at %s: %lu characters came, %lu good, %lu bad", on, text(reception.settings).c_str(),
                 reception.sent, reception.good, reception.bad);
    const std::string wrong = mismatch(reception.settings, port.wire());
    if (!wrong.empty()) {
      std::fprintf(stderr, "; wrong %s: the line is %s", wrong.c_str(),
                   text(port.wire()).c_str());
    }
    std::fputc('\n', stderr);
  }
}

// Why the port did not receive all there was.
void reportPort(Board &board, int on) {
  Port &port = board.port(on);
  if (!port.everOpened()) {
    std::fprintf(stderr, "Serial%d received nothing: the sketch never opened it\n", on);
    for (int other = 1; other <= Board::PortCount; other++) {
      if (board.port(other).everOpened()) {
        std::fprintf(stderr, "  it opened Serial%d: try --on %d\n", other, other);
      }
    }
    return;
  }
  reportReceptions(port, on);
  if (port.missedClosed() > 0) {
    std::fprintf(stderr, "Serial%d was closed while %lu characters came\n", on, port.missedClosed());
  }
  std::fprintf(stderr, "Serial%d dropped %lu bytes with a wrong parity or stop bit, %lu because its buffer was full\n",
               on, port.uart().droppedBad(), port.uart().droppedFull());
}

void reportOutput(const SketchOutput &output) {
  if (output.lostBeforeBegin() > 0) {
    std::fprintf(stderr, "the sketch printed %lu bytes before Serial.begin(): they are lost\n",
                 output.lostBeforeBegin());
  }
  std::fprintf(stderr, "the sketch printed %lu lines", output.columns().lines());
  unsigned number = 0;
  for (const CsvColumns::Range &range : output.columns().columns()) {
    number++;
    if (range.any) {
      std::fprintf(stderr, "%s %u: %s..%s", number == 1 ? "; columns" : ",", number, range.lowText.c_str(),
                   range.highText.c_str());
    }
  }
  std::fputc('\n', stderr);
}

}  // namespace

void printReport(Board &board, int on) {
  reportLine(board.port(on).monitor(), board.clock().nowUs());
  reportPort(board, on);
  reportOutput(board.output());
}

}  // namespace host
