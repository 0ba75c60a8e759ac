#include "Report.h"

#include <cstdio>

namespace host {

namespace {

void reportLine(const LineMonitor &line, uint64_t nowUs) {
  std::fprintf(stderr,
               "%.3f s; on the line: %lu characters, %lu frames, of them %lu with lost frame, %lu with failsafe\n",
               static_cast<double>(nowUs) / 1e6, line.characters(), line.frames(), line.lostFrames(),
               line.failsafeFrames());
}

// Why the port did not receive all there was.
void reportPort(Board &board, int on) {
  const Port &port = board.port(on);
  if (!port.everOpened()) {
    std::fprintf(stderr, "Serial%d received nothing: the sketch never opened it\n", on);
    for (int other = 1; other <= Board::PortCount; other++) {
      if (board.port(other).everOpened()) {
        std::fprintf(stderr, "  it opened Serial%d: try --on %d\n", other, other);
      }
    }
    return;
  }
  if (port.missedSettings() > 0) {
    std::fprintf(stderr, "Serial%d missed %lu characters: the sketch set it to %s; the line is 100000 baud, 8E2%s\n",
                 on, port.missedSettings(), text(port.settings()).c_str(), port.lineInverted() ? ", inverted" : "");
  }
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
