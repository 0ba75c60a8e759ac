#include "line/report/SvgPlot.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "line/Format.h"

namespace line {

namespace {

constexpr double Width = 960, Height = 460;
constexpr double Left = 64, Right = 104, Top = 28, Bottom = 76;  // margins; the right one holds the curves' names
constexpr double PlotWidth = Width - Left - Right, PlotHeight = Height - Top - Bottom;
constexpr double LineHeight = 15;

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

Axis timeAxis(const FlightLog &flight) {
  const double from = seconds(flight.shownUs(flight.fromUs()));
  const double to = seconds(flight.shownUs(flight.toUs()));
  return Axis(from, to > from ? to : from + 1, 9);
}

Axis valueAxis(const Curves &curves) {
  double least = INFINITY, most = -INFINITY;
  for (const Curves::Bucket &bucket : curves.buckets()) {
    least = std::min<double>(least, *std::min_element(bucket.least.begin(), bucket.least.end()));
    most = std::max<double>(most, *std::max_element(bucket.most.begin(), bucket.most.end()));
  }
  constexpr double SpanMin = 20;  // otherwise the noise of a resting stick would fill the height
  const double margin = std::max(0.06 * (most - least), (SpanMin - (most - least)) / 2);
  return Axis(least - margin, most + margin, 7);
}

class Drawing {
 public:
  explicit Drawing(const FlightLog &flight) : _flight(flight), _x(timeAxis(flight)), _y(valueAxis(flight.curves())) {}

  std::string text() {
    _text = format("<svg viewBox=\"0 0 %.0f %.0f\" role=\"img\" aria-label=\"CH1 to CH4\">\n<defs>", Width, Height) +
            pattern("failsafe", 45) + pattern("silent", 0) + pattern("late", 90) + "</defs>\n";
    spans();
    axes();
    for (size_t channel = 0; channel < Curves::Channels; channel++) {
      curve(channel);
    }
    names();
    return _text + "</svg>\n";
  }

 private:
  double px(uint64_t us) const { return at(seconds(_flight.shownUs(us))); }
  double at(double seconds) const { return Left + (seconds - _x.from) / (_x.to - _x.from) * PlotWidth; }
  double py(double y) const { return Top + (_y.to - y) / (_y.to - _y.from) * PlotHeight; }

  static std::string pattern(const char *name, int angle) {
    return format(
        "<pattern id=\"%s\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate(%d)\">"
        "<g class=\"%s\"><rect width=\"6\" height=\"6\" opacity=\".12\"/><rect width=\"1\" height=\"6\" "
        "opacity=\".45\"/></g></pattern>",
        name, angle, name);
  }

  // Shades the spans, and adds a legend below the axis. Lost frames are on the strip.
  void spans() {
    double legend = Left;
    for (const SpanName &kind : SpanNames) {
      const std::vector<FlagSpan> all =
          kind.kind == FlagSpan::Kind::LostFrame ? std::vector<FlagSpan>() : _flight.spans(kind.kind);
      for (const FlagSpan &span : all) {
        rectangle(kind.colour, px(span.fromUs), Top, std::max(1.5, px(span.toUs) - px(span.fromUs)), PlotHeight);
      }
      if (!all.empty()) {
        rectangle(kind.colour, legend, Height - 24, 22, 12);
        label(legend + 28, Height - 14, "start", kind.name);
        legend += 120;
      }
    }
  }

  void rectangle(const char *name, double x, double y, double width, double height) {
    _text += format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"url(#%s)\"/>\n", x, y, width,
                    height, name);
  }

  void label(double x, double y, const char *anchor, const std::string &text) {
    _text += format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">%s</text>\n", x, y, anchor, text.c_str());
  }

  void axes() {
    std::string grid;
    for (double y = _y.first(); y <= _y.to; y += _y.step) {
      grid += format("M%.0f %.1fH%.0f", Left, py(y), Left + PlotWidth);
      label(Left - 8, py(y) + 4, "end", format("%g", std::round(y / _y.step) * _y.step + 0.0));
    }
    for (double x = _x.first(); x <= _x.to + _x.step / 1000; x += _x.step) {
      grid += format("M%.1f %.0fV%.0f", at(x), Top, Top + PlotHeight);
      label(at(x), Top + PlotHeight + 18, "middle", format("%.10g", std::round(x / _x.step) * _x.step + 0.0));
    }
    _text += "<path class=\"grid\" d=\"" + grid + "\"/>\n";
    label(Left + PlotWidth, Top + PlotHeight + 36, "end", "s");
    label(Left - 8, Top - 10, "end", "raw");
  }

  // Draws the area between the lowest and the highest value of each column of pixels: a line where they are the same.
  // A frame between silences is a ring.
  void curve(size_t channel) {
    const std::vector<Curves::Bucket> &buckets = _flight.curves().buckets();
    std::string path, back, rings;
    for (size_t from = 0; from < buckets.size();) {
      uint16_t least = buckets[from].least[channel], most = buckets[from].most[channel];
      size_t to = from + 1;
      for (; to < buckets.size() && buckets[to].joined && px(buckets[to].us) - px(buckets[from].us) < 1; to++) {
        least = std::min(least, buckets[to].least[channel]);
        most = std::max(most, buckets[to].most[channel]);
      }
      const bool isFirst = !buckets[from].joined, isLast = to == buckets.size() || !buckets[to].joined;
      const double x = px(buckets[from].us);
      if (isFirst && isLast && least == most) {
        rings += format("<circle class=\"c%zu\" cx=\"%.1f\" cy=\"%.1f\" r=\"2.5\"/>\n", channel, x, py(least));
      } else {
        path += format("%c%.1f %.1f", isFirst ? 'M' : 'L', x, py(most));
        back = format("L%.1f %.1f", x, py(least)) + back;
        path += isLast ? std::exchange(back, "") + "Z" : "";
      }
      from = to;
    }
    _text += format("<path class=\"curve c%zu\" d=\"", channel) + path + "\"/>\n" + rings;
  }

  // Writes each curve's name at its end. Names that would overlap are moved apart, and connected by a line.
  void names() {
    struct Name {
      size_t channel;
      double end, y;
    };
    const Curves::Bucket &last = _flight.curves().buckets().back();
    std::vector<Name> all;
    for (size_t i = 0; i < Curves::Channels; i++) {
      const double end = py((last.least[i] + last.most[i]) / 2.0);
      all.push_back({i, end, end});
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
      _text += format("<path class=\"c%zu\" opacity=\".5\" d=\"M%.1f %.1fL%.0f %.1f\"/>\n", name.channel, px(last.us),
                      name.end, Left + PlotWidth + 14, name.y) +
               format("<text class=\"c%zu\" x=\"%.0f\" y=\"%.1f\">CH%zu</text>\n", name.channel, Left + PlotWidth + 18,
                      name.y + 4, name.channel + 1);
    }
  }

  const FlightLog &_flight;
  const Axis _x;
  const Axis _y;
  std::string _text;
};

}  // namespace

std::string curvesOf(const FlightLog &flight) { return Drawing(flight).text(); }

}  // namespace line
