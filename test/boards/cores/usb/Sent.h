// What a board has told the PC over USB.
#pragma once

#include <cstdint>
#include <vector>

namespace sim {

using Bytes = std::vector<uint8_t>;

struct Usb {
  Bytes descriptor;            // of reports; empty: the core has one of its own
  std::vector<Bytes> reports;  // with their ID first
  int axes[6];                 // X, Y, Z, RX, RY, RZ of a core's own Joystick ...
  uint32_t buttons;            // ... and its buttons, as sent
  bool isAttached;             // the PC does not see later additions to the descriptor
};
extern Usb usb;

}  // namespace sim
