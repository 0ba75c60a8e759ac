// Draws a channel as a bar: its travel, its value, and its lowest and highest value so far.
#pragma once

#include "cli/monitor/MonitorPage.h"

namespace tool {

class Bar {
 public:
  // `width` is in columns. All bars of a view have the same scale.
  Bar(const MonitorView &view, int width, bool unicode);

  // Returns the line above the bars: "-100 0 +100", or the ends of the scale.
  std::string scale() const;

  void append(PageRow &row, const MonitorView::Channel &channel) const;

 private:
  int at(double value) const;

  const MonitorView &_view;
  int _width;
  bool _unicode;
  double _low = 0;
  double _high = 2047;
};

}  // namespace tool
