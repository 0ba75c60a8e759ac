#include "line/report/SvgPlot.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "line/Format.h"

namespace line {

namespace {

constexpr double Width = 960, Height = 480;
constexpr double Left = 64, Right = 104, Top = 48, Bottom = 76;  // margins; the right one holds the curves' names
constexpr double PlotWidth = Width - Left - Right, PlotHeight = Height - Top - Bottom;
constexpr double LineHeight = 15;

// Okabe and Ito's hues, which colour-blind people can tell apart; darker on white, lighter on black. Further curves are
// dashed. The shades also differ in their pattern. No CSS variables: many viewers do not support them.
struct Palette {
  const char *page, *text, *grid, *failsafe, *lost, *silent, *late;
  const char *curves[8];
};
constexpr size_t Colours = 8;
constexpr Palette Light = {
    "#fff",    "#24292f",
    "#d8dee4", "#cf222e",
    "#bf8700", "#6e7781",
    "#8250df", {"#0072b2", "#c04d00", "#007a5a", "#a3447c", "#8a6100", "#2a8fc0", "#5f4bb6", "#57606a"}};
constexpr Palette Dark = {
    "#0d1117", "#e6edf3",
    "#30363d", "#ff7b72",
    "#e3b341", "#8b949e",
    "#bc8cff", {"#56b4e9", "#ff8f4d", "#2fc79a", "#e59ac8", "#f0c040", "#9ad7f5", "#b3a5ff", "#b1bac4"}};

std::string style(const Palette &palette) {
  std::string text =
      format(".page{fill:%s}text{fill:%s}.grid{stroke:%s}", palette.page, palette.text, palette.grid) +
      format(".failsafe{fill:%s;stroke:%s}.lost{fill:%s;stroke:%s}.silent{fill:%s;stroke:%s}.late{fill:%s;stroke:%s}\n",
             palette.failsafe, palette.failsafe, palette.lost, palette.lost, palette.silent, palette.silent,
             palette.late, palette.late);
  for (size_t i = 0; i < Colours; i++) {
    text += format(".c%zu{stroke:%s}.n%zu{fill:%s}", i, palette.curves[i], i, palette.curves[i]);
  }
  return text + "\n";
}

// A picture has no encoding, so its names are ASCII only.
std::string plain(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return escaped(text);
}

// An axis: its ends, and its ticks at 1, 2 or 5 times a power of ten.
struct Axis {
  double from, to, step;

  Axis(double least, double most, int ticks) : from(least), to(most) {
    const double rough = (most - least) / ticks;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    step = rough <= power ? power : rough <= 2 * power ? 2 * power : rough <= 5 * power ? 5 * power : 10 * power;
  }

  double first() const { return std::ceil(from / step - 1e-9) * step; }
};

Axis valueAxis(const Picture &picture) {
  double least = INFINITY;
  double most = -INFINITY;
  for (const Curve &curve : picture.curves) {
    for (const Curve::Point &point : curve.points) {
      least = std::min(least, point.y);
      most = std::max(most, point.y);
    }
  }
  constexpr double SpanMin = 20;  // otherwise the noise of a resting stick would fill the height
  const double margin = std::max(0.06 * (most - least), (SpanMin - (most - least)) / 2);
  return Axis(least - margin, most + margin, 7);
}

class Drawing {
 public:
  explicit Drawing(const Picture &picture)
      : _picture(picture), _x(picture.xBegin, picture.xEnd, 9), _y(valueAxis(picture)) {}

  std::string text() {
    _text = format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" height=\"%.0f\" "
        "role=\"img\">\n",
        Width, Height, Width, Height);
    _text +=
        "<title>" + plain(_picture.title) + "</title>\n<style>\ntext{font:12px system-ui,sans-serif}" +
        ".title{font-size:15px;font-weight:600}.name{font-weight:600}.curve,.lead{fill:none;stroke-linejoin:round}" +
        ".curve{stroke-width:1.6}.lead{opacity:.5}.d1{stroke-dasharray:6 3}.d2,.d3{stroke-dasharray:2 3}\n" +
        style(Light) + "@media(prefers-color-scheme:dark){\n" + style(Dark) + "}\n</style>\n";
    _text += "<defs>" + pattern("failsafe", 45) + pattern("lost", -45) + pattern("silent", 0) + pattern("late", 90) +
             "</defs>\n";
    _text += "<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n";
    _text += format("<text class=\"title\" x=\"%.0f\" y=\"26\">", Left) + plain(_picture.title) + "</text>\n";
    spans();
    axes();
    curves();
    names();
    return _text + "</svg>\n";
  }

 private:
  double px(double x) const { return Left + (x - _x.from) / (_x.to - _x.from) * PlotWidth; }
  double py(double y) const { return Top + (_y.to - y) / (_y.to - _y.from) * PlotHeight; }

  static std::string pattern(const char *name, int angle) {
    return format(
               "<pattern id=\"%s\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" "
               "patternTransform=\"rotate(%d)\">",
               name, angle) +
           format(
               "<g class=\"%s\"><rect width=\"6\" height=\"6\" stroke=\"none\" opacity=\".12\"/>"
               "<path d=\"M0 0V6\" opacity=\".45\"/></g></pattern>",
               name);
  }

  static std::string look(size_t curve) { return format("c%zu d%zu", curve % Colours, curve / Colours); }

