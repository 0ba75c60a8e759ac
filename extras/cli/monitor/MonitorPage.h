// Lays a MonitorView out as rows of text, for a terminal of any size or a pipe. It does not access the terminal.
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

// Returns up to `size.height` rows of up to `size.width` columns each; ASCII only without `unicode`. `note`, such
// as "PAUSED: space continues", replaces the keys in the last row.
std::vector<PageRow> layOut(const MonitorView &view, PageSize size, bool unicode, const std::string &note);

// Returns the page that explains the keys and the terms.
std::vector<PageRow> layOutHelp(PageSize size);

// Returns the view in a line: "12.000  ok  992 172 ...  CH18  newest 3 ms old, 111 frames/s, ...".
std::string plainLine(const MonitorView &view, int64_t nowUs);

}  // namespace tool
