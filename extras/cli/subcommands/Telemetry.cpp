// sbus telemetry: prints the slots that receiver and sensors send between the frames of an S.BUS2 line.

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/Json.h"
#include "cli/Output.h"
#include "cli/SilenceNote.h"
#include "cli/options/SensorOption.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Format.h"
#include "line/Observer.h"
#include "line/capture/Parsing.h"
#include "line/telemetry/Readings.h"

namespace tool {

namespace {

class TelemetryView {
 public:
  TelemetryView(uint32_t characterUs, const line::SensorsBySlot &sensors, const SourceOption &source, bool asJson)
      : _sensors(sensors), _source(source), _asJson(asJson) {
    _observer.reset(0, characterUs);
    _observer.listen([this](const line::Stretch &) { print(_observer.telemetry().proved()); });
    if (!asJson) {
      write("time_s,slot,data0,data1,quantity,value,unit\n");
    }
  }

  line::Observer &observer() { return _observer; }
  bool hasFrames() const { return _observer.counters().frames > 0; }

  void finish(const std::string &source, const SilenceNote &silence) {
    _observer.finish();
    print(_observer.telemetry().proved());  // the last group
    flush();
    silence.end(hasFrames());
    const line::TelemetrySlots &telemetry = _observer.telemetry();
    if (telemetry.count() == 0) {
      throw std::runtime_error(
          source + (telemetry.rejectedGroups() > 0 ? ": the bytes between the frames are not their slots"
                    : telemetry.announced()
                        ? ": no telemetry slot follows the frames: is the receiver in a mode with telemetry?"
                        : ": no frame announces a telemetry slot: this is not an S.BUS2 line"));
    }
  }

 private:
  void print(const std::vector<line::TimedSlot> &slots) {
    std::map<unsigned, line::Quantity> shown;  // by slot
    for (const line::Quantity &quantity : line::quantitiesIn(slots, _sensors)) {
      shown.emplace(quantity.slot, quantity);
    }
    for (const line::TimedSlot &slot : slots) {
      const auto quantity = shown.find(slot.number);
      if (_asJson) {
        writeJson(slot, quantity == shown.end() ? nullptr : &quantity->second);
        continue;
      }
      const std::optional<double> us = _source.shownUs(slot.endUs);
      write((us ? line::format("%.6f", *us / 1e6) : "-") +
            line::format(",%u,%u,%u,", slot.number, slot.data.data0, slot.data.data1) +
            (quantity == shown.end()
                 ? ",,"
                 : quantity->second.name + (',' + quantity->second.value) + ',' + quantity->second.unit) +
            '\n');
    }
  }

  void writeJson(const line::TimedSlot &slot, const line::Quantity *quantity) const {
    Json json = slotJson(slot, _source.shownUs(slot.endUs));
    if (quantity != nullptr) {
      double number = 0;
      json.text("quantity", quantity->name);
      line::parseNumber(quantity->value, number) ? json.digits("value", quantity->value)
                                                 : json.text("value", quantity->value);
      json.text("unit", quantity->unit);
    }
    write(json.line());
  }

  const line::SensorsBySlot &_sensors;
  const SourceOption &_source;
  const bool _asJson;
  line::Observer _observer;
};

void run(const SourceOption &source, const line::SensorsBySlot &sensors, bool asJson) {
  const std::unique_ptr<Input> input = source.open();
  if (asJson) {
    write(source.json().line());
  }
  TelemetryView view(input->settings().characterUs(), sensors, source, asJson);
  SilenceNote silence(source.name(), "frames", source.isFile());
  input->run([&view](const line::Character &character) { view.observer().put(character); },
             [&](uint64_t nowUs) {
               view.observer().idleUntil(input->knownUs());
               silence.tick(nowUs, view.hasFrames());
             });
  view.finish(source.name(), silence);
}

}  // namespace

void addTelemetry(CLI::App &app) {
  Subcommand subcommand(app, "telemetry", "prints the sensors of an S.BUS2 line as CSV");
  const auto source = std::make_shared<SourceOption>(subcommand, Playback::AtOnce, Rows::Rejected);
  const auto sensors = std::make_shared<SensorOption>(subcommand);
  const auto json = std::make_shared<bool>(false);
  subcommand.flag("--json", *json, "JSON lines, one per slot");
  subcommand.footer(
      "A slot does not say which sensor fills it: name the sensors that the radio has. Slot 0 is the receiver's own "
      "voltage. There is no checksum: the bytes between two frames are printed only if they are slots of the "
      "announced group, once the second frame has come or the line has ended.");
  subcommand.run([source, sensors, json] { run(*source, sensors->sensors(), *json); });
}

}  // namespace tool
