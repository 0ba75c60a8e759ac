#include "cli/monitor/MonitoredLine.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cli/Json.h"
#include "cli/options/CsvColumn.h"
#include "line/Format.h"
#include "sbus/Diagnosis.h"

namespace tool {

namespace {

constexpr uint64_t SecondUs = 1000000;
// This long after the newest byte the line counts as silent; line::TailUs is longer.
constexpr uint64_t BytesUs = 200000;
constexpr uint64_t TelemetryUs = 50000;  // this long after a frame bytes may be its telemetry
constexpr uint64_t NewsUs = 5 * SecondUs;
constexpr uint64_t StaleRowUs = SecondUs;  // the sketches print a row every 200 ms
constexpr size_t SketchColumns = 6;        // examples/DecodeSBus
constexpr size_t AllColumns = 18;          // examples/AllChannels

std::string age(uint64_t us) {
  return us < SecondUs        ? line::format("%4lu ms", static_cast<unsigned long>(us / 1000))
         : us < 10 * SecondUs ? line::format("%5.1f s", line::seconds(us))
                              : line::format("%5.0f s", line::seconds(us));
}

std::string count(const char *name, uint64_t value) {
  return line::format("%s %lu", name, static_cast<unsigned long>(value));
}

std::string gaps(const line::Extent &gaps) {
  const auto ms = [](uint64_t us) { return static_cast<double>(us) / 1000; };
  return gaps.count == 0
             ? "gap -"
             : line::format("gap min %.2f mean %.2f max %.2f ms", ms(gaps.low), ms(gaps.mean()), ms(gaps.high));
}

}  // namespace

MonitoredLine::MonitoredLine(const std::string &source, bool hasTimes, const line::LineSettings &settings,
                             const sbus::Range &range, const sbus::Range &pulses, const line::SensorsBySlot &sensors)
    : _source(source), _hasTimes(hasTimes), _settings(settings), _range(range), _pulses(pulses), _readings(sensors) {
  _observer.reset(0, settings.characterUs());
  _observer.listen([this](const line::Stretch &stretch) { take(stretch); });
}

void MonitoredLine::put(const line::Character &character) {
  _characterUs = character.endUs;
  _observer.put(character);
  if (_rows.put(character) && _rows.recognised()) {
    takeRow(character.endUs);
  }
}

// The page already shows the name of the source.
void MonitoredLine::news(const std::string &text, uint64_t nowUs) {
  const std::string name = _source + ": ";
  _news = text.compare(0, name.size(), name) == 0 ? text.substr(name.size()) : text;
  _newsUs = nowUs;
}

void MonitoredLine::reset() {
  _observer.resetMarks();
  _before = _observer.counters();
  _errorsBefore = _observer.characterErrors();
  _discardedBefore = _observer.discardedBytes();
  _columns.clear();
  _rowGaps = line::Extent();
}

void MonitoredLine::take(const line::Stretch &stretch) {
  _readings.put(_observer.telemetry().proved());
  _isCsv = _isCsv && !stretch.isFrame();
}

bool MonitoredLine::rowIsRaw() const {
  const size_t columns = _row.size();
  return (columns == SketchColumns || columns == AllColumns || columns == sbus::ChannelCount24 || columns == 32) &&
         std::all_of(_row.begin(), _row.end(), [](const line::CsvField &field) {
           return field.value >= 0 && field.value <= sbus::ChannelMax && field.value == std::floor(field.value);
         });
}

void MonitoredLine::takeRow(uint64_t endUs) {
  if (_isCsv) {
    _rowGaps.add(endUs - _rowUs);
  }
  _isCsv = true;
  _rowUs = endUs;
  _row = _rows.row();
  _wasRaw = (_wasRaw || _columns.size() != _row.size()) && rowIsRaw();
  const bool first = _columns.size() != _row.size();
  _columns.resize(_row.size());
  for (size_t i = 0; i < _row.size(); i++) {
    const double value = _row[i].value;
    _columns[i].low = first ? value : std::min(_columns[i].low, value);
    _columns[i].high = first ? value : std::max(_columns[i].high, value);
  }
}

MonitorView MonitoredLine::view(uint64_t nowUs) {
  MonitorView view;
  view.source = _source;
  view.range = _range;
  view.pulses = _pulses;
  if (_isCsv) {
    showRows(view, nowUs);
  } else {
    showFrames(view, nowUs);
    showState(view, nowUs);
  }
  if (!_news.empty() && (nowUs < _newsUs + NewsUs || _newsUs >= _characterUs)) {
    view.banner = _news;
    view.bannerMood = view.old ? Mood::Bad : Mood::Warn;
  }
  view.plain = view.quality;
  for (const MonitorView::Group &group : view.groups) {
    for (const std::string &fact : group.facts) {
      view.plain += (view.plain.empty() ? "" : ", ") + fact;
    }
  }
  return view;
}

std::string MonitoredLine::json(uint64_t nowUs, int64_t zeroUs) {
  const std::string shownUs = std::to_string(static_cast<int64_t>(nowUs) + zeroUs);
  if (_isCsv) {
    std::vector<double> values(_row.size());
    std::transform(_row.begin(), _row.end(), values.begin(), [](const line::CsvField &field) { return field.value; });
    return Json("row")
        .digits("time_us", shownUs)
        .number("age_us", nowUs - std::min(nowUs, _rowUs))
        .numbers("values", values)
        .line();
  }
  const line::Values &values = _observer.newest();
  const sbus::Counters &now = _observer.counters();
  Json json("state");
  json.digits("time_us", shownUs).text("state", stateName(_observer.heldState(nowUs)));
  if (values.count > 0) {
    json.number("age_us", _observer.ageUs(nowUs)).channels(values, 1, values.count);
    if (!_observer.has24()) {
      json.flag("ch17", values.switches[0]).flag("ch18", values.switches[1]);
    }
    json.flag("lost_frame", values.lostFrame).flag("failsafe", _observer.inFailsafe());
  }
  std::optional<uint64_t> perSecond;
  if (_hasTimes) {
    perSecond = _observer.perSecond(nowUs);
  }
  return json.number("frames_per_second", perSecond)
      .number("link_quality", _observer.linkQuality(nowUs))
      .counts(now)
      .number("discarded_bytes", _observer.discardedBytes())
      .number("character_errors", _observer.characterErrors())
      .line();
}

void MonitoredLine::showFrames(MonitorView &view, uint64_t nowUs) {
  const line::Values &values = _observer.newest();
  const std::string variant = _observer.variant().text();
  view.kind = (variant.empty() ? "" : variant + ", ") + std::to_string(_settings.baud) + " baud";
  const bool seen = values.count > 0;
  view.channels.resize(seen ? values.count : sbus::ProportionalCount);
  for (size_t i = 0; i < values.count; i++) {
    const line::Extent &travel = _observer.travel(i);
    MonitorView::Channel &channel = view.channels[i];
    channel.value = values.raw[i];
    channel.low = static_cast<double>(travel.low);
    channel.high = static_cast<double>(travel.high);
    channel.marked = travel.count > 0;
    channel.text = std::to_string(values.raw[i]);
  }
  if (!_observer.has24()) {
    // With more channels CH17 is one of them, and Futaba calls the switches DG1 and DG2.
    const bool more = values.count > sbus::ProportionalCount;
    view.indicators.push_back({more ? "DG1" : "CH17", values.switches[0], Mood::Good});
    view.indicators.push_back({more ? "DG2" : "CH18", values.switches[1], Mood::Good});
  }
  view.indicators.push_back({"Frame lost", _observer.showsLostFrame(nowUs), Mood::Warn});
  view.indicators.push_back({"Failsafe", _observer.showsFailsafe(nowUs), Mood::Bad});
  view.quality = line::format("quality %u %%", _observer.linkQuality(nowUs));
  view.groups = groups(nowUs, seen);
  if (_observer.telemetry().count() > 0) {
    view.groups.insert(view.groups.end() - 1, telemetry(nowUs));
  }
}

MonitorView::Group MonitoredLine::telemetry(uint64_t nowUs) const {
  const uint64_t sinceUs = nowUs - std::min(nowUs, line::Readings::FreshUs);
  MonitorView::Group group = {"Sensors", _readings.quantities(sinceUs)};
  const std::string slots = _readings.slots(sinceUs);
  group.facts.push_back(slots.empty() ? "no telemetry" : slots);
  return group;
}

std::vector<MonitorView::Group> MonitoredLine::groups(uint64_t nowUs, bool seen) const {
  const sbus::Counters &now = _observer.counters();
  return {
      {"Frames",
       {seen ? "newest" + age(_observer.ageUs(nowUs)) + " old" : "none yet",
        _hasTimes ? line::format("%3u frames/s", _observer.perSecond(nowUs)) : "  - frames/s",
        count("lost by radio", now.lostFrames - _before.lostFrames),
        count("failsafe", now.failsafeFrames - _before.failsafeFrames), count("total", now.frames - _before.frames)}},
      {"Line",
       {_hasTimes ? gaps(_observer.gaps()) : "gap -",
        count("character errors", _observer.characterErrors() - _errorsBefore),
        count("bytes discarded", _observer.discardedBytes() - _discardedBefore)}},
      {"Rejected",
       {count("no end byte", now.rejectedByEnd - _before.rejectedByEnd),
        count("unused flags", now.rejectedByFlags - _before.rejectedByFlags),
        count("length or gap", now.rejectedByLength - _before.rejectedByLength),
        count("found again", now.resyncs - _before.resyncs)}},
  };
}

void MonitoredLine::showState(MonitorView &view, uint64_t nowUs) {
  const line::Values &values = _observer.newest();
  const bool areAfterFrame = values.count == 0 || _characterUs > values.endUs + TelemetryUs;
  const bool bytesCome = _observer.characters() > 0 && nowUs < _characterUs + BytesUs && areAfterFrame;
  const sbus::LinkState state = _observer.heldState(nowUs);
  switch (state) {
    case sbus::LinkState::NeverSeen:
      view.state = stateName(sbus::LinkState::NeverSeen);
      view.mood = Mood::Warn;
      view.old = true;
      if (nowUs >= SecondUs) {
        view.bannerMood = Mood::Warn;
        view.banner = (bytesCome ? "No frames: bytes arrive, but no frame. Run: sbus doctor "
                                 : "No signal: no bytes arrive. Run: sbus doctor ") +
                      _source;
      }
      break;
    case sbus::LinkState::Ok:
    case sbus::LinkState::Lossy:
      view.state = stateName(state);
      view.mood = state == sbus::LinkState::Lossy ? Mood::Warn : Mood::Good;
      break;
    case sbus::LinkState::Failsafe:
      view.state = stateName(sbus::LinkState::Failsafe);
      view.mood = Mood::Bad;
      view.banner = values.failsafe ? text(sbus::Finding::Failsafe) : text(sbus::Finding::NoRadio);
      view.banner += values.failsafe ? " The values are its failsafe setting." : " The values are old.";
      break;
    case sbus::LinkState::Stale:
      view.state = stateName(sbus::LinkState::Stale);
      view.mood = Mood::Bad;
      view.old = true;
      view.banner =
          "Stale: no frame for " + line::format("%.1f s", line::seconds(_observer.ageUs(nowUs))) +
          (bytesCome ? ", though bytes arrive. The values are old." : ": the line is silent. The values are old.");
      break;
  }
}

void MonitoredLine::showRows(MonitorView &view, uint64_t nowUs) const {
  const uint64_t ageUs = nowUs > _rowUs ? nowUs - _rowUs : 0;
  const bool sketch = _wasRaw && _row.size() == SketchColumns;
  const size_t channels = sketch                                 ? SketchColumns - 2
                          : _wasRaw && _row.size() == AllColumns ? AllColumns - 2
                                                                 : _row.size();
  view.kind = "rows of CSV";
  view.isRaw = _wasRaw;
  for (size_t i = 0; i < channels; i++) {
    const bool marked = _columns.size() == _row.size();
    view.channels.push_back(
        {_row[i].value, marked ? _columns[i].low : 0, marked ? _columns[i].high : 0, marked, _row[i].text});
  }
  for (size_t i = channels; i < _row.size(); i++) {
    const bool failsafe = sketch && i == channels;
    view.indicators.push_back({sketch ? (failsafe ? "Failsafe" : "Frame lost") : "CH" + std::to_string(i + 1),
                               _row[i].value > 0,
                               failsafe ? Mood::Bad
                               : sketch ? Mood::Warn
                                        : Mood::Good});
  }
  view.groups = {{"Rows", {"newest" + age(ageUs) + " old", count("total", _rowGaps.count + 1), gaps(_rowGaps)}}};
  view.old = ageUs >= StaleRowUs;
  view.state = stateName(view.old ? sbus::LinkState::Stale : sbus::LinkState::Ok);
  view.mood = view.old ? Mood::Bad : Mood::Good;
  if (view.old) {
    view.banner = "Stale: no row for " + line::format("%.1f s", line::seconds(ageUs)) +
                  ": a sketch prints none while the line is silent. The values are old.";
  } else if (sketch && _row[channels].value > 0) {
    view.state = stateName(sbus::LinkState::Failsafe);
    view.mood = Mood::Bad;
    view.banner = std::string(text(sbus::Finding::Failsafe)) + " The values are its failsafe setting.";
  }
}

}  // namespace tool
