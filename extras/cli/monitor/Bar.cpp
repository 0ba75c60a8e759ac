#include "cli/monitor/Bar.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sbus/Frame.h"

namespace tool {

namespace {

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

}  // namespace

Bar::Bar(const MonitorView &view, int width, bool unicode) : _view(view), _width(width), _unicode(unicode) {
  if (view.isRaw) {
    _high = sbus::ChannelMax;
    return;
  }
  bool first = true;
  for (const MonitorView::Channel &channel : view.channels) {
    const double low = channel.marked ? channel.low : channel.value;
    const double high = channel.marked ? channel.high : channel.value;
    _low = first ? low : std::min(_low, low);
    _high = first ? high : std::max(_high, high);
    first = false;
  }
}

int Bar::at(double value) const {
  if (!(_high > _low)) {
    return 0;
  }
  const double part = std::clamp((value - _low) / (_high - _low), 0.0, 1.0);
  return static_cast<int>(std::lround(part * (_width - 1)));
}

std::string Bar::scale() const {
  std::string row(static_cast<size_t>(_width), ' ');
  if (!_view.isRaw) {
    char low[24];
    char high[24];
    std::snprintf(low, sizeof low, "%.4g", _low);
    std::snprintf(high, sizeof high, "%.4g", _high);
    put(row, 0, low);
    put(row, _width, high);
    return row;
  }
  const bool wide = _width >= 24;
  put(row, at(_view.range.low) - (wide ? 2 : 1), wide ? "-100" : "-");
  put(row, at(_view.range.centre), "0");
  put(row, at(_view.range.high) - (wide ? 2 : 0), wide ? "+100" : "+");
  return row;
}

void Bar::append(PageRow &row, const MonitorView::Channel &channel) const {
  std::vector<Sign> signs(static_cast<size_t>(_width), _view.isRaw ? Sign::Beyond : Sign::Track);
  const auto set = [&signs](int position, Sign sign) { signs[static_cast<size_t>(position)] = sign; };
  const int centre = _view.isRaw ? at(_view.range.centre) : 0;
  if (_view.isRaw) {
    const auto [left, right] = std::minmax({at(_view.range.low), at(_view.range.high)});
    std::fill(signs.begin() + left, signs.begin() + right, Sign::Track);
    set(left, Sign::Left);
    set(right, Sign::Right);
  }
  if (!channel.text.empty()) {
    const int value = at(channel.value);
    std::fill(signs.begin() + std::min(value, centre), signs.begin() + std::max(value, centre), Sign::Fill);
  }
  if (_view.isRaw) {
    set(centre, Sign::Centre);
  }
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

}  // namespace tool
