// The channels of a MonitorView as rows of a page: number, value, and whatever else fits into a column.
#pragma once

#include "cli/monitor/MonitorPage.h"

namespace tool {

class ChannelRows {
 public:
  // `width`: that of one column of channels.
  ChannelRows(const MonitorView &view, int width, bool unicode);

  // Returns the heading above the channels, for this many columns.
  PageRow head(int columns) const;

  // Appends a channel, counted from 0.
  void append(PageRow &row, size_t index) const;

 private:
  const MonitorView &_view;
  const int _width;
  const bool _unicode;
  const int _name;   // width in columns
  const int _value;  // width in columns
  bool _hasUs;
  bool _hasPercent;
  bool _hasMarks;
  int _bar;  // width in columns; 0: no bar
};

}  // namespace tool
