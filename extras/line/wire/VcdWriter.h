// The wire of a line as a value change dump, so that a logic analyser's software shows it.
#pragma once

#include <cstdint>
#include <string>

#include "../Line.h"
#include "../LineSettings.h"

namespace line {

// Characters go in, text comes out. A bad character is one with a wrong parity bit.
class VcdWriter {
 public:
  explicit VcdWriter(const LineSettings &settings);

  // What stands before the first character.
  std::string begin();

  // Characters in their order. One that begins before the last one ended is put right after it.
  std::string put(const Character &character);

  // The line stays idle for a character or two: some decoders want to see that.
  std::string finish();

 private:
  std::string bits(unsigned count, bool active);

  const LineSettings _settings;
  const uint64_t _bitNs;
  uint64_t _ns = 0;      // up to here the wire is written
  bool _active = false;  // it is so there
};

}  // namespace line
