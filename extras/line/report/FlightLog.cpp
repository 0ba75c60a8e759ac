#include "line/report/FlightLog.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "line/Format.h"

namespace line {

namespace {

constexpr uint64_t SecondUs = 1000000;
constexpr double WarningAt = 0.02;  // share of lost frames

// Rates parts of the flight, which must be asked for in order.
class Judge {
 public:
  explicit Judge(const FlightLog &flight)
      : _flight(flight),
        _silences(flight.spans(FlagSpan::Kind::NoFrames)),
        _late(flight.spans(FlagSpan::Kind::Late)),
        _second(flight.seconds().begin()) {}

  // Rates the seconds from `first` up to, but without, `end`.
  FlightRating of(uint64_t first, uint64_t end) {
    FlightRating part;
    part.fromUs = std::max(first * SecondUs, _flight.fromUs());
    part.toUs = std::min(end * SecondUs, _flight.toUs());
    FlightSecond sum;
    for (; _second != _flight.seconds().end() && _second->first < end; ++_second) {
      sum.frames += _second->second.frames;
      sum.lost += _second->second.lost;
      sum.failsafe += _second->second.failsafe;
    }
    const uint64_t silentUs = common(_silences, _silence, part);
    const uint64_t lateUs = common(_late, _lateAt, part);
    part.failsafe = sum.failsafe > 0;
    part.silent = silentUs > 0;
    part.late = lateUs > 0;
    const uint64_t lengthUs = part.toUs - part.fromUs;
    const double expected = seconds(lengthUs - std::min(lengthUs, lateUs)) * _flight.rate().perSecond();
    const double missing =
        std::max(0.0, std::floor(expected - _flight.rate().uncertain()) - sum.frames);  // one may be on the border
    const double all = sum.frames + (missing > 1 ? missing : 0);
    part.lost = all > 0 ? (sum.lost + (missing > 1 ? missing : 0)) / all : 0;
    return part;
  }

 private:
  // Returns how much of the part is covered by the spans; `at` is the first one that may reach into it.
  static uint64_t common(const std::vector<FlagSpan> &spans, size_t &at, const FlightRating &part) {
    uint64_t us = 0;
    while (at < spans.size() && spans[at].toUs <= part.fromUs) {
      at++;
    }
    for (size_t i = at; i < spans.size() && spans[i].fromUs < part.toUs; i++) {
      us += std::min(spans[i].toUs, part.toUs) - std::max(spans[i].fromUs, part.fromUs);
    }
    return us;
  }

