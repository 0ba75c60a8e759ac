#include "VcdWriter.h"

#include <algorithm>

namespace line {

namespace {

bool isOdd(unsigned bits) {
  bool odd = false;
  for (; bits != 0; bits >>= 1) {
    odd ^= (bits & 1) != 0;
  }
  return odd;
}

}  // namespace

VcdWriter::VcdWriter(const LineSettings &settings) : _settings(settings), _bitNs(settings.bitNs()) {}

std::string VcdWriter::begin() {
  return "$comment " + text(_settings) + " $end\n$timescale 1 us $end\n$scope module sbus $end\n$var wire 1 ! SBUS $end\n"
         "$upscope $end\n$enddefinitions $end\n#0\n" + level() ...;
}

}  // namespace line
