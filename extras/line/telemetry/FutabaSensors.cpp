#include "line/telemetry/FutabaSensors.h"

#include <algorithm>

#include "line/recording/Words.h"

namespace line {

namespace {

// Returns a fixed-point number as text: "12.34" for 1234 and 2 decimals.
std::string fixed(int64_t parts, unsigned decimals) {
  std::string digits = std::to_string(parts < 0 ? -parts : parts);
  if (digits.size() <= decimals) {
    digits.insert(0, decimals + 1 - digits.size(), '0');
  }
  if (decimals > 0) {
    digits.insert(digits.size() - decimals, ".");
  }
  return (parts < 0 ? "-" : "") + digits;
}

// Returns an angle in parts of 1/600000 degree as degrees with six decimals.
std::string degrees(int32_t angle) {
  const int64_t scaled = int64_t{angle} * 10;
  return fixed((scaled + (scaled < 0 ? -3 : 3)) / 6, 6);
}

template <typename Type>
Type decoded(const sbus::SlotData *data) {
  Type sensor;
  sensor.decode(data);
  return sensor;
}

using Quantities = std::vector<Quantity>;

Quantities receiver(const sbus::SlotData *data) {
  const auto sensor = decoded<sbus::ReceiverVoltage>(data);
  return {{0, sensor.isExternal ? "external voltage" : "receiver voltage", fixed(sensor.decivolts, 1), "V"}};
}

Quantities sbs01t(const sbus::SlotData *data) {
  return {{0, "temperature", fixed(decoded<sbus::TemperatureSbs01T>(data).degrees, 0), "degC"}};
}

Quantities f1713(const sbus::SlotData *data) {
  return {{0, "temperature", fixed(decoded<sbus::TemperatureF1713>(data).degrees, 0), "degC"}};
}

Quantities sbs01r(const sbus::SlotData *data) {
  return {{0, "rotation", fixed(decoded<sbus::RotationSbs01R>(data).rpm, 0), "1/min"}};
}

Quantities sbs01v(const sbus::SlotData *data) {
  const auto sensor = decoded<sbus::VoltageSbs01V>(data);
  return {{0, "battery voltage", fixed(sensor.batteryDecivolts, 1), "V"},
          {1, "external voltage", fixed(sensor.externalDecivolts, 1), "V"}};
}

Quantities f1678(const sbus::SlotData *data) {
  const auto sensor = decoded<sbus::CurrentF1678>(data);
  return {{0, "current", fixed(sensor.centiamperes, 2), "A"},
          {1, "voltage", fixed(sensor.centivolts, 2), "V"},
          {2, "charge", fixed(sensor.milliampereHours, 0), "mAh"}};
}

Quantities f1672(const sbus::SlotData *data) {
  const auto sensor = decoded<sbus::VarioF1672>(data);
  return {{0, "climb", fixed(sensor.centimetresPerSecond, 2), "m/s"}, {1, "altitude", fixed(sensor.metres, 0), "m"}};
}

Quantities f1712(const sbus::SlotData *data) {
  const auto sensor = decoded<sbus::VarioF1712>(data);
  return {{0, "climb", fixed(sensor.decimetresPerSecond, 1), "m/s"}, {1, "altitude", fixed(sensor.metres, 0), "m"}};
}

Quantities sbs01tas(const sbus::SlotData *data) {
  return {{0, "air speed", fixed(decoded<sbus::AirSpeedSbs01Tas>(data).kilometresPerHour, 0), "km/h"}};
}

// Without a fix, position and speed are meaningless.
Quantities f1675(const sbus::SlotData *data) {
  const auto sensor = decoded<sbus::GpsF1675>(data);
  Quantities all = {{1, "altitude", fixed(sensor.metres, 0), "m"},
                    {2, "UTC", fixed(sensor.secondsOfDay, 0), "s"},
                    {3, "climb", fixed(sensor.decimetresPerSecond, 1), "m/s"}};
  if (sensor.hasFix) {
    all.insert(all.begin(), {0, "speed", fixed(sensor.kilometresPerHour, 0), "km/h"});
    all.push_back({4, "latitude", degrees(sensor.latitude), "deg"});
    all.push_back({6, "longitude", degrees(sensor.longitude), "deg"});
  }
  return all;
}

Quantities sbs01g(const sbus::SlotData *data) {
  const auto sensor = decoded<sbus::GpsSbs01G>(data);
  Quantities all = {{0, "UTC", fixed(sensor.secondsOfDay, 0), "s"}};
  if (sensor.hasFix) {
    all.push_back({1, "latitude", degrees(sensor.latitude), "deg"});
    all.push_back({3, "longitude", degrees(sensor.longitude), "deg"});
    all.push_back({4, "speed", fixed(sensor.kilometresPerHour, 0), "km/h"});
  }
  if (sensor.hasPressure) {
    all.push_back({5, "pressure", fixed(sensor.decapascals, 1), "hPa"});
    all.push_back({6, "altitude", fixed(sensor.decimetres, 1), "m"});
    all.push_back({7, "climb", fixed(sensor.decimetresPerSecond, 1), "m/s"});
  }
  return all;
}

}  // namespace

const std::vector<Sensor> &sensors() {
  static const std::vector<Sensor> all = {
      {"receiver", sbus::ReceiverVoltage::Slots, receiver},
      {"SBS-01T", sbus::TemperatureSbs01T::Slots, sbs01t},
      {"F1713", sbus::TemperatureF1713::Slots, f1713},
      {"SBS-01R", sbus::RotationSbs01R::Slots, sbs01r},
      {"SBS-01V", sbus::VoltageSbs01V::Slots, sbs01v},
      {"F1678", sbus::CurrentF1678::Slots, f1678},
      {"SBS-01C", sbus::CurrentF1678::Slots, f1678},
      {"F1672", sbus::VarioF1672::Slots, f1672},
      {"F1712", sbus::VarioF1712::Slots, f1712},
      {"SBS-01TAS", sbus::AirSpeedSbs01Tas::Slots, sbs01tas},
      {"F1675", sbus::GpsF1675::Slots, f1675},
      {"SBS-01G", sbus::GpsSbs01G::Slots, sbs01g},
  };
  return all;
}

const Sensor *sensorOf(std::string_view name) {
  const auto found = std::find_if(sensors().begin(), sensors().end(),
                                  [&](const Sensor &sensor) { return lower(sensor.name) == lower(name); });
  return found == sensors().end() ? nullptr : &*found;
}

}  // namespace line
