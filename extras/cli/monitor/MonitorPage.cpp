#include "cli/monitor/MonitorPage.h"

#include <algorithm>
#include <cstdio>

#include "cli/monitor/Bar.h"
#include "cli/TerminalText.h"

namespace tool {

namespace {

constexpr int MostColumns = 4;
constexpr int KeysRow = 1;

Style styleOf(Mood mood) {
  return mood == Mood::Good   ? Style::Good
         : mood == Mood::Warn ? Style::Warn
         : mood == Mood::Bad  ? Style::Bad
                              : Style::Dim;
}

// Returns what of a channel has room in this many columns.
struct Cells {
  explicit Cells(int width, bool isRaw) : name(width < WithMargin ? 2 : 3), value(isRaw ? 5 : 9) {
    int left = width - Gap - name - value;
    const auto take = [&left](int wanted, int kept) {
      const bool room = left >= wanted + kept;
      left -= room ? wanted : 0;
      return room;
    };
    us = isRaw && take(Us, 0);
    percent = isRaw && take(Percent, 0);
    const bool hasBar = left > LeastBar;
    marks = hasBar && take(2 * value, LeastBar + 12);
    bar = hasBar ? left - 1 : 0;
  }

  static constexpr int Gap = 1;  // to the next column
  static constexpr int WithMargin = 24;
  static constexpr int Us = 5;
  static constexpr int Percent = 7;
  static constexpr int LeastBar = 10;

  int name;
  int value;
  bool us;
  bool percent;
  bool marks;
  int bar;
};

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

class Layout {
 public:
  Layout(const MonitorView &view, PageSize size, bool unicode) : _view(view), _size(size), _unicode(unicode) {
    const int count = static_cast<int>(view.channels.size());
    constexpr int Fixed = 4;  // title, banner, indicators, a row of facts
    do {
      _columns++;
      _rows = (count + _columns - 1) / _columns;
    } while (_columns < MostColumns && _rows + Fixed > size.height);
    _rows = std::min(_rows, size.height - Fixed);
    _cellWidth = size.width / _columns;
    _spare = size.height - Fixed - _rows;
  }

  std::vector<PageRow> make(const std::string &note) {
    const bool keys = take(KeysRow);
    const bool head = take(1);
    const std::vector<PageRow> facts = makeFacts();
    const bool afterBanner = take(1);
    const bool beforeIndicators = take(1);
    const bool beforeKeys = keys && take(1);
    const int groups = (_rows - 1) / GroupSize;
    _grouped = groups > 0 && take(groups);
    title(keys ? std::string() : note);
    banner();
    space(afterBanner);
    if (head) {
      this->head();
    }
    channels();
    space(beforeIndicators);
    indicators();
    _page.insert(_page.end(), facts.begin(), facts.end());
    space(beforeKeys);
    if (keys) {
      _page.resize(static_cast<size_t>(_size.height - 1));  // in the last row
      _page.push_back({{cut(note.empty() ? " q quit   r reset   space pause   ? help" : " " + note, _size.width),
                        note.empty() ? Style::Dim : Style::Warn}});
    }
    return _page;
  }

 private:
  static constexpr int GroupSize = 4;  // channels

  bool take(int rows) {
    const bool room = _spare >= rows;
    _spare -= room ? rows : 0;
    return room;
  }

  void space(bool wanted) {
    if (wanted) {
      _page.emplace_back();
    }
  }

  std::string indicator(bool on) const { return _unicode ? (on ? "●" : "○") : on ? "(*)" : "( )"; }

  void title(const std::string &note) {
    const std::string state = indicator(true) + " " + _view.state + " ";
    const int room = _size.width - widthOf(state);
    const std::string name = cut(" " + _view.source, room - 1);
    const int left = room - widthOf(name);
    const std::string kind = note.empty() ? _view.kind : cutAtPhrase(note, left - 5);
    _page.push_back(
        {{name, Style::Strong},
         {padded(widthOf(kind) + 4 < left ? "   " + kind : "", left), note.empty() ? Style::Dim : Style::Warn},
         {state, styleOf(_view.mood)}});
  }

  void banner() {
    const Style style = _view.bannerMood == Mood::Bad ? Style::BadBanner : Style::WarnBanner;
    const std::string text = " " + cutAtPhrase(_view.banner, _size.width - 1);
    _page.push_back({{_view.banner.empty() ? "" : padded(text, _size.width), style}});
  }

  void head() {
    PageRow row;
    const Cells cells(_cellWidth, _view.isRaw);
    std::string text = right("CH", cells.name) + right(_view.isRaw ? "raw" : "value", cells.value);
    text += cells.us ? right(_unicode ? "µs" : "us", Cells::Us) : "";
    text += cells.percent ? right("%", Cells::Percent) : "";
    text += cells.bar > 0 ? " " + Bar(_view, cells.bar, _unicode).scale() : "";
    text += cells.marks ? right("min", cells.value) + right("max", cells.value) : "";
    for (int column = 0; column < _columns; column++) {
      row.push_back({padded(text, _cellWidth), Style::Dim});
    }
    _page.push_back(row);
  }

  void channels() {
    for (int row = 0; row < _rows; row++) {
      space(_grouped && row > 0 && row % GroupSize == 0);
      PageRow cells;
      for (int column = 0; column < _columns; column++) {
        const size_t index = static_cast<size_t>(column * _rows + row);
        if (index < _view.channels.size()) {
          channel(cells, index);
        }
      }
      _page.push_back(cells);
    }
  }

