// What `sbus monitor` shows at one moment, for S.Bus or for a sketch's rows.
#pragma once

#include <string>
#include <vector>

#include "sbus/Scaling.h"

namespace tool {

enum class Mood { Calm, Good, Warn, Bad };

struct MonitorView {
  struct Channel {
    double value = 0;
    double low = 0;  // the lowest and the highest since the marks were reset
    double high = 0;
    bool marked = false;  // low and high are valid
    std::string text;     // the value as received
  };
  struct Indicator {
    std::string name;
    bool on;
    Mood mood;  // while it is on
  };
  struct Group {
    std::string name;
    std::vector<std::string> facts;  // the most important one first
  };

  std::string source;  // "/dev/ttyUSB0"
  std::string kind;    // "S.BUS2, 100000 baud"
  std::string state;   // a word
  Mood mood = Mood::Calm;
  std::string banner;  // an urgent message; usually empty
  Mood bannerMood = Mood::Bad;
  bool old = false;      // the values are no longer the line's
  bool isRaw = true;     // the values are raw, 0..2047, so us and % make sense
  sbus::Range range{};   // raw values at -100, 0 and +100 %
  sbus::Range pulses{};  // raw values at 988, 1500 and 2012 us
  std::vector<Channel> channels;
  std::vector<Indicator> indicators;
  std::string quality;        // the link's, "quality 98 %"; empty for rows
  std::vector<Group> groups;  // the most important one first
  std::string plain;          // the counters and times in one line, for a pipe
};

}  // namespace tool
