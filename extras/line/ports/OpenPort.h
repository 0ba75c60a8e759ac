// Opens a serial port of this PC.
#pragma once

#include <libserialport.h>

#include <memory>
#include <string>

#include "line/LineSettings.h"

namespace line {

using PortHandle = std::unique_ptr<sp_port, decltype(&sp_free_port)>;  // closes it, too

// 8 data bits. The polarity is the adapter's affair. Throws std::runtime_error, with a line that says what is wrong and
// what to do.
PortHandle openPort(const std::string &device, const LineSettings &settings, sp_mode mode);

// The system's file number of an open port.
int fileOf(const PortHandle &port);

}  // namespace line