  const FlightLog &_flight;
  const std::vector<FlagSpan> _silences;
  const std::vector<FlagSpan> _late;
  std::map<uint64_t, FlightSecond>::const_iterator _second;
  size_t _silence = 0;
  size_t _lateAt = 0;
};

std::string times(const std::vector<FlagSpan> &spans, bool hasTimes) {
  return format("%zu %s", spans.size(), spans.size() == 1 ? "time" : "times") +
         (hasTimes ? format(", longest %.1f s", seconds(longest(spans, 1)[0].us())) : "");
}

}  // namespace

void FlightLog::heard(uint64_t us, bool isSilence) {
  if (_fromUs == UINT64_MAX) {
    _fromUs = us;
    _flags.begin(us);
  }
  _toUs = std::max(_toUs, us);
  _silentUs = std::max(_silentUs, us - std::min(us, _byteUs));
  _byteUs = isSilence ? _byteUs : us;
}

void FlightLog::finish(const FlightCounts &counts) {
  _counts = counts;
  _flags.finish(_toUs);
  const std::vector<FlagSpan> silences = spans(FlagSpan::Kind::NoFrames);
  _fromUs = !silences.empty() && silences.front().toUs == firstUs() ? silences.front().fromUs : firstUs();
  _toUs = !silences.empty() && silences.back().fromUs == lastUs() ? silences.back().toUs : lastUs();
}

std::string FlightLog::endText() const {
  return _toUs == lastUs()
             ? ""
             : format("No frames at the end: for the last %.3f s %s.", line::seconds(_toUs - lastUs()),
                      2 * _silentUs > _toUs - lastUs() ? "the line is silent" : "bytes come, but no frame");
}

void FlightLog::put(const FlightFrame &frame) {
  _variant.take(frame.kind, frame.end);
  if (frame.kind == Stretch::Kind::Extra) {
    return;
  }
  const bool isJoined = !_flags.brokenUntil(frame.us, frame.lateUs) && _flags.lastUs() > 0;
  _rate.put(frame.us, frame.lateUs, isJoined);
  _silentUs = _byteUs - std::min(_byteUs, frame.us);
  FlightSecond &second = _seconds[frame.us / SecondUs];
  second.frames++;
  second.lost += frame.lost;
  second.failsafe += frame.failsafe || frame.pulseless;
  _curves.put(frame.us, frame.channels.data(), isJoined);
  const uint32_t jumped = _jumps.put(frame.us, frame.channels.data(), frame.count, !frame.failsafe && !frame.pulseless);
  if (jumped != 0) {
    _flags.jump(frame.us, jumped);
  }
  _flags.put(frame.us, frame.failsafe, frame.lost, frame.pulseless);
}

std::vector<FlagSpan> FlightLog::spans(FlagSpan::Kind kind) const {
  std::vector<FlagSpan> spans;
  std::copy_if(_flags.all().begin(), _flags.all().end(), std::back_inserter(spans),
               [kind](const FlagSpan &span) { return span.kind == kind; });
  return spans;
}

std::vector<FlightRating> stripOf(const FlightLog &flight, size_t count) {
  const uint64_t first = flight.fromUs() / SecondUs;
  const uint64_t end = flight.toUs() / SecondUs + 1;
  const uint64_t parts = std::min<uint64_t>(count, end - first);
  Judge judge(flight);
  std::vector<FlightRating> strip;
  for (uint64_t i = 0; i < parts; i++) {
    strip.push_back(judge.of(first + (end - first) * i / parts, first + (end - first) * (i + 1) / parts));
  }
  return strip;
}

std::vector<FlightRating> worstSeconds(const FlightLog &flight, size_t count) {
  std::vector<FlightRating> worst;
  Judge judge(flight);
  std::vector<FlagSpan> listed;
  for (const auto kind : {FlagSpan::Kind::Failsafe, FlagSpan::Kind::NoPulses, FlagSpan::Kind::NoFrames}) {
    const std::vector<FlagSpan> some = longest(flight.spans(kind), count);
    listed.insert(listed.end(), some.begin(), some.end());
  }
  const auto isListed = [&listed](const FlightRating &part) {
    return std::any_of(listed.begin(), listed.end(),
                       [&part](const FlagSpan &span) { return span.fromUs < part.toUs && span.toUs > part.fromUs; });
  };
  for (uint64_t second = flight.fromUs() / SecondUs; second <= flight.toUs() / SecondUs; second++) {
    const FlightRating part = judge.of(second, second + 1);
    if ((part.lost > 0 || part.failsafe) && !isListed(part)) {
      worst.push_back(part);
    }
    if (worst.size() == 2 * count || second == flight.toUs() / SecondUs) {
      std::stable_sort(worst.begin(), worst.end(), [](const FlightRating &a, const FlightRating &b) {
        return a.failsafe != b.failsafe ? a.failsafe : a.lost > b.lost;
      });
      worst.resize(std::min(worst.size(), count));
    }
  }
  return worst;
}

FlightVerdict verdictOf(const FlightLog &flight, bool hasTimes) {
  using Severity = FlightVerdict::Severity;
  const std::vector<FlagSpan> failsafe = flight.spans(FlagSpan::Kind::Failsafe);
  const std::vector<FlagSpan> pulseless = flight.spans(FlagSpan::Kind::NoPulses);
  const std::vector<FlagSpan> silences = flight.spans(FlagSpan::Kind::NoFrames);
  const FlightCounts &counters = flight.counts();
  const unsigned long all = counters.frames + flight.rate().missing();
  const double lost =
      all > 0 ? static_cast<double>(counters.lostFrames + flight.rate().missing()) / static_cast<double>(all) : 0;
  const std::string lostText = format("%.2f %% of the frames lost", 100 * lost);
  std::string text;
  const auto add = [&text, hasTimes](const char *name, const std::vector<FlagSpan> &spans) {
    text += spans.empty() ? "" : (text.empty() ? "" : "; ") + (name + times(spans, hasTimes));
  };
  add("failsafe ", failsafe);
  add("no pulses (0 on CH1 to CH4, without a flag) ", pulseless);
  add("no frames ", silences);
  const bool isFirst = flight.fromUs() < flight.firstUs();
  const bool isLast = flight.toUs() > flight.lastUs();
  text += isFirst && isLast ? ", at the beginning and at the end"
          : isFirst         ? ", at the beginning"
          : isLast          ? ", at the end"
                            : "";
  if (!text.empty()) {
    text[0] = text[0] == 'f' ? 'F' : 'N';
    return {Severity::Bad, text + "; " + lostText + "."};
  }
  const size_t jumps = flight.spans(FlagSpan::Kind::Jump).size();
  if (jumps > 0) {
    return {Severity::Warning, format("No failsafe, no silence, but channels have jumped for one frame %zu %s; ", jumps,
                                      jumps == 1 ? "time" : "times") +
                                   lostText + "."};
  }
  return lost >= WarningAt ? FlightVerdict{Severity::Warning, "No failsafe, no silence, but " + lostText + "."}
                           : FlightVerdict{Severity::Good, "All well: no failsafe, no silence, " + lostText + "."};
}

}  // namespace line
