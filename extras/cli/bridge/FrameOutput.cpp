#include "cli/bridge/FrameOutput.h"

#include <algorithm>
#include <cstdio>
#include <thread>
#include <utility>

#include "cli/Json.h"
#include "cli/Output.h"
#include "line/system/System.h"

namespace tool {

namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr uint64_t OldUs = 100000;
constexpr uint64_t AheadUs = 10000;  // no clock of this PC is further ahead
constexpr microseconds Gap(2000);
constexpr milliseconds Patience(100);  // what a port has held for so long is discarded
constexpr microseconds AskAfter(1000);
constexpr microseconds AskEvery(300);
constexpr size_t FlagsAndEnd = 2;  // the last bytes of a frame

}  // namespace

FrameOutput::FrameOutput(const std::string &to, const line::LineSettings &settings)
    : _destination(to == "-" ? nullptr : std::make_unique<Destination>(to, settings)),
      _characterUs(settings.characterUs()) {}

bool FrameOutput::mayLeave(uint64_t sinceUs) {
  const uint64_t nowUs = line::clockUs();
  return sinceUs == 0 || (nowUs <= sinceUs + OldUs && sinceUs <= nowUs + AheadUs);
}

bool FrameOutput::isOld(const BridgedFrame &frame) {
  if (mayLeave(frame.sinceUs)) {
    return false;
  }
  if (_old++ == 0) {
    const bool isOtherClock = frame.sinceUs > line::clockUs();
    std::fprintf(stderr, "a frame is older than 0.1 s: such frames are left out%s\n",
                 isOtherClock ? ". It was read by another PC's clock: remove read_us from its line" : "");
  }
  return true;
}

void FrameOutput::put(const BridgedFrame &frame) {
  if (!_destination) {
    if (!isOld(frame)) {
      print(frame);
    }
    return;
  }
  const auto same = std::find_if(_waiting.begin() + (_begun > 0 ? 1 : 0), _waiting.end(),
                                 [&frame](const BridgedFrame &other) { return other.kind == frame.kind; });
  if (same != _waiting.end()) {
    *same = frame;
    _replaced++;
  } else {
    _waiting.push_back(frame);
  }
  tick();
}

bool FrameOutput::tick() {
  if (_waiting.empty()) {
    return false;
  }
  const auto silence = Clock::now() - _writtenAt;
  if (_destination->holdsBytes(nowUs())) {
    if (_destination->mayMissReads(nowUs()) ? !ask(silence) : silence < Patience) {
      return true;
    }
    _destination->discard(nowUs());
  }
  if (Clock::now() >= _freeFrom) {
    send();
  }
  return !_waiting.empty();
}

// Whether the reader of a pseudo-terminal has read the last bytes may be unknown. Then the next frame begins, byte by
// byte: one of them will be noticed. Its flags come last: by then it is fresh, or gets the failsafe flag. Returns true
// if no byte was noticed, and only the flags are left. To begin every frame so does not help: a reader that looks every
// 12 ms finds an old frame at 23 of 25 stops, and a false failsafe now and then.
bool FrameOutput::ask(Clock::duration silence) {
  const BridgedFrame &frame = _waiting.front();
  const std::vector<uint8_t> bytes = frame.bytes();
  if (_begun == bytes.size() - FlagsAndEnd) {
    return !mayLeave(frame.sinceUs);
  }
  if (silence >= (_begun == 0 ? AskAfter : AskEvery) && write({bytes[_begun]})) {
    _begun++;
  }
  return false;
}

// Sends the first of the waiting frames, or what is left of it.
void FrameOutput::send() {
  BridgedFrame frame = _waiting.front();
  _waiting.pop_front();
  if (_begun == 0 && isOld(frame)) {
    return;
  }
  if (!mayLeave(frame.sinceUs)) {
    frame.values.failsafe = frame.values.lostFrame = true;
  }
  const std::vector<uint8_t> bytes = frame.bytes();
  const auto rest = bytes.begin() + static_cast<std::ptrdiff_t>(std::exchange(_begun, 0));
  (write({rest, bytes.end()}) ? _sent : _lost)++;
  _freeFrom = _writtenAt + microseconds(bytes.size() * _characterUs) + Gap;
}

bool FrameOutput::write(const std::vector<uint8_t> &bytes) {
  _writtenAt = Clock::now();
  const size_t count = _destination->send(nowUs(), bytes);
  _cutBytes += count < bytes.size() ? count : 0;
  return count == bytes.size();
}

uint64_t FrameOutput::nowUs() const {
  return static_cast<uint64_t>(std::chrono::duration_cast<microseconds>(Clock::now() - _start).count());
}

void FrameOutput::print(const BridgedFrame &frame) {
  line::Stretch stretch;
  stretch.kind = frame.kind;
  stretch.characters = line::charactersOf(frame.bytes());
  stretch.characters.back().sinceUs = frame.sinceUs;
  stretch.characters.back().lateUs = frame.lateUs;
  std::optional<double> us;
  if (frame.us) {  // a failsafe frame may have taken the place of one that came late
    _printedUs = std::max(*frame.us, _printedUs + 1);
    us = static_cast<double>(_printedUs);
  }
  tool::write(frameJson(stretch, us, frame.values).line());
  flush();
  _sent++;
}

void FrameOutput::finish() {
  for (int ms = 0; ms < 20 && tick(); ms++) {
    std::this_thread::sleep_for(milliseconds(1));
  }
  if (_destination) {
    _destination->finish();
  }
}

std::string FrameOutput::summary() const {
  return std::to_string(_sent) + " frames sent" +
         (_replaced > 0 ? ", " + std::to_string(_replaced) + " replaced by newer ones before their turn" : "") +
         (_old > 0 ? ", " + std::to_string(_old) + " left out: older than 0.1 s" : "") +
         (_lost > 0 ? ", " + std::to_string(_lost) + " lost: the reader was too slow or gone" : "") +
         (_cutBytes > 0 ? ", " + std::to_string(_cutBytes) + " bytes of cut frames" : "");
}

}  // namespace tool
