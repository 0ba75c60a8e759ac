// JSON lines: one object on each line, whose "type" says what it is. sbus.1 has all types under JSON LINES.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "line/Segments.h"
#include "line/Statistics.h"
#include "sbus/Counters.h"

namespace tool {

class Json {
 public:
  explicit Json(const char *type) { text("type", type); }

  Json &text(const char *name, const std::string &value);
  Json &flag(const char *name, bool value) { return add(name, value ? "true" : "false"); }
  Json &counts(const sbus::Counters &counters);  // frames, lost_frames, failsafe_frames
  Json &number(const char *name, uint64_t value) { return add(name, std::to_string(value)); }
  Json &decimal(const char *name, double value);  // rounded to a tenth
  Json &numbers(const char *name, const std::vector<double> &values);
  // Adds the raw values of `count` channels from CH`first` on.
  Json &channels(const line::Values &values, size_t first, size_t count);

  std::string line() const { return "{" + _text + "}\n"; }

 private:
  Json &add(const char *name, const std::string &value);

  std::string _text;
};

// Return the line of a frame, and of bytes that belong to no frame. `startUs`: where their first character begins.
Json frameJson(const line::Stretch &stretch, double startUs, const line::Values &values);
Json noFrameJson(const line::Stretch &stretch, double startUs);

}  // namespace tool
