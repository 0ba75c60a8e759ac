// sbus telemetry: what receiver and sensors send between the frames of an S.BUS2 line.

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/Format.h"
#include "cli/Output.h"
#include "cli/SilenceNote.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Observer.h"
#include "line/telemetry/Sensors.h"
#include "line/telemetry/TelemetrySlots.h"

namespace tool {

namespace {

using SensorsBySlot = std::map<unsigned, const line::Sensor *>;  // by its first slot

std::string knownNames() {
  std::string names;
  for (const line::Sensor &sensor : line::sensors()) {
    names += (names.empty() ? "" : ", ") + std::string(sensor.name);
  }
  return names;
}

// "1=SBS-01V". A sensor's slots follow one another within a group of eight.
void addSensor(const std::string &text, SensorsBySlot &sensors) {
  const size_t equals = text.find('=');
  const std::string number = text.substr(0, equals);
  const bool isNumber =
      !number.empty() && number.size() <= 2 && number.find_first_not_of("0123456789") == std::string::npos;
  if (equals == std::string::npos || !isNumber || std::stoul(number) >= sbus::SlotCount) {
    rejectCommandLine("--sensor: " + text + " is no slot and name, such as 1=SBS-01V; slots are 0 to 31");
  }
  const unsigned slot = static_cast<unsigned>(std::stoul(number));
  const line::Sensor *const sensor = line::sensorOf(text.substr(equals + 1));
  if (sensor == nullptr) {
    rejectCommandLine("--sensor: " + text + " names no sensor that is known: " + knownNames());
  }
  const unsigned first = slot - slot % sbus::SlotsOfGroup;  // of the group
  if (slot + sensor->slots > first + sbus::SlotsOfGroup) {
    rejectCommandLine(
        format("--sensor: %s has %u slots, which do not fit into the group of slots %u to %u from slot %u on",
               sensor->name, sensor->slots, first, first + sbus::SlotsOfGroup - 1, slot));
  }
  sensors[slot] = sensor;
}

class TelemetryView {
 public:
  TelemetryView(uint32_t characterUs, const SensorsBySlot &sensors) : _sensors(sensors) {
    _observer.reset(0, characterUs);
    _observer.listen([this](const line::Stretch &stretch) { print(_slots.put(stretch)); });
    write("time_s,slot,data0,data1,quantity,value,unit\n");
  }

  line::Observer &observer() { return _observer; }
  bool framesCame() const { return _observer.counters().frames > 0; }

  void finish(const std::string &source, const SilenceNote &silence) {
    _observer.finish();
    flush();
    silence.end(framesCame());
    if (_printed == 0) {
      throw std::runtime_error(
          source + (_slots.rejectedGroups() > 0 ? ": what came between the frames is no slot of theirs"
                    : _slots.announced() ? ": frames came, and no slot after them: is the receiver in a mode with telemetry?"
                                         : ": frames came, and none announced a telemetry slot: this is no S.BUS2 line"));
    }
  }

 private:
  void print(const std::vector<line::TelemetrySlots::Slot> &slots) {
    std::map<unsigned, line::Quantity> shown;  // by slot
    for (size_t i = 0; i < slots.size(); i++) {
      add(slots, i, shown);
    }
    for (const line::TelemetrySlots::Slot &slot : slots) {
      const auto quantity = shown.find(slot.number);
      write(format("%.6f,%u,%u,%u,", static_cast<double>(slot.endUs) / 1e6, slot.number, slot.data.data0,
                   slot.data.data1) +
            (quantity == shown.end()
                 ? ",,"
                 : quantity->second.name + (',' + quantity->second.value) + ',' + quantity->second.unit) +
            '\n');
      _printed++;
    }
  }

  // Adds what the sensor that begins with this slot measures, if all of its slots are there.
  void add(const std::vector<line::TelemetrySlots::Slot> &slots, size_t first,
           std::map<unsigned, line::Quantity> &shown) const {
    const auto named = _sensors.find(slots[first].number);
    if (named == _sensors.end() || first + named->second->slots > slots.size() ||
        slots[first + named->second->slots - 1].number != slots[first].number + named->second->slots - 1) {
      return;
    }
    std::vector<sbus::SlotData> data;
    for (size_t i = 0; i < named->second->slots; i++) {
      data.push_back(slots[first + i].data);
    }
    for (const line::Quantity &quantity : named->second->quantities(data.data())) {
      shown.emplace(slots[first].number + quantity.slot, quantity);
    }
  }

  const SensorsBySlot &_sensors;
  line::Observer _observer;
  line::TelemetrySlots _slots;
  unsigned long _printed = 0;
};

void run(const SourceOption &source, const std::vector<std::string> &named) {
  SensorsBySlot sensors = {{0, line::sensorOf("receiver")}};
  for (const std::string &text : named) {
    addSensor(text, sensors);
  }
  const std::unique_ptr<Input> input = source.open();
  TelemetryView view(input->settings().characterUs(), sensors);
  SilenceNote silence(source.name(), "frames");
  input->run([&view](const line::Character &character) { view.observer().put(character); },
             [&](uint64_t nowUs) {
               view.observer().idleUntil(input->knownUs());
               silence.tick(nowUs, view.framesCame());
             });
  view.finish(source.name(), silence);
}

}  // namespace

void addTelemetry(CLI::App &app) {
  Subcommand subcommand(app, "telemetry", "the sensors of an S.BUS2 line, as CSV");
  const auto source = std::make_shared<SourceOption>(subcommand, Recordings::AtOnce);
  const auto sensors = std::make_shared<std::vector<std::string>>();
  subcommand.option("--sensor", *sensors, "what fills a slot, such as 1=SBS-01V; once for each sensor")
      .type("SLOT=NAME");
  subcommand.footer(
      "A slot does not say which sensor fills it: name those that the radio has. Slot 0 is the receiver's own voltage. "
      "There is no checksum: what stands between two frames is printed if it is slots of the announced group and nothing "
      "else, once the second frame is there.");
  subcommand.run([source, sensors] { run(*source, *sensors); });
}

}  // namespace tool
