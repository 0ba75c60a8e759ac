/// @file
/// The S.Bus frame: what its bytes mean, and nothing about how they are found.
///
/// Sources: J. Lemaire, "Decoding the S-Bus protocol with a Grasshopper", chapter 2, for the layout; captures of real
/// receivers for the end bytes other than 0x00; github.com/nseinlet/Modelisme, src/FrSky_SBus.cpp, for FrSky's 24
/// channels; github.com/iNavFlight/inav, pull request 10270, for Futaba's frames with header 2F.
///
/// Plain C++11: no Arduino, no heap, no library calls. Every function may be called from any context.
#pragma once

#include <stdint.h>

/// The core: the frame, finding frames in a stream of bytes, judging the link, scaling, calibration. It knows no
/// Arduino.
namespace sbus {

// The line: 8 data bits, even parity, 2 stop bits, inverted (idle LOW).
constexpr unsigned long Baud = 100000;    ///< bits a second; 200000 on Fast S.Bus
constexpr uint8_t BitsPerCharacter = 12;  ///< start, 8 data, parity, 2 stop
constexpr uint8_t CharacterTime = 120;    ///< us, at 100000 baud

// The frame: header, 16 channels of 11 bits, flags, end byte.
constexpr uint8_t FrameSize = 25;      ///< bytes
constexpr uint8_t HeaderByte = 0x0F;   ///< the first; the payload may hold it, too
constexpr uint8_t ExtraHeader = 0x2F;  ///< of a frame with CH17..CH32: Futaba FASSTest 26 sends one before each frame
constexpr uint8_t PayloadIndex = 1;    ///< of the first of 22 bytes
constexpr uint8_t FlagsIndex = 23;     ///< of the flags byte
constexpr uint8_t EndIndex = 24;       ///< of the end byte

// The same with FrSky's 24 channels (ACCESS and TD receivers): CH17 and CH18 are no switches then.
constexpr uint8_t FrameSize24 = 36;     ///< bytes, the payload 33 of them
constexpr uint8_t ChannelCount24 = 24;  ///< CH1..CH24, 0..2047

// The channels: 16 proportional ones, then two switches.
constexpr uint8_t ProportionalCount = 16;  ///< CH1..CH16, 0..2047
constexpr uint8_t ChannelCount = 18;       ///< and CH17, CH18, 0 or 1
constexpr uint16_t ChannelMax = 2047;      ///< 11 bits

// The bits of the flags byte.
constexpr uint8_t FlagChannel17 = 0x01;  ///< the switch CH17 is on
constexpr uint8_t FlagChannel18 = 0x02;  ///< the switch CH18 is on
constexpr uint8_t FlagLostFrame = 0x04;  ///< see lostFrame()
constexpr uint8_t FlagFailsafe = 0x08;   ///< see failsafe()
constexpr uint8_t FlagsUnused = 0xF0;    ///< 0 on every receiver known

/// What is known of a variant of line. The end byte of its frames tells the variant.
struct LineVariant {
  uint8_t end;         ///< the end byte, as far as endMask goes
  uint8_t endMask;     ///< the bits of the end byte that count; the others name telemetry slots
  uint8_t tailSize;    ///< characters that belong to a frame, straight after it
  uint8_t headerMask;  ///< 0xDF: frames with header 2F may come between, with further channels; else 0xFF
};

/// One row a variant, known from captures of real receivers. A new receiver is a new row, and its capture.
constexpr LineVariant LineVariants[] = {
    {0x00, 0xFF, 0, 0xDF},  // Futaba S.BUS, FrSky; 2F in FASSTest 26
    {0x04, 0xCF, 0, 0xDF},  // S.BUS2: 04, 14, 24, 34 in turn; sensors may answer 04, some 2 ms after it
    {0x08, 0xFF, 5, 0xFF},  // Futaba R7003SB, FASSTest 12CH
};
constexpr uint8_t SlotsVariant = 1;  ///< the row with telemetry slots
constexpr uint8_t UnknownVariant = sizeof LineVariants / sizeof LineVariants[0];  ///< no row
constexpr uint8_t LongestTail = 5;                                       ///< characters

/// True if frames of this variant, a row of LineVariants, end with this byte.
constexpr bool endsVariant(uint8_t end, uint8_t variant) {
  return (end & LineVariants[variant].endMask) == LineVariants[variant].end;
}

/// The variant whose frames end with this byte; UnknownVariant if no frame does. (A template, so that no loop goes through
/// the rows: a line of headers costs half as much.)
template <uint8_t Row = 0>
constexpr uint8_t variantOfEnd(uint8_t end) {
  return endsVariant(end, Row) ? Row : variantOfEnd<Row + 1>(end);
}

/// After the last row: no frame ends with that byte.
template <>
constexpr uint8_t variantOfEnd<UnknownVariant>(uint8_t) {
  return UnknownVariant;
}

/// True if a frame may end with this byte: 00, 04, 14, 24, 34 or 08.
constexpr bool isEndByte(uint8_t byte) {
  return variantOfEnd(byte) != UnknownVariant;
}

/// True if `byte` may be the ID of a telemetry slot, which three characters of a sensor begin with. Its next two bits are
/// the group, the end byte's of the frame before; home-made sensors are known that send another group's.
constexpr bool isSlotId(uint8_t byte) {
  return (byte & 0x07) == 0x03;
}

/// True if the unused bits of this flags byte are 0, as they are on every receiver known.
constexpr bool isFlagsByte(uint8_t byte) {
  return (byte & FlagsUnused) == 0;
}

/// True if `frame`, 25 bytes, begins and ends as a frame does. There is no checksum: the payload cannot be checked.
constexpr bool isFrame(const uint8_t *frame) {
  return frame[0] == HeaderByte && isFlagsByte(frame[FlagsIndex]) && isEndByte(frame[EndIndex]);
}

/// True if this radio frame did not arrive, and the channels of `frame` (25 bytes) are old ones. It comes and goes in
/// flight.
constexpr bool lostFrame(const uint8_t *frame) {
  return (frame[FlagsIndex] & FlagLostFrame) != 0;
}

/// True if the receiver has given the link up, and the channels of `frame` (25 bytes) are its failsafe setting.
constexpr bool failsafe(const uint8_t *frame) {
  return (frame[FlagsIndex] & FlagFailsafe) != 0;
}

/// Returns the index of the first header within `frame` (`size` bytes) that follows an end byte of this variant, of any for
/// UnknownVariant, as it would between two frames; `size` if there is none.
int innerHeader(const uint8_t *frame, int size, uint8_t variant);

/// Writes all channels of `frame` (25 bytes; header and end byte are ignored) to `channels`: 18 values, CH1..CH16
/// as 0..2047, CH17 and CH18 as 0 or 1.
void unpack(const uint8_t *frame, uint16_t *channels);

/// unpack() for a frame whose payload, byte 1, stands at a multiple of four, on a little-endian machine: 85
/// instructions instead of 160 on a Cortex-M0+, and 18 bytes less (`make bench`).
void unpackAligned(const uint8_t *frame, uint16_t *channels);

/// Writes the 16 channels of a frame with header 2F to `channels`: CH17..CH32, 0..2047.
void unpackExtra(const uint8_t *frame, uint16_t *channels);

/// Writes a whole frame, 25 bytes with end byte 00, of 18 `channels`: the exact inverse of unpack(). CH1..CH16 are
/// clamped to 2047, CH17 and CH18 other than 0 are 1.
void pack(uint8_t *frame, const uint16_t *channels, bool failsafe, bool lostFrame);

/// Writes the 24 channels of a 36-byte `frame` to `channels`: CH1..CH24, 0..2047.
void unpack24(const uint8_t *frame, uint16_t *channels);

/// Writes such a frame, of 24 `channels`, clamped to 2047: the exact inverse of unpack24().
void pack24(uint8_t *frame, const uint16_t *channels, bool failsafe, bool lostFrame);

/// What differs between a frame of 16 channels and one of 24, for what is written once for both.
struct Frame16 {
  static constexpr uint8_t Size = FrameSize;         ///< bytes, the flags and the end byte last
  static constexpr uint8_t Channels = ChannelCount;  ///< that unpack() writes
  static constexpr uint8_t Kinds = UnknownVariant;      ///< rows of LineVariants that such lines have
  static constexpr uint8_t OtherSize = FrameSize24;  ///< bytes of the other
  static constexpr bool HasExtra = true;             ///< frames with header 2F may come between
  static constexpr unsigned LongestSpread = 22;      ///< characters: 16 of a frame that is spread over 4 ms, and a gap
  /// The characters' time that so many of them take: some receivers spread a frame over 4 ms, a third longer.
  static constexpr unsigned spread(unsigned count) { return count + count / 4 + 1; }
  /// As its unpack functions.
  static void unpack(const uint8_t *frame, uint16_t *channels) { unpackAligned(frame, channels); }
  /// As its pack functions.
  static void pack(uint8_t *frame, const uint16_t *channels, bool failsafe, bool lostFrame) {
    sbus::pack(frame, channels, failsafe, lostFrame);
  }
};

/// The same for 24.
struct Frame24 {
  static constexpr uint8_t Size = FrameSize24;         ///< bytes
  static constexpr uint8_t Channels = ChannelCount24;  ///< that unpack() writes
  static constexpr uint8_t Kinds = 1;                  ///< end byte 00 only
  static constexpr uint8_t OtherSize = FrameSize;      ///< bytes of the other
  static constexpr bool HasExtra = false;              ///< nothing comes between
  static constexpr unsigned LongestSpread = 19;        ///< characters: 16, an idle one, and a gap
  /// No receiver spreads these frames.
  static constexpr unsigned spread(unsigned count) { return count; }
  /// As its unpack functions.
  static void unpack(const uint8_t *frame, uint16_t *channels) { unpack24(frame, channels); }
  /// As its pack functions.
  static void pack(uint8_t *frame, const uint16_t *channels, bool failsafe, bool lostFrame) {
    pack24(frame, channels, failsafe, lostFrame);
  }
};

/// True if a frame of that format may begin with this byte.
template <typename Format>
constexpr bool isHeaderByte(uint8_t byte) {
  return byte == HeaderByte || (Format::HasExtra && byte == ExtraHeader);
}

}  // namespace sbus
