#include "Sensors.h"

namespace sbus {

namespace {

constexpr uint16_t Valid14 = 0x4000;  // of a word with 14 bits: it holds a value
constexpr uint16_t Valid15 = 0x8000;
constexpr int ZeroDegrees = 100;      // of an SBS-01T
constexpr int ZeroClimb = 1500;       // of an SBS-01G, 0.1 m/s
constexpr int32_t ZeroHeight = 8200;  // of an SBS-01G, 0.1 m
constexpr int32_t Degree = 600000;    // 60 minutes of 10000 parts
constexpr int32_t Pole = 90 * Degree;
constexpr int32_t DateLine = 180 * Degree;
constexpr uint8_t South = 0x10;  // or west, in the byte with a GPS-F1675's highest bits

// These three return `value`, or the nearest one within the range.
__attribute__((noinline)) int32_t within(int32_t lowest, int32_t highest, int32_t value) {
  return value < lowest ? lowest : value > highest ? highest : value;
}
unsigned atMost(unsigned highest, unsigned value) { return value > highest ? highest : value; }
int within14(int value) {
  constexpr int Max = Valid14 - 1, Min = -Max - 1;
  return value < Min ? Min : value > Max ? Max : value;
}

bool isPosition(int32_t latitude, int32_t longitude) {
  return latitude >= -Pole && latitude <= Pole && longitude >= -DateLine && longitude <= DateLine;
}

// Most sensors send the high byte first.
uint16_t wordOf(const SlotData &slot) { return static_cast<uint16_t>(slot.data0 << 8 | slot.data1); }
uint16_t swappedWordOf(const SlotData &slot) { return static_cast<uint16_t>(slot.data1 << 8 | slot.data0); }
SlotData slotOf(unsigned word) { return {static_cast<uint8_t>(word >> 8), static_cast<uint8_t>(word)}; }
SlotData swappedSlotOf(unsigned word) { return {static_cast<uint8_t>(word), static_cast<uint8_t>(word >> 8)}; }

// Valid14 is set in every negative value down to -16384 anyway, so the mark costs no value.
int16_t signed14(uint16_t word) { return static_cast<int16_t>((word & Valid15) != 0 ? word : word & (Valid14 - 1)); }
SlotData slotOf14(int value) { return slotOf((static_cast<unsigned>(value) & 0xFFFF) | Valid14); }

int16_t signed16(const SlotData &slot) { return static_cast<int16_t>(wordOf(slot)); }

// Returns an angle of a GPS-F1675: degrees, sign and the four highest bits of the minutes, then their lower bits.
// Clears `isFix` if they are 60 minutes or more.
int32_t angleOf(const SlotData *slots, bool &isFix) {
  const int32_t minutes = static_cast<int32_t>(slots[0].data1 & 0x0F) << 16 | wordOf(slots[1]);
  isFix = isFix && minutes < Degree;
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

  // Writes `value`, or the nearest one that these bits can hold if 0 stands for -`zero`.
  void put(int32_t value, uint8_t bits, int32_t zero = 0) {
    const int32_t sent = limited(-zero, (int32_t{1} << bits) - 1 - zero, value) + zero;
    for (uint8_t i = 0; i < bits; i++, _at++) {
      SlotData &slot = _slots[_at / 16];
      uint8_t &byte = (_at & 8) != 0 ? slot.data1 : slot.data0;
      byte = static_cast<uint8_t>(byte | (sent >> i & 1) << (_at & 7));
    }
  }

  void putSigned(int32_t value, int32_t highest, uint8_t bits) {
    const int32_t sent = limited(-highest, highest, value);
    put(sent < 0 ? -sent : sent, bits);
    put(sent < 0, 1);
  }

  bool fits() const { return _fits; }

 private:
  int32_t limited(int32_t lowest, int32_t highest, int32_t value) {
    const int32_t nearest = within(lowest, highest, value);
    _fits = _fits && nearest == value;
    return nearest;
  }

  SlotData *const _slots;
  uint8_t _at = 0;
  bool _fits = true;
};

}  // namespace

// The upper three bits of data0 are 110, 111 or 000; why is not known.
void ReceiverVoltage::decode(const SlotData *slots) {
  decivolts = wordOf(slots[0]) & 0x3FF;
  isExternal = (slots[0].data0 & 0x04) != 0;
}
bool ReceiverVoltage::encode(SlotData *slots) const {
  const unsigned sent = atMost(0x3FF, decivolts);
  slots[0] = slotOf(0xC000u | (isExternal ? 0x0400u : 0u) | sent);
  return sent == decivolts;
}

void TemperatureSbs01T::decode(const SlotData *slots) {
  degrees = static_cast<int16_t>((swappedWordOf(slots[0]) & (Valid15 - 1)) - ZeroDegrees);
}
bool TemperatureSbs01T::encode(SlotData *slots) const {
  const int32_t sent = within(-ZeroDegrees, INT16_MAX - ZeroDegrees, degrees);
  slots[0] = swappedSlotOf(static_cast<unsigned>(sent + ZeroDegrees) | Valid15);
  return sent == degrees;
}

void TemperatureF1713::decode(const SlotData *slots) { degrees = signed14(wordOf(slots[0])); }
bool TemperatureF1713::encode(SlotData *slots) const {
  const int sent = within14(degrees);
  slots[0] = slotOf14(sent);
  return sent == degrees;
}

void RotationSbs01R::decode(const SlotData *slots) { rpm = 6ul * swappedWordOf(slots[0]); }
bool RotationSbs01R::encode(SlotData *slots) const {
  const uint32_t value = rpm / 6;
  const bool fits = value <= UINT16_MAX;
  slots[0] = swappedSlotOf(fits ? static_cast<unsigned>(value) : UINT16_MAX);
  return fits;
}

void VoltageSbs01V::decode(const SlotData *slots) {
  batteryDecivolts = wordOf(slots[0]) & 0x1FFF;
  externalDecivolts = wordOf(slots[1]) & 0x1FFF;
}
bool VoltageSbs01V::encode(SlotData *slots) const {
  const unsigned battery = atMost(0x1FFF, batteryDecivolts);
  const unsigned external = atMost(0x1FFF, externalDecivolts);
  slots[0] = slotOf(Valid15 | battery);
  slots[1] = slotOf(external);
  return battery == batteryDecivolts && external == externalDecivolts;
}

void CurrentF1678::decode(const SlotData *slots) {
  centiamperes = signed14(wordOf(slots[0]));
  centivolts = wordOf(slots[1]);
  milliampereHours = wordOf(slots[2]);
}
bool CurrentF1678::encode(SlotData *slots) const {
  const int current = within14(centiamperes);
  slots[0] = slotOf14(current);
  slots[1] = slotOf(centivolts);
  slots[2] = slotOf(milliampereHours);
  return current == centiamperes;
}

void VarioF1672::decode(const SlotData *slots) {
  centimetresPerSecond = signed16(slots[0]);
  metres = signed14(wordOf(slots[1]));
}
bool VarioF1672::encode(SlotData *slots) const {
  const int altitude = within14(metres);
  slots[0] = slotOf(static_cast<unsigned>(centimetresPerSecond));
  slots[1] = slotOf14(altitude);
  return altitude == metres;
}

void VarioF1712::decode(const SlotData *slots) {
  decimetresPerSecond = signed16(slots[0]);
  metres = signed14(wordOf(slots[1]));
}
bool VarioF1712::encode(SlotData *slots) const {
  const int altitude = within14(metres);
  slots[0] = slotOf(static_cast<unsigned>(decimetresPerSecond));
  slots[1] = slotOf14(altitude);
  return altitude == metres;
}

void AirSpeedSbs01Tas::decode(const SlotData *slots) { kilometresPerHour = wordOf(slots[0]) & (Valid14 - 1); }
bool AirSpeedSbs01Tas::encode(SlotData *slots) const {
  const unsigned sent = atMost(Valid14 - 1, kilometresPerHour);
  slots[0] = slotOf(sent | Valid14);
  return sent == kilometresPerHour;
}

void GpsF1675::decode(const SlotData *slots) {
  kilometresPerHour = wordOf(slots[0]) & (Valid14 - 1);
  hasFix = (wordOf(slots[0]) & Valid14) != 0;
  metres = signed14(wordOf(slots[1]));
  secondsOfDay = wordOf(slots[2]);
  decimetresPerSecond = signed16(slots[3]);
  latitude = angleOf(slots + 4, hasFix);
  longitude = angleOf(slots + 6, hasFix);
  hasFix = hasFix && isPosition(latitude, longitude);
}
bool GpsF1675::encode(SlotData *slots) const {
  const unsigned speed = atMost(Valid14 - 1, kilometresPerHour);
  const int altitude = within14(metres);
  const int32_t north = within(-Pole, Pole, latitude);
  const int32_t east = within(-DateLine, DateLine, longitude);
  slots[0] = slotOf(speed | (hasFix ? Valid14 : 0u));
  slots[1] = slotOf14(altitude);
  slots[2] = slotOf(secondsOfDay);
  slots[3] = slotOf(static_cast<unsigned>(decimetresPerSecond));
  writeAngle(north, slots + 4);
  writeAngle(east, slots + 6);
  return speed == kilometresPerHour && altitude == metres && north == latitude && east == longitude;
}

void GpsSbs01G::decode(const SlotData *slots) {
  BitReader bits(slots);
  secondsOfDay = static_cast<uint32_t>(bits.next(17));
  latitude = bits.nextSigned(26);
  longitude = bits.nextSigned(27);
  kilometresPerHour = static_cast<uint16_t>(bits.next(9));
  hasFix = bits.next(1) != 0 && isPosition(latitude, longitude);
  satellites = static_cast<uint8_t>(bits.next(2));
  bits.next(1);
  decapascals = static_cast<uint16_t>(bits.next(14));
  decimetres = bits.next(16) - ZeroHeight;
  decimetresPerSecond = static_cast<int16_t>(bits.next(12) - ZeroClimb);
  hasPressure = bits.next(1) != 0;
}
bool GpsSbs01G::encode(SlotData *slots) const {
  BitWriter bits(slots);
  bits.put(static_cast<int32_t>(secondsOfDay < INT32_MAX ? secondsOfDay : INT32_MAX), 17);
  bits.putSigned(latitude, Pole, 26);
  bits.putSigned(longitude, DateLine, 27);
  bits.put(kilometresPerHour, 9);
  bits.put(hasFix, 1);
  bits.put(satellites, 2);
  bits.put(0, 1);
  bits.put(decapascals, 14);
  bits.put(decimetres, 16, ZeroHeight);
  bits.put(decimetresPerSecond, 12, ZeroClimb);
  bits.put(hasPressure, 1);
  return bits.fits();
}

}  // namespace sbus
