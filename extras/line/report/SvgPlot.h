// Draws curves as an SVG that is light on a light page and dark on a dark one.
#pragma once

#include <string>
#include <vector>

#include "line/report/FlagSpans.h"

namespace line {

struct Curve {
  struct Point {
    double x, y;
    bool joined;  // to the point before it
  };
  std::string name;
  std::vector<Point> points;  // x grows
};

struct ShadedTime {
  FlagSpan::Kind kind;
  double from, to;
};

struct Picture {
  std::string title;
  std::string xTitle;  // "ms"
  std::string yTitle;
  std::vector<Curve> curves;
  std::vector<ShadedTime> spans;  // shaded
  double xEnd = 0;                // of the axis, which begins at xBegin
  double xBegin = 0;
};

std::string svg(const Picture &picture);

// Returns the text as it stands between the tags of HTML and SVG.
std::string escaped(const std::string &text);

}  // namespace line
