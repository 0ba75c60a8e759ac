// JSON lines: one object on each line, whose "type" says what it is. sbus.1 has all types under JSON LINES.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/Units.h"
#include "line/Segments.h"
#include "line/Statistics.h"
#include "sbus/Counters.h"

namespace tool {

// The unit of the channels, and what 0 % and +-100 % are.
struct ChannelForm {
  Unit unit = Unit::Raw;
  sbus::Range range = sbus::FrSky;
};

class Json {
 public:
  explicit Json(const char *type) { text("type", type); }

  Json &text(const char *name, const std::string &value);
  Json &flag(const char *name, bool value) { return add(name, value ? "true" : "false"); }
  Json &counts(const sbus::Counters &counters);  // frames, lost_frames, failsafe_frames
  Json &number(const char *name, uint64_t value) { return add(name, std::to_string(value)); }
  // Adds null if there is no value: it is not known.
  Json &number(const char *name, std::optional<uint64_t> value) {
    return add(name, value ? std::to_string(*value) : "null");
  }
  // Adds what is a number already.
  Json &digits(const char *name, const std::string &number) { return add(name, number); }
  Json &decimal(const char *name, std::optional<double> value);  // rounded to a tenth; null if there is none
  Json &numbers(const char *name, const std::vector<double> &values);
  // Adds the range if the channels are percent of it.
  Json &range(const ChannelForm &form);
  // Adds the values of `count` channels from CH`first` on, in a unit.
  Json &channels(const line::Values &values, size_t first, size_t count, const ChannelForm &form);

  std::string line() const { return "{" + _text + "}\n"; }

 private:
  Json &add(const char *name, const std::string &value);

  std::string _text;
};

// What the first line says of the source.
struct JsonLine {
  std::string source;
  std::string signal;  // of a capture; otherwise empty
  std::optional<unsigned long> baud;
  std::optional<bool> inverted;
  std::optional<int64_t> startUs;  // when time 0 is, in us since 1970
  bool isTimed = true;             // the times are those of the line
};
Json lineJson(const JsonLine &line);

// Return the line of a frame, of bytes that belong to no frame, and of a telemetry slot. `endUs`: where their last
// character ends; none: null.
Json frameJson(const line::Stretch &stretch, std::optional<double> endUs, const line::Values &values,
               const ChannelForm &form);
Json noFrameJson(const line::Stretch &stretch, std::optional<double> endUs);
Json slotJson(const sbus::Slot &slot, std::optional<double> endUs);

}  // namespace tool
