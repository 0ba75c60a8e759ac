// The terminal as a page, with ncurses: every Debian has it, and it can do without colours.
#pragma once

#include "cli/monitor/MonitorPage.h"

struct screen;  // ncurses' own

namespace tool {

class Screen {
 public:
  // True if standard output is a terminal whose cursor can be moved.
  static bool isPossible();

  Screen();   // throws std::runtime_error
  ~Screen();  // the terminal is as it was
  Screen(const Screen &) = delete;
  Screen &operator=(const Screen &) = delete;

  PageSize size() const;

  // By the locale.
  bool unicode() const { return _unicode; }

  void draw(const std::vector<PageRow> &page);

  // The next key pressed, or 0. Never waits.
  int key();

 private:
  screen *_screen;
  bool _unicode;
  bool _colours;
};

}  // namespace tool
