// JSON lines: each line is one object with a "type". sbus.1 lists all types under JSON LINES.
#pragma once

#include <cstdint>
#include <optional>
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
  // Adds the number, or null if it is unknown.
  Json &number(const char *name, std::optional<uint64_t> value) {
    return add(name, value ? std::to_string(*value) : "null");
  }
  // Adds a number that is already text.
  Json &digits(const char *name, const std::string &number) { return add(name, number); }
  Json &decimal(const char *name, std::optional<double> value);  // rounded to a tenth; null if unknown
  Json &late(const line::Stretch &stretch);                      // late_us, if a port may have held it back
  Json &numbers(const char *name, const std::vector<double> &values);
  // Adds the raw values of `count` channels from CH`first` on.
  Json &channels(const line::Values &values, size_t first, size_t count);

  std::string line() const { return "{" + _text + "}\n"; }

 private:
  Json &add(const char *name, const std::string &value);

  std::string _text;
};

// Return the lines for a frame, for bytes outside a frame, and for a telemetry slot. `endUs`: the end of the last
// character; without it the time is null.
Json frameJson(const line::Stretch &stretch, std::optional<double> endUs, const line::Values &values);
Json noFrameJson(const line::Stretch &stretch, std::optional<double> endUs);
Json slotJson(const sbus::Slot &slot, std::optional<double> endUs);

}  // namespace tool
