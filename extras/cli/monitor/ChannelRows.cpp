#include "cli/monitor/ChannelRows.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/TerminalText.h"
#include "sbus/Frame.h"

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
  const int thousandths = sbus::toNormalized(raw, range);
  std::snprintf(text, sizeof text, "%+.1f", thousandths / 10.0);
  return thousandths == 0 ? "0.0" : text;
}

std::string numberText(double value, bool isRaw) {
  char text[32];
  std::snprintf(text, sizeof text, isRaw ? "%.0f" : "%.6g", value);
  return text;
}

enum class Sign { Beyond, Track, Left, Centre, Right, Fill, Low, High, Knob };

const char *text(Sign sign, bool unicode) {
  const char *const signs[][2] = {{" ", " "}, {"-", "─"}, {"+", "├"}, {"+", "┼"}, {"+", "┤"},
                                  {"=", "━"}, {"[", "["}, {"]", "]"}, {"#", "█"}};
  return signs[static_cast<int>(sign)][unicode ? 1 : 0];
}

void put(std::string &row, int at, const std::string &text) {
  const int from = std::clamp(at, 0, static_cast<int>(row.size() - text.size()));
  row.replace(static_cast<size_t>(from), text.size(), text);
}

// Draws a channel of raw values as a bar: its travel, its value, and its lowest and highest value so far.
class Bar {
 public:
  // `width` is in columns.
  Bar(const MonitorView &view, int width, bool unicode) : _view(view), _width(width), _unicode(unicode) {}

  // Returns the line above the bars: "-100 0 +100".
  std::string scale() const;

  void append(PageRow &row, const MonitorView::Channel &channel) const;

 private:
  int at(double value) const;

  const MonitorView &_view;
  int _width;
  bool _unicode;
};

int Bar::at(double value) const {
  return static_cast<int>(std::lround(std::clamp(value / sbus::ChannelMax, 0.0, 1.0) * (_width - 1)));
}

std::string Bar::scale() const {
  std::string row(static_cast<size_t>(_width), ' ');
  const bool wide = _width >= 24;
  put(row, at(_view.range.low) - (wide ? 2 : 1), wide ? "-100" : "-");
  put(row, at(_view.range.centre), "0");
  put(row, at(_view.range.high) - (wide ? 2 : 0), wide ? "+100" : "+");
  return row;
}

void Bar::append(PageRow &row, const MonitorView::Channel &channel) const {
  std::vector<Sign> signs(static_cast<size_t>(_width), Sign::Beyond);
  const auto set = [&signs](int position, Sign sign) { signs[static_cast<size_t>(position)] = sign; };
  const int centre = at(_view.range.centre);
  const auto [left, right] = std::minmax({at(_view.range.low), at(_view.range.high)});
  std::fill(signs.begin() + left, signs.begin() + right, Sign::Track);
  set(left, Sign::Left);
  set(right, Sign::Right);
  if (!channel.text.empty()) {
    const int value = at(channel.value);
    std::fill(signs.begin() + std::min(value, centre), signs.begin() + std::max(value, centre), Sign::Fill);
  }
  set(centre, Sign::Centre);
  if (channel.marked) {
    set(at(channel.low), Sign::Low);
    set(at(channel.high), Sign::High);
  }
  if (!channel.text.empty()) {
    set(at(channel.value), Sign::Knob);
  }
  const Style lit = _view.old ? Style::Dim : _view.state == "failsafe" ? Style::Bad : Style::Good;
  for (const Sign sign : signs) {
    const Style style = sign == Sign::Fill || sign == Sign::Knob  ? lit
                        : sign == Sign::Low || sign == Sign::High ? Style::Plain
                                                                  : Style::Dim;
    if (row.back().style != style) {
      row.push_back({"", style});
    }
    row.back().text += text(sign, _unicode);
  }
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
  const bool hasBar = view.isRaw && left > LeastBar;
  _hasMarks = left > LeastBar && take(2 * _value, hasBar ? LeastBar + 12 : 0);
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
