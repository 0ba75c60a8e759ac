// A flight as one page of HTML, to look at, to send and to print.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "line/report/FlightLog.h"

namespace line {

struct ReportFacts {
  std::string name;                // of the file or port
  std::string settings;            // of the line: "100000 baud, 8E2, inverted"
  std::optional<int64_t> startUs;  // when time 0 was, in us since 1970
};

// The page needs no other file, and is light or dark as the reader likes it; it prints on one sheet.
std::string htmlReport(const FlightLog &flight, const ReportFacts &facts);

}  // namespace line
