#include "line/ports/SerialPort.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include "line/system/System.h"

namespace line {

namespace {

constexpr int IdleMs = 50;  // between two reads of a silent port

}  // namespace

SerialPort::SerialPort(const std::string &device, const LineSettings &settings)
    : _device(device),
      _port(device, settings, PortFile::Way::Read),
      _lowLatency(_port.file()),
      _latencyFile(latencyFile(device)),
      _latencyMs(latencyMs(_latencyFile)),
      _reads(settings.characterUs(), _latencyMs ? *_latencyMs * 1000 : PortReads::UsualLatencyUs) {
  _sinceUs = clockUs();
  if (!_port.markErrors()) {
    throw std::runtime_error(device + ": the system does not report parity and framing errors; name another port");
  }
}

bool SerialPort::next(uint64_t nowUs, Character &character) {
  if (!_started) {
    _started = true;
    _zeroUs = clockUs() - nowUs;
  }
  if (_waiting.empty() && _failure.empty()) {
    poll();
  }
  if (_waiting.empty()) {
    return false;
  }
  character = _waiting.front();
  _waiting.pop_front();
  return true;
}

// After bytes, the next read is due when it can prove that the line is silent.
bool SerialPort::wait() {
  _port.wait(_isSilent ? IdleMs : _reads.knownAfterMs());
  return true;
}

std::string SerialPort::note() const {
  if (!_latencyMs) {
    return "This port does not tell how long it holds bytes back: gaps shorter than " +
           std::to_string(_reads.knownAfterMs()) + " ms are not seen.";
  }
  return *_latencyMs <= 1
             ? ""
             : "The adapter holds bytes back for up to " + std::to_string(*_latencyMs) +
                   " ms, which hides the gaps between frames. To see them: echo 1 | sudo tee " + _latencyFile;
}

// Reads the clock, since the caller's time may be older than the bytes.
uint64_t SerialPort::nowUs() const { return clockUs() - _zeroUs; }

void SerialPort::poll() {
  uint8_t bytes[256];
  const uint64_t askedUs = nowUs();
  const uint64_t clockAskedUs = clockUs();
  const std::ptrdiff_t count = _port.read(bytes, sizeof bytes);
  if (count > 0) {
    take(bytes, static_cast<size_t>(count));
  } else {
    _isSilent = askedUs > _lastReadUs + uint64_t{1000} * static_cast<unsigned>(_reads.knownAfterMs());
    _reads.empty(askedUs);
    _sinceUs = clockAskedUs;
  }
  if (count < 0) {
    _failure = _device + ": the port is gone. Plug the adapter in and start again";
  }
}

void SerialPort::take(const uint8_t *bytes, size_t count) {
  _lastReadUs = nowUs();
  std::vector<Character> characters;
  for (size_t i = 0; i < count; i++) {
    Character character;
    if (unmark(bytes[i], character)) {
      characters.push_back(character);
    }
  }
  if (!characters.empty()) {
    _reads.begin(characters.size(), _lastReadUs, PortReads::UsualLatencyUs);
  }
  for (const Character &character : characters) {
    _waiting.push_back(_reads.next(character.value, character.bad));
    _waiting.back().sinceUs = _sinceUs;
  }
}

// Takes a byte or a mark. Returns true if a character is complete.
bool SerialPort::unmark(uint8_t byte, Character &character) {
  if (_mark == Mark::None && byte == 0xFF) {
    _mark = Mark::Escape;
    return false;
  }
  if (_mark == Mark::Escape && byte == 0x00) {
    _mark = Mark::Bad;
    return false;
  }
  character.value = byte;
  character.bad = std::exchange(_mark, Mark::None) == Mark::Bad;
  return true;
}

}  // namespace line
