#include "cli/SettingTrial.h"

#include <algorithm>
#include <numeric>

#include "line/Format.h"

namespace tool {

namespace {

constexpr uint64_t SilenceUs = 100000;  // between characters

uint64_t median(std::vector<uint64_t> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Returns the times from each frame to the next.
std::vector<uint64_t> intervals(const std::vector<uint64_t> &ends) {
  std::vector<uint64_t> all(ends.size());
  std::adjacent_difference(ends.begin(), ends.end(), all.begin());
  all.erase(all.begin(), all.begin() + (all.empty() ? 0 : 1));
  return all;
}

const char *polarityName(line::Polarity polarity) {
  return polarity == line::Polarity::Inverted     ? "inverted"
         : polarity == line::Polarity::Uninverted ? "uninverted"
                                                  : "unknown";
}

}  // namespace

SettingTrial::SettingTrial(const line::LineSettings &settings) : _settings(settings) {
  _observer.reset(0, settings.characterUs());
  _observer.listen([this](const line::Stretch &stretch) { take(stretch); });
}

void SettingTrial::listen(Input &input, uint64_t us, uint64_t framesUs) {
  uint64_t knownUs = 0;  // of a capture that ends in silence
  input.run(
      [this, us](const line::Character &character) {
        if (_observer.characters() == 0) {
          _spans.begin(character.endUs -
                       std::min<uint64_t>(character.endUs, _settings.characterUs() + character.lateUs));
        }
        if (us == ToItsEnd && _observer.characters() == 0) {
          _examination.begin(_observer, character.endUs);
          _lastUs = character.endUs;
        }
        heardUntil(character.endUs, character.lateUs);
        _lateUs = std::max(_lateUs, character.lateUs);
        _observer.put(character);
        _isCsv = (_rows.put(character) && _rows.recognised()) || _isCsv;
      },
      [&](uint64_t nowUs) {
        _observer.idleUntil(input.knownUs());
        knownUs = input.hasEnded() ? knownUs : input.knownUs();
        _endUs = us == ToItsEnd ? _lastUs + gapUs() : nowUs;
        if (nowUs >= us && (nowUs >= framesUs || !hasFrames())) {
          input.end();
        }
      });
  _observer.finish();
  heardUntil(std::max(us == ToItsEnd ? knownUs : _endUs, _lastUs));
  _spans.finish(_lastUs);
  _note = input.note();
}

std::string SettingTrial::text() const {
  const unsigned long errors = _observer.characterErrors();
  const unsigned long telemetry = _observer.telemetry().characters();
  const unsigned long discarded = _observer.discardedBytes();
  return line::text(_settings) + ": " +
         (_isCsv
              ? "rows of CSV"
              : _observer.frames() + ", " + (telemetry > 0 ? std::to_string(telemetry) + " bytes of telemetry, " : "") +
                    std::to_string(discarded) + (discarded == 1 ? " discarded byte" : " discarded bytes")) +
         (errors > 0 ? ", " + std::to_string(errors) + (errors == 1 ? " character error" : " character errors") : "") +
         "\n";
}

Json SettingTrial::json(bool hasTimes) const {
  std::optional<uint64_t> heardMs;
  if (hasTimes) {
    heardMs = trial().ms;
  }
  return Json("trial")
      .number("baud", _settings.baud)
      .text("polarity", polarityName(_settings.polarity))
      .number("heard_ms", heardMs)
      .number("frames", counters().frames)
      .flag("has_24_channels", _observer.has24())
      .number("telemetry_bytes", _observer.telemetry().characters())
      .number("rejected_groups", _observer.telemetry().rejectedGroups())
      .number("discarded_bytes", _observer.discardedBytes())
      .number("character_errors", _observer.characterErrors())
      .number("lost_frames", counters().lostFrames)
      .number("failsafe_frames", counters().failsafeFrames)
      .flag("rows_of_csv", _isCsv);
}

std::string SettingTrial::figures(bool hasTimes) const {
  const sbus::Counters &seen = counters();
  if (seen.frames == 0) {
    return {};
  }
  const std::string lost =
      "; " + std::to_string(uint64_t{seen.lostFrames} * 100 / seen.frames) + " % with the lost-frame flag";
  if (!hasTimes) {
    return variant() + ": times are not known" + lost + "\n";
  }
  const uint64_t silent = silentUs(&Silence::us);
  const std::vector<uint64_t> periods = this->periods();
  const uint64_t us = std::accumulate(periods.begin(), periods.end(), uint64_t{0});
  const auto aSecond = [us](uint64_t count) { return std::to_string((count * 1000000 + us / 2) / us); };
  const std::string rate = us == 0 ? _observer.frames() + ", too few for a rate"
                                   : aSecond(periods.size()) + " frames a second and " +
                                         aSecond(sbus::impairedFrames(seen)) + " damaged, frame interval " +
                                         std::to_string(usualPeriodUs(periods, us)) + " us";
  return variant() + ": " + rate + lost +
         (silent == 0 ? "" : line::format("; silent for %.2f s", line::seconds(silent))) + "\n";
}

std::string SettingTrial::telemetry() const {
  const line::TelemetrySlots &telemetry = _observer.telemetry();
  const unsigned long rejected = telemetry.rejectedGroups();
  std::vector<std::string> parts = _readings.quantities(0);
  if (const std::string slots = _readings.slots(0); !slots.empty()) {
    parts.push_back(slots);
  }
  if (rejected > 0) {
    parts.push_back(std::to_string(rejected) + " of " + std::to_string(rejected + telemetry.groups()) +
                    " groups rejected: a byte is missing or too many, or two sensors share a slot");
  }
  std::string text;
  for (const std::string &part : parts) {
    text += (text.empty() ? "Telemetry: " : "; ") + part;
  }
  return text.empty() ? "" : text + "\n";
}

void SettingTrial::take(const line::Stretch &stretch) {
  _readings.put(_observer.telemetry().proved());
  if (stretch.isFrame() && stretch.kind != line::Stretch::Kind::Extra) {
    _ends.push_back(stretch.endUs());
    _spans.brokenUntil(stretch.endUs(), stretch.lateUs());
    _spans.put(stretch.endUs(), false, false, false);
  }
}

// Notes a silence from the last character to `us`, where the next one ends or listening stops. The next one may have
// ended up to `lateUs` earlier.
void SettingTrial::heardUntil(uint64_t us, uint64_t lateUs) {
  if (us >= _lastUs + SilenceUs) {
    const bool isProved = _observer.characters() > 0 && us >= _lastUs + lateUs + SilenceUs;
    _silences.push_back({_lastUs, us - _lastUs, isProved ? us - lateUs - _lastUs : 0});
  }
  _lastUs = us;
}

// Returns the shortest time without a character that counts as a silence: one missing frame does not.
uint64_t SettingTrial::silenceUs() const {
  constexpr uint64_t PeriodMostUs = 500000;  // what comes more seldom is no line of frames
  const uint64_t us = _ends.size() < 3 ? 0 : median(intervals(_ends));
  return std::max(SilenceUs, us > PeriodMostUs ? 0 : us * 5 / 2);
}

uint64_t SettingTrial::silentUs(uint64_t Silence::*us) const {
  const uint64_t least = silenceUs();
  return std::accumulate(_silences.begin(), _silences.end(), uint64_t{0},
                         [&](uint64_t sum, const Silence &each) { return sum + (each.us >= least ? each.*us : 0); });
}

std::string SettingTrial::framesInPart() const {
  constexpr uint64_t PartUs = 300000;
  constexpr size_t FramesLeast = 10;  // for each time without: on a line with a wrong setting they come by chance
  std::vector<line::FlagSpan> without = _spans.all();
  without.erase(std::remove_if(without.begin(), without.end(),
                               [this](const line::FlagSpan &each) {
                                 return each.kind != line::FlagSpan::Kind::NoFrames || each.us() < silenceUs();
                               }),
                without.end());
  const uint64_t silent = silentUs(&Silence::us), all = sumUs(without);
  if (without.empty() || _ends.size() < FramesLeast * without.size()) {
    return {};
  }
  const line::FlagSpan &last = without.back();
  if (last.fromUs == _ends.back() && last.us() >= PartUs) {
    const bool isSilent = !_silences.empty() && _silences.back().beginUs + _silences.back().us >= last.toUs &&
                          2 * _silences.back().us > last.us();
    return line::format("Frames stop: for the last %.1f s %s.", line::seconds(last.us()),
                        isSilent ? "the line is silent" : "bytes come, but no frame");
  }
  if (all < silent + PartUs) {
    return {};
  }
  const line::FlagSpan &first = without.front();
  return first.toUs == _ends.front()
             ? line::format("Frames begin late: for the first %.1f s bytes come, but no frame.",
                            line::seconds(first.us()))
             : line::format("Frames in part: for %.1f s bytes come, but no frame.", line::seconds(all - silent));
}

// Returns the frame periods without those interrupted by a silence, which may last for hours.
std::vector<uint64_t> SettingTrial::periods() const {
  std::vector<uint64_t> periods;
  const uint64_t least = silenceUs();
  auto silence = _silences.begin();
  for (size_t i = 1; i < _ends.size(); i++) {
    silence = std::find_if(silence, _silences.end(),
                           [&](const Silence &each) { return each.beginUs >= _ends[i - 1] && each.us >= least; });
    if (silence == _silences.end() || silence->beginUs >= _ends[i]) {
      periods.push_back(_ends[i] - _ends[i - 1]);
    }
  }
  return periods;
}

unsigned SettingTrial::periodMs() const {
  const std::vector<uint64_t> periods = this->periods();
  const uint64_t us = std::accumulate(periods.begin(), periods.end(), uint64_t{0});
  return us == 0 ? 0 : static_cast<unsigned>((usualPeriodUs(periods, us) + 500) / 1000);
}

// Returns the median, which an impaired frame does not change; the mean if the port delivers bytes in bursts, so that
// no single period is exact.
uint64_t SettingTrial::usualPeriodUs(const std::vector<uint64_t> &periods, uint64_t us) const {
  return _lateUs > 0 ? us / periods.size() : median(periods);
}

// Returns the gap to assume after the last frame of a recording.
uint64_t SettingTrial::gapUs() const {
  const uint64_t frameUs = uint64_t{sbus::FrameSize} * _settings.characterUs();
  return std::max(_observer.gaps().low, frameUs) - frameUs;
}

}  // namespace tool
