#include "cli/bridge/Bridge.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

#include "cli/Output.h"
#include "line/Silence.h"
#include "line/system/System.h"

namespace tool {

namespace {

using Kind = line::Stretch::Kind;

constexpr uint64_t FillUs = 9000;  // the period of the paper's receiver

}  // namespace

Receiver::Receiver(const SourceOption &option)
    : source(option), input(option.open()), silence(option.name(), "frames") {
  observer.reset(0, input->settings().characterUs());
  input->endOnFailure();  // the other receiver goes on, and the last frame is failsafe
}

Bridge::Bridge(BridgeOptions &options, Receiver &first, Receiver *second, const std::string &to)
    : _options(options),
      _receivers{&first, second},
      _to(to),
      _output(to, first.input->settings()),
      _isText(to == "-"),
      _hasTimes(first.source.hasTimes() && (second == nullptr || second->source.hasTimes())) {
  for (const size_t i : {size_t{0}, size_t{1}}) {
    if (_receivers[i] != nullptr) {
      _receivers[i]->observer.listen([this, i](const line::Stretch &stretch) { take(i, stretch); });
    }
  }
}

void Bridge::run() {
  Receiver &first = *_receivers[0];
  Receiver *const other = _receivers[1];
  if (_isText) {
    write(first.source.json().line());
  }
  const Input::Taker one = taker(0);
  if (other != nullptr) {
    Input::runBoth(*first.input, one, *other->input, taker(1));
  } else {
    first.input->run(one.put, one.tick);
  }
  if (isBroken()) {
    _sentUs = 0;
    fill(std::max(first.input->nowUs(), other == nullptr ? 0 : other->input->nowUs()));
  } else if (_isText && first.input->failure().empty()) {
    write(Json("end").counts(first.observer.counters()).line());
  }
  _output.finish();
  std::fprintf(stderr, "%s\n", _output.summary().c_str());
  flush();
  if (_output.isGone()) {
    throw std::runtime_error(_to + ": no program reads it any longer; start the reader, then this again");
  }
  for (Receiver *const each : _receivers) {
    if (each != nullptr) {
      each->input->requireWhole();
    }
  }
  if (isBroken()) {
    throw std::runtime_error(first.source.name() +
                             " ended before its line did: the program that writes it is gone; start it again");
  }
  first.silence.end(first.observer.counters().frames + (other != nullptr ? other->observer.counters().frames : 0) > 0);
}

Input::Taker Bridge::taker(size_t i) {
  Receiver &receiver = *_receivers[i];
  return {[&receiver](const line::Character &character) { receiver.observer.put(character); },
          [this, &receiver](uint64_t nowUs) { tick(receiver, nowUs); }};
}

void Bridge::take(size_t i, const line::Stretch &stretch) {
  Receiver &receiver = *_receivers[i];
  const line::Character &last = stretch.characters.back();
  if (!stretch.isFrame()) {
    return;
  }
  const bool isFresh = FrameOutput::mayLeave(last.sinceUs);
  receiver.freshUs = isFresh ? last.endUs : receiver.freshUs;
  judge(last.endUs);
  if (i == _choice.flying()) {
    _end = last.value;
    send(stretch.kind, last, stretch.characters[sbus::FlagsIndex].value);
  }
}

void Bridge::tick(Receiver &receiver, uint64_t nowUs) {
  receiver.observer.idleUntil(receiver.input->knownUs());
  receiver.silence.tick(nowUs, receiver.observer.counters().frames > 0);
  const bool waits = _output.tick();
  if (_output.isGone()) {
    for (Receiver *const each : _receivers) {
      if (each != nullptr) {
        each->input->end();
      }
    }
    return;
  }
  if (fill(nowUs) || waits) {
    receiver.input->hurry();
  }
}

void Bridge::judge(uint64_t nowUs) {
  if (_receivers[1] == nullptr) {
    return;
  }
  const size_t before = _choice.flying();
  _choice.judge(*_receivers[0], *_receivers[1], _options.rules.trainer(), nowUs);
  const Receiver &flying = *_receivers[_choice.flying()];
  if (&flying != _receivers[before]) {
    std::fprintf(stderr, "%.3f s: %s takes over\n", static_cast<double>(nowUs) / 1e6, flying.source.name().c_str());
  }
  Receiver &other = *_receivers[1 - _choice.flying()];
  if (other.misfit != nullptr && !std::exchange(other.isMisfitSaid, true)) {
    std::fprintf(stderr, "%s: left out, since %s sends %s\n", other.source.name().c_str(), flying.source.name().c_str(),
                 other.misfit);
  }
}

bool Bridge::haveEnded() const {
  return std::all_of(std::begin(_receivers), std::end(_receivers),
                     [](const Receiver *receiver) { return receiver == nullptr || receiver->input->hasEnded(); });
}

bool Bridge::isBroken() const { return haveEnded() && _receivers[0]->input->isBroken(); }

// While no fresh frames arrive, sends the newest values with both flags, like a receiver without a link. The end of a
// file is no silence of the line. Returns true if it has to.
bool Bridge::fill(uint64_t nowUs) {
  judge(nowUs);
  Receiver &receiver = *_receivers[_choice.flying()];
  const bool isStale = receiver.observer.state(nowUs) == sbus::LinkState::Stale ||
                       nowUs > receiver.freshUs + line::SilenceUs || isBroken();
  if (receiver.observer.newest().count == 0 || !isStale || (haveEnded() && !receiver.source.isLive())) {
    return false;
  }
  if (nowUs >= _sentUs + FillUs) {
    line::Character last;
    last.endUs = nowUs;
    last.sinceUs = line::clockUs();
    send(receiver.observer.has24() ? Kind::Frame24 : Kind::Frame, last, 0);
  }
  return true;
}

// Sends the newest values of the chosen receiver; `last` is the frame's last character, and a frame with header 2F has
// its own `flags`.
void Bridge::send(Kind kind, const line::Character &last, uint8_t flags) {
  const uint64_t nowUs = last.endUs;
  Receiver &receiver = *_receivers[_choice.flying()];
  const bool isFresh = nowUs <= receiver.freshUs + line::SilenceUs && !isBroken();
  const sbus::LinkState state = isFresh ? receiver.observer.state(nowUs) : sbus::LinkState::Stale;
  const line::Values &newest = receiver.observer.newest();
  BridgedFrame frame{kind,
                     _hasTimes ? std::optional<uint64_t>(nowUs) : std::nullopt,
                     kind == Kind::Extra ? line::withFlags(newest, flags) : newest,
                     _options.keepsEnd ? _end : uint8_t{0},
                     last.sinceUs,
                     last.lateUs};
  if (const sbus::Trainer *const trainer = _options.rules.trainer()) {
    trainer->train(frame.values.raw.data(), receiver.reception, _receivers[1]->observer.newest().raw.data());
  }
  if (kind != Kind::Extra) {
    _options.rules.apply(frame.values.raw.data());
  }
  _sentUs = nowUs;
  if (_options.rules.applyFailsafe(state, kind == Kind::Extra, frame.values)) {
    _output.put(frame);
  }
}

}  // namespace tool
