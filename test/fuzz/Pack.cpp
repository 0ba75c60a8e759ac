// pack() and unpack() are inverse, whatever values and bytes they get, and write no further than they should.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "support/BitByBit.h"
#include "sbus/Frame.h"

namespace {

void require(bool condition, const char *what) {
  if (!condition) {
    std::fprintf(stderr, "violated: %s\n", what);
    std::abort();
  }
}

}  // namespace

// The input: 18 values of 16 bits and a byte of flags, for pack(); and its first 25 bytes, as a frame, for unpack().
extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  uint8_t input[37] = {};
  if (size != 0) {
    std::memcpy(input, data, size < sizeof(input) ? size : sizeof(input));
  }
  Channels channels;
  std::memcpy(channels.data(), input, 36);
  const bool failsafe = (input[36] & 1) != 0;
  const bool lostFrame = (input[36] & 2) != 0;

  Channels limited;
  for (size_t i = 0; i < 18; i++) {
    const uint16_t highest = i < 16 ? 2047 : 1;
    limited[i] = channels[i] > highest ? highest : channels[i];
  }
  Frame expected = writeBitByBit(limited);
  expected[23] = static_cast<uint8_t>(expected[23] | (lostFrame ? 4 : 0) | (failsafe ? 8 : 0));
  Frame frame;  // the sanitizer guards its end
  sbus::pack(frame.data(), channels.data(), failsafe, lostFrame);
  require(frame == expected, "pack() writes what the bit-by-bit writing does");
  require(sbus::isFrame(frame.data()), "pack() writes a frame");
  require(sbus::failsafe(frame.data()) == failsafe && sbus::lostFrame(frame.data()) == lostFrame, "flags are kept");
  Channels again;
  sbus::unpack(frame.data(), again.data());
  require(again == limited, "unpack(pack(channels)) == channels within their limits");

  std::memcpy(frame.data(), input, 25);
  sbus::unpack(frame.data(), again.data());
  require(again == readBitByBit(frame), "unpack() reads what the bit-by-bit reading does");
  frame[0] = sbus::HeaderByte;
  frame[23] &= 0x0F;
  frame[24] = 0x00;
  Frame packed;
  sbus::pack(packed.data(), again.data(), sbus::failsafe(frame.data()), sbus::lostFrame(frame.data()));
  require(packed == frame, "pack(unpack(frame)) == frame");
  return 0;
}