  void channel(PageRow &row, size_t index) const {
    const MonitorView::Channel &channel = _view.channels[index];
    const Cells cells(_cellWidth, _view.isRaw);
    const bool none = channel.text.empty();
    const auto raw = static_cast<uint16_t>(none || !_view.isRaw ? 0 : channel.value);
    row.push_back({right(std::to_string(index + 1), cells.name), Style::Dim});
    row.push_back({right(none ? "-" : channel.text, cells.value), _view.old ? Style::Dim : Style::Strong});
    std::string numbers;
    if (cells.us) {
      numbers += right(none ? "-" : std::to_string(sbus::toMicroseconds(raw, _view.pulses)), Cells::Us);
    }
    if (cells.percent) {
      numbers += right(none ? "-" : percentText(raw, _view.range), Cells::Percent);
    }
    row.push_back({numbers, _view.old ? Style::Dim : Style::Plain});
    if (cells.bar > 0) {
      row.push_back({" ", Style::Plain});
      Bar(_view, cells.bar, _unicode).append(row, channel);
    }
    if (cells.marks) {
      const auto mark = [&](double value) {
        return right(channel.marked ? numberText(value, _view.isRaw) : "-", cells.value);
      };
      row.push_back({mark(channel.low) + mark(channel.high), Style::Dim});
    }
    row.push_back({std::string(Cells::Gap, ' '), Style::Plain});
  }

  void indicators() {
    PageRow row = {{" ", Style::Plain}};
    int left = _size.width - 1;
    for (const MonitorView::Indicator &each : _view.indicators) {
      std::string text = indicator(each.on) + " " + each.name;
      left -= widthOf(text);
      if (left < 0) {
        break;
      }
      row.push_back({text, each.on ? styleOf(each.mood) : Style::Dim});
      const int gap = std::min(left, _size.width < 60 ? 1 : 3);
      row.push_back({std::string(static_cast<size_t>(gap), ' '), Style::Plain});
      left -= gap;
    }
    _page.push_back(row);
  }

  // With their names if there is room for all, else as many as fit.
  std::vector<PageRow> makeFacts() {
    constexpr int NameWidth = 9;
    std::vector<PageRow> rows;
    bool fits = true;
    for (const MonitorView::Group &group : _view.groups) {
      int left = _size.width - NameWidth;
      std::string text;
      for (const std::string &fact : group.facts) {
        text += (text.empty() ? "" : "   ") + fact;
      }
      fits = fits && widthOf(text) < left;
      rows.push_back({{padded(" " + group.name, NameWidth + 1), Style::Dim}, {text, Style::Plain}});
    }
    if (fits && static_cast<int>(rows.size()) <= _spare + 1) {
      _spare -= static_cast<int>(rows.size()) - 1;
      return rows;
    }
    rows.clear();
    std::string text;
    for (const MonitorView::Group &group : _view.groups) {
      for (const std::string &fact : group.facts) {
        if (!text.empty() && widthOf(text) + 2 + widthOf(fact) >= _size.width) {
          rows.push_back({{" " + cut(text, _size.width - 1), Style::Plain}});
          text.clear();
        }
        text += (text.empty() ? "" : "  ") + fact;
      }
    }
    rows.push_back({{" " + cut(text, _size.width - 1), Style::Plain}});
    rows.resize(std::min(rows.size(), static_cast<size_t>(_spare + 1)));
    _spare -= static_cast<int>(rows.size()) - 1;
    return rows;
  }

  const MonitorView &_view;
  const PageSize _size;
  const bool _unicode;
  int _columns = 0;
  int _rows = 0;  // of channels
  int _cellWidth = 0;
  int _spare = 0;  // rows not taken yet
  bool _grouped = false;
  std::vector<PageRow> _page;
};

}  // namespace

std::vector<PageRow> layOut(const MonitorView &view, PageSize size, bool unicode, const std::string &note) {
  if (size.width < LeastPage.width || size.height < LeastPage.height) {
    const std::string text = "needs 40x12, has " + std::to_string(size.width) + "x" + std::to_string(size.height);
    return {{{cut(text, size.width), Style::Plain}}};
  }
  return Layout(view, size, unicode).make(note);
}

std::vector<PageRow> layOutHelp(PageSize size) {
  const char *const lines[] = {
      "q      quit; so does Ctrl-C",
      "r      reset marks and counters",
      "space  pause; the counters go on",
      "?      this page, and back",
      "[ ]    least and most since the reset;",
      "       frames with a flag do not count",
      "%      of --range; us: a servo's pulse",
      "gap    from a frame's end to the next's",
      "lost by radio: lost-frame flag, old values",
      "failsafe: the receiver has given up",
      "rejected: looked like a frame, was none",
      "Any key goes back.",
  };
  std::vector<PageRow> page;
  for (const char *each : lines) {
    if (static_cast<int>(page.size()) < size.height) {
      page.push_back({{cut(each, size.width), Style::Plain}});
    }
  }
  return page;
}

std::string plainLine(const MonitorView &view, uint64_t nowUs) {
  char time[32];
  std::snprintf(time, sizeof time, "%.3f", static_cast<double>(nowUs) / 1e6);
  std::string text = std::string(time) + "  " + view.state + " ";
  for (const MonitorView::Channel &channel : view.channels) {
    text += " " + (channel.text.empty() ? "-" : channel.text);
  }
  text += " ";
  for (const MonitorView::Indicator &indicator : view.indicators) {
    text += indicator.on ? " " + indicator.name : "";
  }
  return text + "  " + view.plain + (view.banner.empty() ? "" : "  " + view.banner) + "\n";
}

}  // namespace tool
