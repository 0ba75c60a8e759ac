#include "cli/Json.h"

#include <nlohmann/json.hpp>

#include "line/Format.h"

namespace tool {

Json &Json::add(const char *name, const std::string &value) {
  _text += (_text.empty() ? "\"" : ",\"") + std::string(name) + "\":" + value;
  return *this;
}

Json &Json::text(const char *name, const std::string &value) {
  // A file's name may not be UTF-8, as a JSON text has to be.
  return add(name, nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

Json &Json::decimal(const char *name, std::optional<double> value) {
  return add(name, value ? line::format("%.1f", *value) : "null");
}

Json &Json::late(const line::Stretch &stretch) {
  return stretch.lateUs() > 0 ? number("late_us", uint64_t{stretch.lateUs()}) : *this;
}

Json &Json::counts(const sbus::Counters &counters) {
  return number("frames", counters.frames)
      .number("lost_frames", counters.lostFrames)
      .number("failsafe_frames", counters.failsafeFrames);
}

Json &Json::numbers(const char *name, const std::vector<double> &values) {
  std::string list;
  for (const double value : values) {
    list += (list.empty() ? "" : ",") + line::format("%.10g", value);
  }
  return add(name, "[" + list + "]");
}

Json &Json::channels(const line::Values &values, size_t first, size_t count) {
  const uint16_t *const raw = values.raw.data() + first - 1;
  return number("first", first).numbers("channels", {raw, raw + count});
}

Json frameJson(const line::Stretch &stretch, std::optional<double> endUs, const line::Values &values) {
  const bool extra = stretch.kind == line::Stretch::Kind::Extra;
  const bool is24 = stretch.kind == line::Stretch::Kind::Frame24;
  Json json("frame");
  json.decimal("time_us", endUs);
  if (stretch.characters.back().sinceUs > 0) {
    json.number("read_us", stretch.characters.back().sinceUs);
  }
  json.late(stretch);
  json.channels(values, extra ? 17 : 1, is24 ? 24 : 16);
  if (!is24 && !extra) {
    json.flag("ch17", values.switches[0]).flag("ch18", values.switches[1]);
  }
  const line::Values own = extra ? line::withFlags(values, stretch.characters[sbus::FlagsIndex].value) : values;
  if (extra) {
    json.flag("dg1", own.switches[0]).flag("dg2", own.switches[1]);
  }
  json.flag("lost_frame", own.lostFrame).flag("failsafe", own.failsafe);
  return json.text("end", line::format("%02X", static_cast<unsigned>(stretch.characters.back().value)));
}

Json noFrameJson(const line::Stretch &stretch, std::optional<double> endUs) {
  std::string bytes;
  for (const line::Character &character : stretch.characters) {
    bytes += (bytes.empty() ? "" : " ") + line::format("%02X", static_cast<unsigned>(character.value)) +
             (character.bad ? "!" : "");
  }
  Json json("no_frame");
  return json.decimal("time_us", endUs).late(stretch).text("bytes", bytes).text("why", why(stretch));
}

Json slotJson(const sbus::Slot &slot, std::optional<double> endUs) {
  Json json("slot");
  return json.decimal("time_us", endUs)
      .number("slot", uint64_t{slot.number})
      .numbers("data", {static_cast<double>(slot.data.data0), static_cast<double>(slot.data.data1)});
}

}  // namespace tool
