#include "cli/monitor/Screen.h"

#include <curses.h>
#include <term.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "cli/Output.h"
#include "line/system/System.h"

namespace tool {

namespace {

// How a style looks. Without colours (monochrome terminal, or NO_COLOR is set) only the attributes `plain` are used.
struct Look {
  Style style;
  short text;
  short ground;
  attr_t coloured;
  attr_t plain;
};
const Look Looks[] = {
    {Style::Plain, -1, -1, A_NORMAL, A_NORMAL},
    {Style::Strong, -1, -1, A_BOLD, A_BOLD},
    {Style::Dim, -1, -1, A_DIM, A_NORMAL},
    {Style::Good, COLOR_GREEN, -1, A_NORMAL, A_BOLD},
    {Style::Warn, COLOR_YELLOW, -1, A_BOLD, A_BOLD},
    {Style::Bad, COLOR_RED, -1, A_BOLD, A_BOLD},
    {Style::WarnBanner, COLOR_BLACK, COLOR_YELLOW, A_NORMAL, A_REVERSE},
    {Style::BadBanner, COLOR_WHITE, COLOR_RED, A_BOLD, A_REVERSE},
};

short pairOf(Style style) { return static_cast<short>(static_cast<int>(style) + 1); }

}  // namespace

bool Screen::isPossible() {
  int error = 0;
  if (!line::HasTerminfo) {
    return isTerminal();
  }
  if (!isTerminal() || setupterm(nullptr, STDOUT_FILENO, &error) != OK) {
    return false;
  }
  const bool moves = cursor_address != nullptr;
  del_curterm(cur_term);
  return moves;
}

Screen::Screen() {
  _unicode = line::useTerminalLocale();
  FILE *const keys = isatty(STDIN_FILENO) != 0 ? stdin : std::fopen(line::Keyboard, "r");  // of monitor -
  _screen = keys == nullptr ? nullptr : newterm(nullptr, stdout, keys);
  if (_screen == nullptr) {
    throw std::runtime_error(
        "the terminal cannot show a page; set TERM to the terminal's type, or print lines instead: | cat");
  }
  cbreak();
  noecho();
  nonl();
  nodelay(stdscr, TRUE);
  keypad(stdscr, TRUE);
  leaveok(stdscr, TRUE);
  curs_set(0);
  _colours = std::getenv("NO_COLOR") == nullptr && has_colors() && start_color() == OK;
  if (_colours) {
    use_default_colors();
    for (const Look &look : Looks) {
      init_pair(pairOf(look.style), look.text, look.ground);
    }
  }
}

Screen::~Screen() {
  endwin();
  delscreen(_screen);
}

PageSize Screen::size() const { return {getmaxx(stdscr), getmaxy(stdscr)}; }

void Screen::draw(const std::vector<PageRow> &page) {
  erase();
  int y = 0;
  for (const PageRow &row : page) {
    move(y++, 0);
    for (const Span &span : row) {
      const Look &look = Looks[static_cast<int>(span.style)];
      attr_set(_colours ? look.coloured : look.plain, _colours ? pairOf(span.style) : short{0}, nullptr);
      addstr(span.text.c_str());
    }
  }
  attr_set(A_NORMAL, 0, nullptr);
  refresh();
}

int Screen::key() {
  const int key = getch();
  return key == ERR || key == KEY_RESIZE ? 0 : key;
}

}  // namespace tool
