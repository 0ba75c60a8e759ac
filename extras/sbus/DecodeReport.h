// What `sbus decode` prints: a table, CSV or JSON lines.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "line/Observer.h"
#include "line/wire/WireDecoder.h"

namespace tool {

// A stretch of the line, and its characters as they were on the wire.
struct WireStretch {
  const line::Stretch &stretch;
  const std::vector<line::WireCharacter> &characters;
  const line::Values &values;  // of a frame
};

struct DecodeTotals {
  unsigned long characters = 0;
  unsigned long parityErrors = 0;
  unsigned long framingErrors = 0;
  const line::Observer &observer;
};

class DecodeReport {
 public:
  virtual ~DecodeReport() = default;

  // The wire was found, before all else.
  virtual void wire(const line::WireDecoder &) {}
  virtual void stretch(const WireStretch &) {}
  virtual void character(const line::WireCharacter &) {}  // each, in their order; not together with stretch()
  virtual void end(const DecodeTotals &, const line::CaptureEnd &) {}
};

}  // namespace tool
