// Shows a page on the terminal, with ncurses: every Debian has it, and it works without colours.
#pragma once

#include "cli/monitor/MonitorPage.h"

struct screen;  // ncurses' own

namespace tool {

class Screen {
 public:
  // Returns true if standard output is a terminal whose cursor can be moved.
  static bool isPossible();

  Screen();   // throws std::runtime_error
  ~Screen();  // restores the terminal
  Screen(const Screen &) = delete;
  Screen &operator=(const Screen &) = delete;

  PageSize size() const;

  // Returns true if the locale has UTF-8.
  bool unicode() const { return _unicode; }

  void draw(const std::vector<PageRow> &page);

  // Returns the next key pressed, or 0. Never waits.
  int key();

 private:
  screen *_screen;
  bool _unicode;
  bool _colours;
};

}  // namespace tool
