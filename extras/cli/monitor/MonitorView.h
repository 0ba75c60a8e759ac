// What `sbus monitor` shows at one moment, of S.Bus or of a sketch's rows.
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
    bool marked = false;  // low and high have a meaning
    std::string text;     // the value as it came
  };
  struct Indicator {
    std::string name;
    bool on;
    Mood mood;  // when it is on
  };
  struct Group {
    std::string name;
    std::vector<std::string> facts;  // the most important one first
  };

  std::string source;  // "/dev/ttyUSB0"
  std::string kind;    // "S.BUS2, 100000 baud"
  std::string state;   // a word
  Mood mood = Mood::Calm;
  std::string banner;  // what must not be overlooked; mostly empty
  Mood bannerMood = Mood::Bad;
  bool old = false;      // the values are no longer those of the line
  bool isRaw = true;     // the values are raw ones, 0..2047, so that us and % mean something
  sbus::Range range{};   // of -100, 0 and +100 %
  sbus::Range pulses{};  // of 988, 1500 and 2012 us
  std::vector<Channel> channels;
  std::vector<Indicator> indicators;
  std::string quality;  // "quality 98 %", of the link; of rows empty
  std::vector<Group> groups;
  Group sensors;              // of S.BUS2; without facts none has come
  bool showsSensors = false;  // in place of the groups, where not all of it has room
  std::string plain;          // the counters and times in one line, for a pipe
};

}  // namespace tool
