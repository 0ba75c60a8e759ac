#include "Sensors.h"

namespace sbus {

namespace {

constexpr uint16_t Valid14 = 0x4000;  // of a word with 14 bits: it holds a value
constexpr uint16_t Valid15 = 0x8000;
constexpr int ZeroDegrees = 100;      // of an SBS-01T
constexpr int ZeroClimb = 1500;       // of an SBS-01G, 0.1 m/s
constexpr int32_t ZeroHeight = 8200;  // of an SBS-01G, 0.1 m
constexpr int32_t Degree = 600000;    // 60 minutes of 10000 parts
constexpr uint8_t South = 0x10;       // or west, in the byte with a GPS-F1675's highest bits

// Most sensors send the high byte first.
uint16_t wordOf(const SlotData &slot) {
  return static_cast<uint16_t>(slot.data0 << 8 | slot.data1);
}
uint16_t swappedWordOf(const SlotData &slot) {
  return static_cast<uint16_t>(slot.data1 << 8 | slot.data0);
}
SlotData slotOf(unsigned word) {
  return {static_cast<uint8_t>(word >> 8), static_cast<uint8_t>(word)};
}
SlotData swappedSlotOf(unsigned word) {
  return {static_cast<uint8_t>(word), static_cast<uint8_t>(word >> 8)};
}

// Valid14 is set in every negative value down to -16384 anyway, so the mark costs no value.
int16_t signed14(uint16_t word) {
  return static_cast<int16_t>((word & Valid15) != 0 ? word : word & (Valid14 - 1));
}
SlotData slotOf14(int value) {
  return slotOf((static_cast<unsigned>(value) & 0xFFFF) | Valid14);
}

int16_t signed16(const SlotData &slot) {
  return static_cast<int16_t>(wordOf(slot));
}

// Returns an angle of a GPS-F1675: degrees, sign and the four highest bits of the minutes, then their lower bits.
int32_t angleOf(const SlotData *slots) {
  const int32_t minutes = static_cast<int32_t>(slots[0].data1 & 0x0F) << 16 | wordOf(slots[1]);
  const int32_t angle = slots[0].data0 * Degree + minutes;
  return (slots[0].data1 & South) != 0 ? -angle : angle;
}
void writeAngle(int32_t angle, SlotData *slots) {
  const int32_t size = angle < 0 ? -angle : angle;
  const int32_t minutes = size % Degree;
  slots[0].data0 = static_cast<uint8_t>(size / Degree);
  slots[0].data1 = static_cast<uint8_t>((angle < 0 ? South : 0) | minutes >> 16);
  slots[1] = slotOf(static_cast<unsigned>(minutes & 0xFFFF));
}

// The fields of an SBS-01G: one run of 128 bits, the lowest first.
class BitReader {
 public:
  explicit BitReader(const SlotData *slots) : _slots(slots) {}

  int32_t next(uint8_t bits) {
    uint32_t value = 0;
    for (uint8_t i = 0; i < bits; i++, _at++) {
      const SlotData &slot = _slots[_at / 16];
      const uint8_t byte = (_at & 8) != 0 ? slot.data1 : slot.data0;
      value |= static_cast<uint32_t>(byte >> (_at & 7) & 1) << i;
    }
    return static_cast<int32_t>(value);
  }

  // The sign follows the size.
  int32_t nextSigned(uint8_t bits) {
    const int32_t size = next(bits);
    return next(1) != 0 ? -size : size;
  }

 private:
  const SlotData *const _slots;
  uint8_t _at = 0;
};

class BitWriter {
 public:
  explicit BitWriter(SlotData *slots) : _slots(slots) {
    for (uint8_t i = 0; i < GpsSbs01G::Slots; i++) {
      slots[i] = {0, 0};
    }
  }

  void put(int32_t value, uint8_t bits) {
    for (uint8_t i = 0; i < bits; i++, _at++) {
      SlotData &slot = _slots[_at / 16];
      uint8_t &byte = (_at & 8) != 0 ? slot.data1 : slot.data0;
      byte = static_cast<uint8_t>(byte | (value >> i & 1) << (_at & 7));
    }
  }

  void putSigned(int32_t value, uint8_t bits) {
    put(value < 0 ? -value : value, bits);
    put(value < 0, 1);
  }

