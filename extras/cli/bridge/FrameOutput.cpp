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
constexpr milliseconds AskAfter(1);
constexpr milliseconds AskAfterMost(1600);
constexpr microseconds AskEvery(300);
constexpr size_t FlagsAndEnd = 2;  // the last bytes of a frame

}  // namespace

FrameOutput::FrameOutput(const std::string &to, const line::LineSettings &settings)
    : _destination(to == "-" ? nullptr : std::make_unique<Destination>(to, settings)),
      _characterUs(settings.characterUs()),
      _askAfter(AskAfter) {
}

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
  const auto same = std::find_if(_waiting.begin(), _waiting.end(),
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
  if (_waiting.empty() && _begun == 0) {
    return false;
  }
  const auto silence = Clock::now() - _writtenAt;
  if (!_destination->holdsBytes(nowUs())) {
    _askAfter = AskAfter;
  } else if (!_destination->mayMissReads(nowUs())) {
    if (silence < Patience) {
      return true;
    }
    _destination->discard(nowUs());
  } else if (!isOver()) {
    ask(silence);
    return true;
  } else {
    _askAfter = std::min<Clock::duration>(2 * std::max<Clock::duration>(_askAfter, Patience), AskAfterMost);
  }
  if (Clock::now() >= _freeFrom && choose() && (_begun > 1 || !isOld(_current))) {
    send();
  }
  return !_waiting.empty();
}

// Returns true if a frame that has begun can no longer leave without the failsafe flag.
bool FrameOutput::isOver() const {
  return _begun > 1 && !mayLeave(_current.sinceUs);
}

// Chooses the frame to send: the one of which two bytes have left, or the oldest pending frame; after one byte, the
// oldest that begins with this byte. Returns false without a frame.
bool FrameOutput::choose() {
  const auto frame = std::find_if(_waiting.begin(), _waiting.end(), [this](const BridgedFrame &each) {
    return _begun == 0 || each.bytes().front() == _current.bytes().front();
  });
  if (_begun < 2 && frame != _waiting.end()) {
    _current = *frame;
    _waiting.erase(frame);
    return true;
  }
  return _begun > 1;
}

// Whether the reader of a pseudo-terminal has read the last bytes may be unknown. Then the next frame begins, byte by
// byte: one of them will be noticed. Its flags come last: by then it is fresh, or gets the failsafe flag.
void FrameOutput::ask(Clock::duration silence) {
  if (silence < (_begun == 0 ? _askAfter : AskEvery) || (_begun < 2 && !choose())) {
    return;
  }
  const std::vector<uint8_t> bytes = _current.bytes();
  if (_begun < bytes.size() - FlagsAndEnd && write({bytes[_begun]})) {
    _begun++;
  }
  if (_begun == 1) {
    _waiting.push_front(_current);  // a newer one may still replace it
  }
}

void FrameOutput::send() {
  if (!mayLeave(_current.sinceUs)) {
    _current.values.failsafe = _current.values.lostFrame = true;
  }
  const std::vector<uint8_t> bytes = _current.bytes();
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
