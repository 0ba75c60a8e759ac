// Characters decoded by Saleae's Async Serial analyser, or by DSView's UART decoder. Logic 1 exports "Time
// [s],Value,Parity Error,Framing Error" (saleae/serial-analyzer, src/SerialAnalyzerResults.cpp:103), Logic 2 a table
// with a row for each character (name,type,start_time,duration, and "data" and "error" of SerialAnalyzer.cpp:240 to
// 256). The reader turns them back into the levels of a wire.
#pragma once

#include "line/capture/Capture.h"
#include "line/capture/CsvLayout.h"

namespace line {

class AsyncReader : public CaptureReader {
 public:
  // Returns true if a text begins like one of these tables.
  static bool isHead(std::string_view head);

  // `head` is the beginning of the text, which names the analysers; `baud` is the wire's; 0: derived from the distances
  // between the characters.
  AsyncReader(std::string_view head, LevelSink &sink, unsigned long baud);

  std::string put(std::string_view lines) override;
  std::string format() const override {
    return _columns.isDsView ? "DSView's table of characters" : "Saleae's table of characters";
  }

 private:
  static constexpr size_t None = TimeColumn::None;

  struct Row {
    bool isData = false;
    size_t analyser = None;
    double ns = 0;
    unsigned value = 0;
    bool parityWrong = false;
    bool stopWrong = false;
  };
  struct Wire {
    int64_t startNs = INT64_MIN;  // of the newest character
    int64_t changedNs = 0;
  };
  struct Columns {
    size_t name = None, type = None, value = None, error = None, parity = None, framing = None;
    size_t count = 0;
    TimeColumn time;
    bool isDsView = false;  // bytes in hexadecimal, without a name
  };
  static Columns columnsOf(std::string_view title);

  std::string read(std::string_view line, Row &row);
  std::string tell(const Row &row);

  Columns _columns;
  std::vector<std::string> _analysers;
  std::vector<Wire> _wires;  // of the analysers
  Fields _fields;
  double _bitNs = 0;
};

}  // namespace line