 private:
  SlotData *const _slots;
  uint8_t _at = 0;
};

}  // namespace

// The upper three bits of data0 are 110, 111 or 000; why is not known.
void ReceiverVoltage::decode(const SlotData *slots) {
  decivolts = wordOf(slots[0]) & 0x3FF;
  isExternal = (slots[0].data0 & 0x04) != 0;
}
void ReceiverVoltage::encode(SlotData *slots) const {
  slots[0] = slotOf(0xC000u | (isExternal ? 0x0400u : 0u) | (decivolts & 0x3FFu));
}

void TemperatureSbs01T::decode(const SlotData *slots) {
  degrees = static_cast<int16_t>((swappedWordOf(slots[0]) & (Valid15 - 1)) - ZeroDegrees);
}
void TemperatureSbs01T::encode(SlotData *slots) const {
  slots[0] = swappedSlotOf(static_cast<unsigned>(degrees + ZeroDegrees) | Valid15);
}

void TemperatureF1713::decode(const SlotData *slots) {
  degrees = signed14(wordOf(slots[0]));
}
void TemperatureF1713::encode(SlotData *slots) const {
  slots[0] = slotOf14(degrees);
}

void RotationSbs01R::decode(const SlotData *slots) {
  rpm = 6ul * swappedWordOf(slots[0]);
}
void RotationSbs01R::encode(SlotData *slots) const {
  slots[0] = swappedSlotOf(static_cast<unsigned>(rpm / 6));
}

void VoltageSbs01V::decode(const SlotData *slots) {
  batteryDecivolts = wordOf(slots[0]) & 0x1FFF;
  externalDecivolts = wordOf(slots[1]) & 0x1FFF;
}
void VoltageSbs01V::encode(SlotData *slots) const {
  slots[0] = slotOf(Valid15 | (batteryDecivolts & 0x1FFFu));
  slots[1] = slotOf(externalDecivolts & 0x1FFFu);
}

void CurrentF1678::decode(const SlotData *slots) {
  centiamperes = signed14(wordOf(slots[0]));
  centivolts = wordOf(slots[1]);
  milliampereHours = wordOf(slots[2]);
}
void CurrentF1678::encode(SlotData *slots) const {
  slots[0] = slotOf14(centiamperes);
  slots[1] = slotOf(centivolts);
  slots[2] = slotOf(milliampereHours);
}

void VarioF1672::decode(const SlotData *slots) {
  centimetresPerSecond = signed16(slots[0]);
  metres = signed14(wordOf(slots[1]));
}
void VarioF1672::encode(SlotData *slots) const {
  slots[0] = slotOf(static_cast<unsigned>(centimetresPerSecond));
  slots[1] = slotOf14(metres);
}

void VarioF1712::decode(const SlotData *slots) {
  decimetresPerSecond = signed16(slots[0]);
  metres = signed14(wordOf(slots[1]));
}
void VarioF1712::encode(SlotData *slots) const {
  slots[0] = slotOf(static_cast<unsigned>(decimetresPerSecond));
  slots[1] = slotOf14(metres);
}

void AirSpeedSbs01Tas::decode(const SlotData *slots) {
  kilometresPerHour = wordOf(slots[0]) & (Valid14 - 1);
}
void AirSpeedSbs01Tas::encode(SlotData *slots) const {
  slots[0] = slotOf(kilometresPerHour | Valid14);
}

void GpsF1675::decode(const SlotData *slots) {
  kilometresPerHour = wordOf(slots[0]) & (Valid14 - 1);
  hasFix = (wordOf(slots[0]) & Valid14) != 0;
  metres = signed14(wordOf(slots[1]));
  secondsOfDay = wordOf(slots[2]);
  decimetresPerSecond = signed16(slots[3]);
  latitude = angleOf(slots + 4);
  longitude = angleOf(slots + 6);
}
void GpsF1675::encode(SlotData *slots) const {
  slots[0] = slotOf(kilometresPerHour | (hasFix ? Valid14 : 0u));
  slots[1] = slotOf14(metres);
  slots[2] = slotOf(secondsOfDay);
  slots[3] = slotOf(static_cast<unsigned>(decimetresPerSecond));
  writeAngle(latitude, slots + 4);
  writeAngle(longitude, slots + 6);
}

void GpsSbs01G::decode(const SlotData *slots) {
  BitReader bits(slots);
  secondsOfDay = static_cast<uint32_t>(bits.next(17));
  latitude = bits.nextSigned(26);
  longitude = bits.nextSigned(27);
  kilometresPerHour = static_cast<uint16_t>(bits.next(9));
  hasFix = bits.next(1) != 0;
  satellites = static_cast<uint8_t>(bits.next(2));
  bits.next(1);
  decipascals = static_cast<uint16_t>(bits.next(14));
  const int32_t height = bits.next(16) - ZeroHeight;
  decimetres = static_cast<int16_t>(height > INT16_MAX ? INT16_MAX : height);
  decimetresPerSecond = static_cast<int16_t>(bits.next(12) - ZeroClimb);
  hasPressure = bits.next(1) != 0;
}
void GpsSbs01G::encode(SlotData *slots) const {
  BitWriter bits(slots);
  bits.put(static_cast<int32_t>(secondsOfDay), 17);
  bits.putSigned(latitude, 26);
  bits.putSigned(longitude, 27);
  bits.put(kilometresPerHour, 9);
  bits.put(hasFix, 1);
  bits.put(satellites, 2);
  bits.put(0, 1);
  bits.put(decipascals, 14);
  bits.put(decimetres + ZeroHeight, 16);
  bits.put(decimetresPerSecond + ZeroClimb, 12);
  bits.put(hasPressure, 1);
}

}  // namespace sbus
