#include "OtherProtocols.h"

namespace sbus {

namespace {

constexpr uint8_t IBusSize = 32;        // 20 40, 14 channels, a checksum: betaflight, src/main/rx/ibus.c
constexpr uint8_t SpektrumSize = 16;    // two bytes, seven words with a channel's number each: src/main/rx/spektrum.c
constexpr uint8_t SpektrumPackets = 4;  // none has a checksum
constexpr uint8_t CrsfMax = 64;         // an address, the size of the rest, type, data, a checksum: src/main/rx/crsf.c
constexpr uint8_t FPortMark = 0x7E;     // FrSky's F.Port: src/main/rx/fport.c
constexpr uint8_t FPortEscape = 0x7D;
constexpr uint8_t DbusSize = 18;  // DJI's DR16: four sticks, two switches, mouse and keys of RoboMaster

uint8_t crc8(uint8_t crc, uint8_t byte) {  // CRSF: D5
  crc = static_cast<uint8_t>(crc ^ byte);
  for (uint8_t bit = 0; bit < 8; bit++) {
    crc = static_cast<uint8_t>((crc & 0x80) != 0 ? crc << 1 ^ 0xD5 : crc << 1);
  }
  return crc;
}

uint16_t crc16(uint16_t crc, uint8_t byte) {  // SUMD: 1021
  crc = static_cast<uint16_t>(crc ^ byte << 8);
  for (uint8_t bit = 0; bit < 8; bit++) {
    crc = static_cast<uint16_t>((crc & 0x8000) != 0 ? crc << 1 ^ 0x1021 : crc << 1);
  }
  return crc;
}

}  // namespace

void OtherProtocols::put(uint8_t byte) {
  _bytes[_next] = byte;
  _next = static_cast<uint8_t>(_next + 1 < Size ? _next + 1 : 0);
  _count++;
  note(0, Finding::IBus, endOfIBus());
  noteChecked();
  note(3, Finding::FPort, endOfFPort());
  note(4, Finding::Dbus, endOfDbus());
  if (isSpektrum()) {
    _found = Finding::Spektrum;
  }
}

// Notes that a packet of `size` bytes ends here; 0: none does.
void OtherProtocols::note(uint8_t kind, Finding finding, uint8_t size) {
  Chain &chain = _chains[kind];
  if (size == 0) {
    return;
  }
  const bool follows = static_cast<uint16_t>(chain.end + size) == _count;
  chain.count = static_cast<uint8_t>(follows ? chain.count + (chain.count < PacketsMin) : 1);
  chain.end = _count;
  if (chain.count >= PacketsMin) {
    _found = finding;
  }
}

// Each of these returns the size of the packet that ends with the newest byte; 0 without one.
uint8_t OtherProtocols::endOfIBus() const {
  if (at(IBusSize - 1) != 0x20 || at(IBusSize - 2) != 0x40) {
    return 0;
  }
  uint16_t sum = 0xFFFF;
  for (uint8_t back = IBusSize - 1; back > 1; back--) {
    sum = static_cast<uint16_t>(sum - at(back));
  }
  return at(1) == (sum & 0xFF) && at(0) == sum >> 8 ? IBusSize : 0;
}

// Notes packets of CRSF and SUMD, which tell their size: looks for a beginning that fits this end, one byte after the
// other.
void OtherProtocols::noteChecked() {
  uint8_t place = _next, second = 0, third = 0;  // the bytes after the one at `place`
  for (uint8_t size = 1; size < Size; size++) {
    place = static_cast<uint8_t>(place == 0 ? Size - 1 : place - 1);
    const uint8_t first = _bytes[place];
    if (second == size - 2 && second >= 2 && (first == 0xC8 || first == 0xEE || first == 0xEA) && endsCrsf(size)) {
      note(1, Finding::Crsf, size);
    } else if (first == 0xA8 && (second == 0x01 || second == 0x81) && third >= 2 && 2 * third + 5 == size &&
               endsSumd(size)) {
      note(2, Finding::Sumd, size);
    }
    third = second;
    second = first;
  }
}

bool OtherProtocols::endsCrsf(uint8_t size) const {
  uint8_t crc = 0;
  for (uint8_t back = static_cast<uint8_t>(size - 3); back > 0; back--) {
    crc = crc8(crc, at(back));
  }
  return size <= CrsfMax && crc == at(0);
}

bool OtherProtocols::endsSumd(uint8_t size) const {
  uint16_t crc = 0;
  for (uint8_t back = static_cast<uint8_t>(size - 1); back > 1; back--) {
    crc = crc16(crc, at(back));
  }
  return at(1) == crc >> 8 && at(0) == (crc & 0xFF);
}

// 7E, the size of what follows without the checksum, type 00 (sticks) or 01 (telemetry), data, a checksum, 7E. 7D comes
// before an escaped byte.
uint8_t OtherProtocols::endOfFPort() const {
  if (at(0) != FPortMark) {
    return 0;
  }
  uint8_t begin = 1;  // of the packet, counted back
  while (begin < Size - 1 && at(begin) != FPortMark) {
    begin++;
  }
  if (at(begin) != FPortMark || begin < 4) {
    return 0;
  }
  uint16_t sum = 0;
  uint8_t count = 0;
  bool isEscaped = false;
  for (uint8_t back = static_cast<uint8_t>(begin - 1); back > 0; back--) {
    if (at(back) == FPortEscape) {
      isEscaped = true;
      continue;
    }
    sum = static_cast<uint16_t>(sum + (isEscaped ? at(back) ^ 0x20 : at(back)));
    isEscaped = false;
    count++;
  }
  while (sum > 0xFF) {
    sum = static_cast<uint16_t>((sum & 0xFF) + (sum >> 8));
  }
  const uint8_t size = at(static_cast<uint8_t>(begin - 1));
  const uint8_t type = at(static_cast<uint8_t>(begin - 2));
  const bool isKnown = (size == 0x19 && type == 0) || (size == 0x08 && type == 1);
  return isKnown && sum == 0xFF && count == size + 2 ? static_cast<uint8_t>(begin + 1) : 0;
}

// Four sticks of 11 bits, two switches of 2 bits, the mouse's three ways (16 bits each) and two buttons, keys, and a
// wheel. It has no checksum: of random packets one in 200000 looks like this.
uint8_t OtherProtocols::endOfDbus() const {
  constexpr uint16_t Low = 364, High = 1684;
  const uint8_t first = DbusSize - 1;
  for (uint8_t stick = 0; stick < 4; stick++) {
    const uint8_t bit = static_cast<uint8_t>(11 * stick), back = static_cast<uint8_t>(first - bit / 8);
    const uint32_t bits = at(back) | static_cast<uint32_t>(at(static_cast<uint8_t>(back - 1))) << 8 |
                          static_cast<uint32_t>(at(static_cast<uint8_t>(back - 2))) << 16;
    const uint16_t value = bits >> bit % 8 & 0x7FF;
    if (value < Low || value > High) {
      return 0;
    }
  }
  const uint8_t switches = at(first - 5);
  const bool areSwitches = (switches & 0x30) != 0 && (switches & 0xC0) != 0;
  return areSwitches && at(first - 12) <= 1 && at(first - 13) <= 1 ? DbusSize : 0;
}

// Returns a bit for each channel of the packet that begins `first` bytes back; 0 if one comes twice.
uint16_t OtherProtocols::identifiers(uint8_t first) const {
  const uint8_t system = at(static_cast<uint8_t>(first - 1));
  const uint8_t shift = system == 0x01 ? 2 : 3;  // 1024 steps, or 2048
  uint16_t seen = 0;
  for (uint8_t word = 1; word <= 7; word++) {
    const uint8_t high = at(static_cast<uint8_t>(first - 2 * word));
    const uint16_t bit = static_cast<uint16_t>(1 << (high >> shift & 0x0F));
    if (high != 0xFF && ((seen & bit) != 0 || bit >= 1 << 12)) {
      return 0;
    }
    seen = static_cast<uint16_t>(high == 0xFF ? seen : seen | bit);
  }
  return seen;
}

// Four packets of one kind. Two that follow each other may have different channels.
bool OtherProtocols::isSpektrum() const {
  constexpr uint8_t All = SpektrumSize * SpektrumPackets;
  const uint8_t system = at(All - 2);
  if (_count < All || (system != 0x01 && system != 0x12 && system != 0xA2 && system != 0xB2)) {
    return false;
  }
  uint16_t before[2] = {};
  for (uint8_t packet = 0; packet < SpektrumPackets; packet++) {
    const uint8_t first = static_cast<uint8_t>(All - 1 - SpektrumSize * packet);
    const uint16_t seen = identifiers(first);
    if (seen == 0 || at(static_cast<uint8_t>(first - 1)) != system || (packet > 1 && seen != before[packet % 2])) {
      return false;
    }
    before[packet % 2] = seen;
  }
  return true;
}

}  // namespace sbus
