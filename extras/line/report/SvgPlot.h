// Draws curves as an SVG that is light on a light page and dark on a dark one.
#pragma once

#include <string>
#include <vector>

#include "line/report/FlagSpans.h"

namespace line {

struct Curve {
  struct Point {
    double x, y;
    bool joined;  // to the previous point
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
  std::vector<ShadedTime> spans;
  double xEnd = 0;  // the end of the axis, which begins at xBegin
  double xBegin = 0;
};

std::string svg(const Picture &picture);

// Escapes the text for HTML and SVG.
std::string escaped(const std::string &text);

}  // namespace line
