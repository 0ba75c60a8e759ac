// A port's settings, made by the sketch.
#pragma once

#include <cstdint>

#include "line/LineSettings.h"

namespace host {

// The settings of its two pins.
struct PortSettings {
  line::LineSettings rx;
  line::LineSettings tx;

  bool operator==(const PortSettings &other) const { return rx == other.rx && tx == other.tx; }
};

// Converts the arguments of begin(): `config` has the bits of stm32l0_uart.h.
PortSettings portSettings(unsigned long baud, uint32_t config);

}  // namespace host
