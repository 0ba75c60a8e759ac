// A flight as one HTML page, to view, send and print.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "line/report/FlightLog.h"

namespace line {

struct ReportFacts {
  std::string name;                // the file's or port's
  std::string settings;            // the line's: "100000 baud, 8E2, inverted"
  std::optional<int64_t> startUs;  // time 0 in us since 1970
};

// The page needs no other file, is light or dark as the reader prefers, and prints on one sheet.
std::string htmlReport(const FlightLog &flight, const ReportFacts &facts);

}  // namespace line
