#include "cli/Json.h"

#include "cli/Format.h"

namespace tool {

namespace {

// Returns the text in quotation marks. Names of ports and signals are UTF-8.
std::string quoted(const std::string &text) {
  std::string json = "\"";
  for (const char c : text) {
    json += c >= 0 && c < ' ' ? format("\\u%04x", static_cast<unsigned>(c))
                              : (c == '"' || c == '\\' ? "\\" : "") + std::string(1, c);
  }
  return json + '"';
}

}  // namespace

Json &Json::add(const char *name, const std::string &value) {
  _text += (_text.empty() ? "\"" : ",\"") + std::string(name) + "\":" + value;
  return *this;
}

Json &Json::text(const char *name, const std::string &value) {
  return add(name, quoted(value));
}

Json &Json::decimal(const char *name, std::optional<double> value) {
  return add(name, value ? format("%.1f", *value) : "null");
}

Json &Json::counts(const sbus::Counters &counters) {
  return number("frames", counters.frames)
      .number("lost_frames", counters.lostFrames)
      .number("failsafe_frames", counters.failsafeFrames);
}

Json &Json::numbers(const char *name, const std::vector<double> &values) {
  std::string list;
  for (const double value : values) {
    list += (list.empty() ? "" : ",") + format("%.10g", value);
  }
  return add(name, "[" + list + "]");
}

Json &Json::channels(const line::Values &values, size_t first, size_t count) {
  const auto begin = values.raw.begin() + static_cast<std::ptrdiff_t>(first - 1);
  return number("first", first)
      .numbers("channels", std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(count)));
}

Json frameJson(const line::Stretch &stretch, std::optional<double> endUs, const line::Values &values) {
  const bool extra = stretch.kind == line::Stretch::Kind::Extra;
  const bool is24 = stretch.kind == line::Stretch::Kind::Frame24;
  Json json("frame");
  json.decimal("time_us", endUs).channels(values, extra ? 17 : 1, is24 ? 24 : 16);
  if (!is24 && !extra) {
    json.flag("ch17", values.switches[0]).flag("ch18", values.switches[1]);
  }
  if (!extra) {
    json.flag("lost_frame", values.lostFrame).flag("failsafe", values.failsafe);
  }
  return json.text("end", format("%02X", static_cast<unsigned>(stretch.characters.back().value)));
}

Json noFrameJson(const line::Stretch &stretch, std::optional<double> endUs) {
  std::string bytes;
  for (const line::Character &character : stretch.characters) {
    bytes += (bytes.empty() ? "" : " ") + format("%02X", static_cast<unsigned>(character.value)) +
             (character.bad ? "!" : "");
  }
  Json json("no_frame");
  json.decimal("time_us", endUs).text("bytes", bytes).text("why", why(stretch));
  std::vector<double> numbers;
  for (const sbus::Slot &slot : stretch.slots) {
    numbers.push_back(slot.number);
  }
  return numbers.empty() ? json : json.numbers("slots", numbers);
}

}  // namespace tool
