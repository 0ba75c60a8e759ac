#include "cli/monitor/MonitorPage.h"

#include <algorithm>
#include <cstdio>

#include "cli/TerminalText.h"
#include "cli/monitor/ChannelRows.h"

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
    const ChannelRows channels(_view, _size.width / _columns, _unicode);
    if (head) {
      _page.push_back(channels.head(_columns));
    }
    this->channels(channels);
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

  void channels(const ChannelRows &channels) {
    for (int row = 0; row < _rows; row++) {
      space(_grouped && row > 0 && row % GroupSize == 0);
      PageRow cells;
      for (int column = 0; column < _columns; column++) {
        const size_t index = static_cast<size_t>(column * _rows + row);
        if (index < _view.channels.size()) {
          channels.append(cells, index);
        }
      }
      _page.push_back(cells);
    }
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
    if (widthOf(_view.quality) <= left) {
      row.push_back({_view.quality, Style::Plain});
    }
    _page.push_back(row);
  }

  // Returns a row for each group while there is room, with the facts that fit, and its name on a wide page.
  std::vector<PageRow> makeFacts() {
    constexpr int NameWidth = 10;
    constexpr int WithNames = 90;
    const std::string between = "  ";
    std::vector<PageRow> rows;
    for (const MonitorView::Group &group : _view.groups) {
      const std::string name = _size.width < WithNames ? " " : padded(" " + group.name, NameWidth);
      std::string text;
      for (const std::string &fact : group.facts) {
        if (widthOf(name + text + between + fact) < _size.width) {
          text += (text.empty() ? "" : between) + fact;
        }
      }
      if (rows.empty() || take(1)) {
        rows.push_back({{name, Style::Dim}, {text, Style::Plain}});
      }
    }
    return rows;
  }

  const MonitorView &_view;
  const PageSize _size;
  const bool _unicode;
  int _columns = 0;
  int _rows = 0;   // rows of channels
  int _spare = 0;  // rows still free
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
      "space  pause; the counters keep running",
      "?      this page; any key goes back",
      "[ ]    lowest, highest since the reset;",
      "       frames with a flag do not count",
      "%      of --range; us: a servo's pulse",
      "gap    from a frame's end to the next's",
      "lost by radio: lost-frame flag, old values",
      "failsafe: the receiver lost the link",
      "rejected: like a frame, but not one",
  };
  std::vector<PageRow> page;
  for (const char *each : lines) {
    if (static_cast<int>(page.size()) < size.height) {
      page.push_back({{cut(each, size.width), Style::Plain}});
    }
  }
  return page;
}

std::string plainLine(const MonitorView &view, int64_t nowUs) {
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
