#include "line/simulation/SimulatedBus.h"

#include <algorithm>

#include "sbus2/Sensors.h"

namespace line {

namespace {

constexpr uint32_t SlotsPeriodUs = 15000;     // PX4-Autopilot's capture: 15.00 to 15.01 ms
constexpr uint32_t OnlySlot0PeriodUs = 6300;  // mstrens/oXs_on_RP2040, doc/FUTABA SBUS (1).docx, images 12 and 13
constexpr uint32_t OnlySlot0Us = 310;         // same source
constexpr uint16_t SupplyDecivolts = 46;      // 4.6 V, as in PX4-Autopilot's capture
constexpr uint16_t ExternalDecivolts = 241;   // 24.1 V, takarakasai/sbus, doc/spec.md
constexpr uint8_t OnlySlot0End = 0x08;
constexpr size_t MostFrames = 8;  // to remember

constexpr uint32_t periodUs(BusMode mode) { return mode == BusMode::OnlySlot0 ? OnlySlot0PeriodUs : SlotsPeriodUs; }

}  // namespace

SimulatedBus::SimulatedBus(const Choreography &choreography, BusMode mode)
    : _mode(mode), _receiver(choreography, CharacterUs, Channels::Sixteen, periodUs(mode)) {}

bool SimulatedBus::next(uint64_t nowUs, Character &character) {
  if (nowUs < CharacterUs) {
    return false;
  }
  const uint64_t endedUs = nowUs - CharacterUs;
  while (_madeUs <= endedUs) {
    makeCycle();
  }
  if (_wire.empty() || _wire.front().endUs > endedUs) {
    return false;
  }
  const Sent &sent = _wire.front();
  if (sent.isFramesEnd) {
    _judge.frame(sent.endUs, sent.value);
  }
  _judge.idleUntil(sent.endUs);
  character = sent;
  character.bad = character.bad || _isHeld;
  character.parityWrong = character.bad;
  _wire.pop_front();
  return true;
}

// Makes a frame and its slots.
void SimulatedBus::makeCycle() {
  const uint8_t group = _cycles % 4;
  const uint8_t end = _mode == BusMode::Slots       ? static_cast<uint8_t>(group << 4 | 4)
                      : _mode == BusMode::OnlySlot0 ? OnlySlot0End
                                                    : uint8_t{0};
  Sent sent;
  for (uint8_t i = 0; i < sbus::FrameSize; i++) {
    _receiver.next(UINT64_MAX, sent);
    sent.endUs += static_cast<uint64_t>(_shiftUs);
    sent.isFramesEnd = i == sbus::EndIndex;
    sent.value = sent.isFramesEnd ? end : sent.value;
    put(sent);
  }
  const uint64_t frameEndUs = sent.endUs;
  const uint64_t frameUs = frameEndUs - sbus::FrameSize * CharacterUs;
  const uint32_t intervalUs = _interval ? _interval() : periodUs(_mode);
  _shiftUs += int64_t{intervalUs} - int64_t{periodUs(_mode)};
  _madeUs = frameUs + intervalUs;
  _framesUs.push_back(frameUs);
  if (_framesUs.size() > MostFrames) {
    _framesUs.pop_front();
  }
  if (_mode != BusMode::NoTelemetry && (group == 0 || _mode == BusMode::OnlySlot0)) {
    sbus::ReceiverVoltage voltage = {};
    voltage.isExternal = _cycles / 4 % 2 != 0;
    voltage.decivolts = voltage.isExternal ? ExternalDecivolts : SupplyDecivolts;
    sbus::SlotData data;
    voltage.encode(&data);
    const uint8_t bytes[] = {sbus::slotId(0), data.data0, data.data1};
    send(frameEndUs + (_mode == BusMode::Slots ? FirstSlotUs : OnlySlot0Us), bytes, sizeof bytes);
  }
  for (const BusSensor &sensor : _sensors) {
    if (_mode == BusMode::Slots && sensor.slot / sbus::SlotsOfGroup == group) {
      const uint8_t bytes[] = {sbus::slotId(sensor.slot), sensor.data.data0, sensor.data.data1};
      const int64_t afterUs = int64_t{FirstSlotUs} + SlotPitchUs * (sensor.slot % sbus::SlotsOfGroup) + sensor.offUs;
      send(frameEndUs + static_cast<uint64_t>(afterUs), bytes, sizeof bytes);
    }
  }
  _cycles++;
}

void SimulatedBus::send(uint64_t startUs, const uint8_t *bytes, size_t size) {
  Sent sent;
  for (size_t i = 0; i < size; i++) {
    sent.endUs = startUs + (i + 1) * CharacterUs;
    sent.value = bytes[i];
    put(sent);
  }
}

// Adds a character. If it overlaps others, all of them get errors.
void SimulatedBus::put(const Sent &sent) {
  Sent added = sent;
  for (Sent &other : _wire) {
    if (other.endUs < sent.endUs + CharacterUs && sent.endUs < other.endUs + CharacterUs) {
      added.bad = other.bad = true;
    }
  }
  const auto place = std::upper_bound(_wire.begin(), _wire.end(), added,
                                      [](const Sent &one, const Sent &two) { return one.endUs < two.endUs; });
  _wire.insert(place, added);
}

// Returns the beginning of the frame that overlaps a character that ends at `endUs`.
uint64_t SimulatedBus::frameAt(uint64_t endUs) const {
  const auto met = std::find_if(_framesUs.begin(), _framesUs.end(), [&](uint64_t us) {
    return us < endUs && endUs - CharacterUs < us + sbus::FrameSize * CharacterUs;
  });
  return met == _framesUs.end() ? BusJudge::NoFrame : *met;
}

// The diode passes only HIGH: a TX that idles HIGH holds the wire.
void SimulatedBus::share(const LineSettings &tx) {
  _tx = tx;
  _isShared = true;
  _isHeld = tx.idleHigh();
  if (_isHeld) {
    _judge.held();
  }
}

// A character with another baud rate or format is noise.
void SimulatedBus::hear(const Character &character) {
  Sent sent;
  static_cast<Character &>(sent) = character;
  while (_madeUs < character.endUs) {
    makeCycle();
  }
  sent.bad = sent.bad || !mismatch(_tx, LineSettings()).empty();
  put(sent);
  const auto heard = std::find_if(_wire.begin(), _wire.end(), [&](const Sent &other) {
    return other.endUs == sent.endUs && other.value == sent.value;
  });
  _judge.heard(character, CharacterUs, heard->bad, frameAt(character.endUs));
}

std::string SimulatedBus::report() const { return _isShared ? "on the S.BUS2 wire: " + _judge.text() : ""; }

}  // namespace line
