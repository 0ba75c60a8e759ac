#include "line/file/JsonReader.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "line/file/ByteText.h"
#include "line/Format.h"
#include "line/FrameBytes.h"
#include "line/recording/Recording.h"
#include "line/recording/WallTime.h"
#include "line/recording/Words.h"
#include "sbus/Frame.h"
#include "sbus2/Slots.h"

namespace line {

namespace {

using Object = nlohmann::json;

constexpr const char *Expected = "JSON lines as sbus hex --json writes them are expected";

std::string typeOf(const Object &object) {
  const auto type = object.find("type");
  return type != object.end() && type->is_string() ? type->get<std::string>() : "";
}

// Reads time_us. Returns false if it is present, but not a time.
bool timeOf(const Object &object, std::optional<double> &us) {
  const auto time = object.find("time_us");
  if (time == object.end() || time->is_null()) {
    return true;
  }
  us = time->is_number() ? time->get<double>() : HUGE_VAL;
  return std::abs(*us) <= static_cast<double>(RecordingTimeMaxUs);
}

// Reads read_us or late_us; 0 if it is absent. Returns false if it is not a time.
bool wholeTimeOf(const Object &object, const char *name, uint64_t &us) {
  const auto time = object.find(name);
  us = time != object.end() && time->is_number_unsigned() ? time->get<uint64_t>() : 0;
  return time == object.end() || time->is_null() || time->is_number_unsigned();
}

// Reads a flag: true, false, 1 or 0; if absent, false. Returns false for anything else.
bool flagOf(const Object &object, const char *name, bool &value) {
  const auto flag = object.find(name);
  if (flag == object.end()) {
    value = false;
    return true;
  }
  value = flag->is_boolean() ? flag->get<bool>() : *flag == 1;
  return flag->is_boolean() || *flag == 0 || *flag == 1;
}

std::string quoted(const std::string &name, const Object &value) {
  return name + ": " + value.dump(-1, ' ', false, Object::error_handler_t::replace).substr(0, 40);
}

// Reads the channels. Returns what is wrong, or nothing.
std::string channelsOf(const Object &object, std::vector<uint16_t> &raw) {
  const auto values = object.find("channels");
  if (values == object.end() || !values->is_array() || (values->size() != 16 && values->size() != 24)) {
    return "a frame has channels: an array of 16 numbers, or of 24";
  }
  for (size_t i = 0; i < values->size(); i++) {
    const Object &value = (*values)[i];
    const double number = value.is_number() ? value.get<double>() : -1;
    if (!(number >= 0 && number <= sbus::ChannelMax && number == std::floor(number))) {
      return quoted(format("channels[%u]", static_cast<unsigned>(i)), value) + " is not a whole number from 0 to 2047";
    }
    raw.push_back(static_cast<uint16_t>(number));
  }
  return {};
}

// Reads the end byte; 00 if absent.
bool endOf(const Object &object, uint8_t &end) {
  const auto found = object.find("end");
  if (found == object.end()) {
    end = 0;
    return true;
  }
  std::vector<Character> read;
  const bool isByte =
      found->is_string() && parseHex(found->get<std::string>(), read) && read.size() == 1 && !read[0].bad;
  end = isByte ? read[0].value : 0;
  return isByte;
}

// Reads a frame. Returns what is wrong, or nothing.
std::string frameOf(const Object &object, std::vector<Character> &characters) {
  std::vector<uint16_t> channels;
  const std::string wrong = channelsOf(object, channels);
  if (!wrong.empty()) {
    return wrong;
  }
  const auto first = object.find("first");
  const bool isExtra = first != object.end() && *first == 17;
  if (first != object.end() && (isExtra ? channels.size() != 16 : *first != 1)) {
    return quoted("first", *first) + " is not 1, or 17 of a frame with header 2F";
  }
  const bool is24 = channels.size() == sbus::ChannelCount24;
  Values values;
  std::copy(channels.begin(), channels.end(), values.raw.begin() + (isExtra ? sbus::ProportionalCount : 0));
  for (const auto &[name, value] : {std::pair<const char *, bool *>{isExtra ? "dg1" : "ch17", &values.switches[0]},
                                    {isExtra ? "dg2" : "ch18", &values.switches[1]},
                                    {"lost_frame", &values.lostFrame},
                                    {"failsafe", &values.failsafe}}) {
    if (!flagOf(object, name, *value)) {
      return quoted(name, object[name]) + " is not true or false";
    }
  }
  uint8_t end = 0;
  if (!endOf(object, end)) {
    return quoted("end", object["end"]) + " is not an end byte in hexadecimal, such as \"00\"";
  }
  using Kind = Stretch::Kind;
  const Kind kind = is24 ? Kind::Frame24 : isExtra ? Kind::Extra : Kind::Frame;
  characters = charactersOf(frameBytes(kind, values, end));
  return {};
}

std::string slotOf(const Object &object, std::vector<Character> &characters) {
  const auto slot = object.find("slot");
  const auto data = object.find("data");
  const auto isWithin = [](const Object &value, unsigned most) {
    return value.is_number_unsigned() && value.get<uint64_t>() <= most;
  };
  if (slot == object.end() || !isWithin(*slot, sbus::SlotCount - 1) || data == object.end() || !data->is_array() ||
      data->size() != 2 || !isWithin((*data)[0], 255) || !isWithin((*data)[1], 255)) {
    return "a slot has slot, 0 to 31, and data, two numbers from 0 to 255";
  }
  characters = charactersOf({sbus::slotId(slot->get<uint8_t>()), (*data)[0].get<uint8_t>(), (*data)[1].get<uint8_t>()});
  return {};
}

std::string bytesOf(const Object &object, std::vector<Character> &characters) {
  const auto text = object.find("bytes");
  const bool areBytes = text != object.end() && text->is_string() && parseHex(text->get<std::string>(), characters);
  return areBytes ? "" : "bytes: bytes in hexadecimal are expected, such as \"0F E3\"";
}

// Reads an object of type line.
void takeLineObject(const Object &object, JsonHead &head) {
  const auto baud = object.find("baud");
  if (baud != object.end() && *baud == 2 * sbus::Baud) {
    head.settings.baud = 2 * sbus::Baud;
  }
  const auto timed = object.find("timed");
  head.hasTimes = timed == object.end() || *timed != false;
  int64_t us = 0;
  const auto start = object.find("start");
  if (start != object.end() && start->is_string() && parseWallTime(start->get<std::string>(), us)) {
    head.startUs = us;
  }
}

bool isLineType(const std::string &type) { return type == "frame" || type == "no_frame" || type == "slot"; }

}  // namespace

JsonHead readJsonHead(std::string_view text) {
  JsonHead head;
  while (!text.empty()) {
    const Object read = Object::parse(takeLine(text), nullptr, false);
    if (read.is_object() && typeOf(read) == "line") {
      takeLineObject(read, head);
      head.isKnown = true;
    } else if (read.is_object() && isLineType(typeOf(read))) {
      std::optional<double> us;
      head.hasTimes = !timeOf(read, us) || us;
      head.isRead = read.contains("read_us");
      head.isKnown = true;
      break;
    }
  }
  return head;
}

std::string JsonReader::line(std::string_view text, std::deque<Character> &characters) {
  if (withoutBlanks(text).empty()) {
    return {};
  }
  const Object read = Object::parse(text, nullptr, false);
  if (!read.is_object()) {
    return line::quoted(withoutBlanks(text)) + " is not a JSON object; " + Expected;
  }
  const std::string type = typeOf(read);
  _hasEnded = type == "end";
  if (!isLineType(type)) {
    return {};
  }
  std::vector<Character> came;
  const std::string wrong = type == "frame"  ? frameOf(read, came)
                            : type == "slot" ? slotOf(read, came)
                                             : bytesOf(read, came);
  std::optional<double> us;
  if (!wrong.empty() || !timeOf(read, us)) {
    return wrong.empty() ? quoted("time_us", read["time_us"]) + " is not a time in microseconds" : wrong;
  }
  uint64_t sinceUs = 0, lateUs = 0;
  for (const auto &[name, time] : {std::pair<const char *, uint64_t *>{"read_us", &sinceUs}, {"late_us", &lateUs}}) {
    if (!wholeTimeOf(read, name, *time)) {
      return quoted(name, read[name]) + " is not a time in microseconds";
    }
  }
  for (Character &character : came) {
    character.sinceUs = sinceUs;
  }
  return put(us ? std::optional<int64_t>(std::llround(*us)) : std::nullopt,
             static_cast<uint32_t>(std::min<uint64_t>(lateUs, UINT32_MAX)), came, characters);
}

std::string JsonReader::finish(std::deque<Character> & /*characters*/) {
  return _any ? "" : std::string("has no frames; ") + Expected;
}

}  // namespace line
