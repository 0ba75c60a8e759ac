#include "cli/bridge/FrameOutput.h"

#include <algorithm>

#include "cli/Json.h"
#include "cli/Output.h"

namespace tool {

namespace {

constexpr std::chrono::microseconds Gap(2000);

}  // namespace

FrameOutput::FrameOutput(const std::string &to, const line::LineSettings &settings)
    : _destination(to == "-" ? nullptr : std::make_unique<Destination>(to, settings)),
      _characterUs(settings.characterUs()) {
}

bool FrameOutput::put(const BridgedFrame &frame) {
  if (!_destination) {
    print(frame);
    return true;
  }
  const auto same = std::find_if(_waiting.begin(), _waiting.end(),
                                 [&frame](const BridgedFrame &other) { return other.kind == frame.kind; });
  if (same != _waiting.end()) {
    *same = frame;
    _replaced++;
  } else {
    _waiting.push_back(frame);
  }
  return !tick();
}

bool FrameOutput::tick() {
  if (!_waiting.empty() && Clock::now() >= _freeFrom) {
    send(_waiting.front());
    _waiting.pop_front();
  }
  return !_waiting.empty();
}

void FrameOutput::send(const BridgedFrame &frame) {
  const std::vector<uint8_t> bytes = frame.bytes();
  const auto now = Clock::now();
  const auto nowUs = std::chrono::duration_cast<std::chrono::microseconds>(now - _start).count();
  const bool isSent = _destination->send(static_cast<uint64_t>(nowUs), bytes) == bytes.size();
  _freeFrom = now + std::chrono::microseconds(bytes.size() * _characterUs) + Gap;
  (isSent ? _sent : _lost)++;
}

void FrameOutput::print(const BridgedFrame &frame) {
  line::Stretch stretch;
  stretch.kind = frame.kind;
  stretch.characters = line::charactersOf(frame.bytes());
  const auto us = frame.us ? std::optional<double>(static_cast<double>(*frame.us)) : std::nullopt;
  write(frameJson(stretch, us, frame.values, ChannelForm()).line());
  flush();
  _sent++;
}

std::string FrameOutput::summary() const {
  return std::to_string(_sent) + " frames sent" +
         (_replaced > 0 ? ", " + std::to_string(_replaced) + " replaced by newer ones before their turn" : "") +
         (_lost > 0 ? ", " + std::to_string(_lost) + " lost: the reader was too slow or gone" : "");
}

}  // namespace tool
