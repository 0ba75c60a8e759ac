// Lays a MonitorView out as rows of text: for a terminal of any size, and for a pipe. It knows no terminal.
#pragma once

#include <string>
#include <vector>

#include "cli/monitor/MonitorView.h"

namespace tool {

enum class Style { Plain, Strong, Dim, Good, Warn, Bad, WarnBanner, BadBanner };

struct Span {
  std::string text;
  Style style;
};

using PageRow = std::vector<Span>;

struct PageSize {
  int width;
  int height;
};

constexpr PageSize LeastPage = {40, 12};

// `size.height` rows or less, each `size.width` columns or less. `unicode`: else all of it is ASCII. `note`, such as
// "PAUSED: space goes on", stands in the last row in the keys' place.
std::vector<PageRow> layOut(const MonitorView &view, PageSize size, bool unicode, const std::string &note);

// What the keys do and what the page shows.
std::vector<PageRow> layOutHelp(PageSize size);

// The view in a line: "12.000  receiving  992 172 ...  CH18  newest 3 ms old, 111 frames/s, ...".
std::string plainLine(const MonitorView &view, uint64_t nowUs);

}  // namespace tool
