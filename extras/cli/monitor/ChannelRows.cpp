#include "cli/monitor/ChannelRows.h"

#include <cstdio>

#include "cli/TerminalText.h"
#include "cli/monitor/Bar.h"

namespace tool {

namespace {

// Widths in columns.
constexpr int Gap = 1;  // before the next channel
constexpr int WithMargin = 24;
constexpr int Us = 5;
constexpr int Percent = 7;
constexpr int LeastBar = 10;

std::string percentText(uint16_t raw, const sbus::Range &range) {
  char text[16];
  const int thousandths = sbus::toNormalised(raw, range);
  std::snprintf(text, sizeof text, "%+.1f", thousandths / 10.0);
  return thousandths == 0 ? "0.0" : text;
}

std::string numberText(double value, bool isRaw) {
  char text[32];
  std::snprintf(text, sizeof text, isRaw ? "%.0f" : "%.6g", value);
  return text;
}

}  // namespace

ChannelRows::ChannelRows(const MonitorView &view, int width, bool unicode)
    : _view(view), _width(width), _unicode(unicode), _name(width < WithMargin ? 2 : 3), _value(view.isRaw ? 5 : 9) {
  int left = width - Gap - _name - _value;
  const auto take = [&left](int wanted, int kept) {
    const bool room = left >= wanted + kept;
    left -= room ? wanted : 0;
    return room;
  };
  _hasUs = view.isRaw && take(Us, 0);
  _hasPercent = view.isRaw && take(Percent, 0);
  const bool hasBar = left > LeastBar;
  _hasMarks = hasBar && take(2 * _value, LeastBar + 12);
  _bar = hasBar ? left - 1 : 0;
}

PageRow ChannelRows::head(int columns) const {
  std::string text = right("CH", _name) + right(_view.isRaw ? "raw" : "value", _value);
  text += _hasUs ? right(_unicode ? "µs" : "us", Us) : "";
  text += _hasPercent ? right("%", Percent) : "";
  text += _bar > 0 ? " " + Bar(_view, _bar, _unicode).scale() : "";
  text += _hasMarks ? right("min", _value) + right("max", _value) : "";
  return PageRow(static_cast<size_t>(columns), {padded(text, _width), Style::Dim});
}

void ChannelRows::append(PageRow &row, size_t index) const {
  const MonitorView::Channel &channel = _view.channels[index];
  const bool none = channel.text.empty();
  const auto raw = static_cast<uint16_t>(none || !_view.isRaw ? 0 : channel.value);
  row.push_back({right(std::to_string(index + 1), _name), Style::Dim});
  row.push_back({right(none ? "-" : channel.text, _value), _view.old ? Style::Dim : Style::Strong});
  std::string numbers;
  if (_hasUs) {
    numbers += right(none ? "-" : std::to_string(sbus::toMicroseconds(raw, _view.pulses)), Us);
  }
  if (_hasPercent) {
    numbers += right(none ? "-" : percentText(raw, _view.range), Percent);
  }
  row.push_back({numbers, _view.old ? Style::Dim : Style::Plain});
  if (_bar > 0) {
    row.push_back({" ", Style::Plain});
    Bar(_view, _bar, _unicode).append(row, channel);
  }
  if (_hasMarks) {
    const auto mark = [&](double value) {
      return right(channel.marked ? numberText(value, _view.isRaw) : "-", _value);
    };
    row.push_back({mark(channel.low) + mark(channel.high), Style::Dim});
  }
  row.push_back({std::string(Gap, ' '), Style::Plain});
}

}  // namespace tool
