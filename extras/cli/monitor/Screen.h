// Shows a page on the terminal with ncurses, which every Debian has and which also works without colours.
#pragma once

#include "cli/monitor/MonitorPage.h"

struct screen;  // from ncurses

namespace tool {

class Screen {
 public:
  // Returns true if standard output is a terminal with a movable cursor.
  static bool isPossible();

  Screen();   // throws std::runtime_error
  ~Screen();  // restores the terminal
  Screen(const Screen &) = delete;
  Screen &operator=(const Screen &) = delete;

  PageSize size() const;

  // Returns true if the locale has UTF-8.
  bool unicode() const { return _unicode; }

  void draw(const std::vector<PageRow> &page);

  // Returns the next pressed key, or 0 at once if no key was pressed.
  int key();

 private:
  screen *_screen;
  bool _unicode;
  bool _colours;
};

}  // namespace tool