  // Shades the spans, and adds a legend below the axis.
  void spans() {
    const struct {
      FlagSpan::Kind kind;
      const char *name, *text;
    } kinds[] = {{FlagSpan::Kind::Failsafe, "failsafe", "failsafe"},
                 {FlagSpan::Kind::NoPulses, "failsafe", "no pulses"},
                 {FlagSpan::Kind::LostFrame, "lost", "lost frames"},
                 {FlagSpan::Kind::NoFrames, "silent", "no frames"},
                 {FlagSpan::Kind::Late, "late", "PC late"}};
    double legend = Left;
    for (const auto &kind : kinds) {
      bool any = false;
      for (const ShadedTime &span : _picture.spans) {
        if (span.kind != kind.kind) {
          continue;
        }
        any = true;
        const double from = px(span.from);
        rectangle(kind.name, from, Top, std::max(1.5, px(span.to) - from), PlotHeight);
      }
      if (any) {
        rectangle(kind.name, legend, Height - 24, 22, 12);
        label(legend + 28, Height - 14, "start", kind.text);
        legend += 120;
      }
    }
  }

  void rectangle(const char *name, double x, double y, double width, double height) {
    _text += format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"url(#%s)\"/>\n", x, y, width,
                    height, name);
  }

  void label(double x, double y, const char *anchor, const std::string &text) {
    _text += format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, anchor) + plain(text) + "</text>\n";
  }

  void axes() {
    std::string grid;
    for (double y = _y.first(); y <= _y.to; y += _y.step) {
      grid += format("M%.0f %.1fH%.0f", Left, py(y), Left + PlotWidth);
      label(Left - 8, py(y) + 4, "end", format("%g", std::round(y / _y.step) * _y.step + 0.0));
    }
    for (double x = _x.first(); x <= _x.to + _x.step / 1000; x += _x.step) {
      grid += format("M%.1f %.0fV%.0f", px(x), Top, Top + PlotHeight);
      label(px(x), Top + PlotHeight + 18, "middle", format("%.10g", std::round(x / _x.step) * _x.step + 0.0));
    }
    _text += "<path class=\"grid\" d=\"" + grid + "\"/>\n";
    label(Left + PlotWidth, Top + PlotHeight + 36, "end", _picture.xTitle);
    label(Left - 8, Top - 10, "end", _picture.yTitle);
  }

  // Draws the first, last, lowest and highest of all points in a column of pixels. A point not joined to another is a
  // ring.
  void curves() {
    for (size_t i = 0; i < _picture.curves.size(); i++) {
      const std::vector<Curve::Point> &points = _picture.curves[i].points;
      std::string path;
      std::string rings;
      for (size_t from = 0; from < points.size();) {
        size_t to = from;
        size_t least = from;
        size_t most = from;
        for (; to < points.size() && (to == from || (points[to].joined && px(points[to].x) - px(points[from].x) < 1));
             to++) {
          least = points[to].y < points[least].y ? to : least;
          most = points[to].y > points[most].y ? to : most;
        }
        size_t last = SIZE_MAX;
        for (const size_t k : {from, std::min(least, most), std::max(least, most), to - 1}) {
          if (k != last) {
            path += format("%c%.1f %.1f", k == from && !points[k].joined ? 'M' : 'L', px(points[k].x), py(points[k].y));
          }
          last = k;
        }
        if (to == from + 1 && !points[from].joined && (to == points.size() || !points[to].joined)) {
          rings += format("<circle class=\"curve %s\" cx=\"%.1f\" cy=\"%.1f\" r=\"2.5\"/>\n", look(i).c_str(),
                          px(points[from].x), py(points[from].y));
        }
        from = to;
      }
      _text += "<path class=\"curve " + look(i) + "\" d=\"" + path + "\"/>\n" + rings;
    }
  }

  // Writes each curve's name at its end. Names that would overlap are moved apart, and connected by a line.
  void names() {
    struct Name {
      size_t curve;
      double end, y;
    };
    std::vector<Name> all;
    for (size_t i = 0; i < _picture.curves.size(); i++) {
      if (!_picture.curves[i].points.empty()) {
        const double end = py(_picture.curves[i].points.back().y);
        all.push_back({i, end, end});
      }
    }
    std::stable_sort(all.begin(), all.end(), [](const Name &a, const Name &b) { return a.end < b.end; });
    double least = Top;
    for (Name &name : all) {
      name.y = std::max(name.y, least);
      least = name.y + LineHeight;
    }
    double most = Top + PlotHeight;
    for (auto name = all.rbegin(); name != all.rend(); ++name) {
      name->y = std::min(name->y, most);
      most = name->y - LineHeight;
    }
    for (const Name &name : all) {
      const Curve &curve = _picture.curves[name.curve];
      const double x = px(curve.points.back().x);
      _text += "<path class=\"lead " + look(name.curve) +
               format("\" d=\"M%.1f %.1fL%.0f %.1f\"/>\n", x, name.end, Left + PlotWidth + 14, name.y);
      _text += format("<text class=\"name n%zu\" x=\"%.0f\" y=\"%.1f\">", name.curve % Colours, Left + PlotWidth + 18,
                      name.y + 4) +
               plain(curve.name) + "</text>\n";
    }
  }

  const Picture &_picture;
  const Axis _x;
  const Axis _y;
  std::string _text;
};

}  // namespace

std::string escaped(const std::string &text) {
  std::string safe;
  for (const char c : text) {
    safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return safe;
}

std::string svg(const Picture &picture) {
  return Drawing(picture).text();
}

}  // namespace line
