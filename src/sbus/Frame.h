/// @file
/// The S.Bus frame: what its bytes mean. FrameFinder.h finds it on a line.
///
/// Sources: J. Lemaire, "Decoding the S-Bus protocol with a Grasshopper", chapter 2, for the layout; captures of real
/// receivers for the end bytes other than 0x00; github.com/nseinlet/Modelisme, src/FrSky_SBus.cpp, for FrSky's 24
/// channels; github.com/iNavFlight/inav, pull request 10270, for Futaba's frames with header 2F.
///
/// All functions may be called from any context.
#pragma once

#include <limits.h>
#include <stddef.h>
#include <stdint.h>

struct SBusFrame;
struct SBusFrame24;

/// The core: decodes frames, finds them in a stream of bytes, judges the link, scales and calibrates channels. It does
/// not use Arduino.
namespace sbus {

// The line: 8 data bits, even parity, 2 stop bits, inverted (idle LOW).
constexpr unsigned long Baud = 100000;    ///< bits a second; 200000 on Fast S.Bus
constexpr uint8_t BitsPerCharacter = 12;  ///< start, 8 data, parity, 2 stop
constexpr uint8_t CharacterTime = 120;    ///< us, at 100000 baud

// The frame: header, 16 channels of 11 bits, flags, end byte.
constexpr uint8_t FrameSize = 25;     ///< bytes
constexpr uint8_t HeaderByte = 0x0F;  ///< the first byte; it may also occur in the payload
/// Header of a frame with the extra channels CH17..CH32, which Futaba's FASSTest 26 sends before each frame.
constexpr uint8_t ExtraHeader = 0x2F;
constexpr uint8_t HeaderMask = 0xDF;  ///< mask: of both headers, 0F and 2F, it leaves HeaderByte
constexpr uint8_t PayloadIndex = 1;   ///< index of the first of 22 bytes
constexpr uint8_t FlagsIndex = 23;    ///< index of the flags byte
constexpr uint8_t EndIndex = 24;      ///< index of the end byte

// The frame with FrSky's 24 channels (ACCESS and TD receivers): its CH17 and CH18 are not switches.
constexpr uint8_t FrameSize24 = 36;     ///< bytes, the payload 33 of them
constexpr uint8_t ChannelCount24 = 24;  ///< CH1..CH24, 0..2047

// The channels: 16 proportional ones, then two switches.
constexpr uint8_t ProportionalCount = 16;  ///< CH1..CH16, 0..2047
constexpr uint8_t ChannelCount = 18;       ///< and CH17, CH18, 0 or 1
constexpr uint16_t ChannelMax = 2047;      ///< 11 bits

// The bits of the flags byte.
constexpr uint8_t FlagChannel17 = 0x01;  ///< the switch CH17 is on
constexpr uint8_t FlagChannel18 = 0x02;  ///< the switch CH18 is on
constexpr uint8_t FlagLostFrame = 0x04;  ///< this radio frame did not arrive, and the channels repeat old values
constexpr uint8_t FlagFailsafe = 0x08;   ///< the receiver has lost the link; the channels are its failsafe setting
constexpr uint8_t FlagsUnused = 0xF0;    ///< 0 on every receiver known

/// A line variant. Its end byte identifies it.
struct LineVariant {
  uint8_t end;         ///< the end byte's bits within endMask
  uint8_t endMask;     ///< the bits of the end byte that identify the variant; the others name the telemetry group
  uint8_t tailSize;    ///< characters that follow each frame directly
  uint8_t headerMask;  ///< HeaderMask: frames with extra channels (header 2F) may come in between; otherwise 0xFF
};

/// The variants known from captures of real receivers. A new variant is a new row with its capture.
constexpr LineVariant LineVariants[] = {
    {0x00, 0xFF, 0, HeaderMask},  // Futaba S.BUS, FrSky; 2F in FASSTest 26
    {0x04, 0xCF, 0, HeaderMask},  // S.BUS2: 04, 14, 24, 34 in turn; sensors may answer 04, some 2 ms after it
    {0x08, 0xFF, 5, 0xFF},        // Futaba R7003SB, FASSTest 12CH
};
constexpr uint8_t VariantCount = sizeof LineVariants / sizeof LineVariants[0];  ///< rows
constexpr uint8_t SlotsVariant = 1;                                             ///< the row with telemetry slots
constexpr uint8_t TailVariant = 2;                                              ///< the row with slot 0 only
constexpr uint8_t NoVariant = UINT8_MAX;                                        ///< no row
constexpr uint8_t TailMax = 5;                                                  ///< characters

/// Returns true if frames of this variant, a row of LineVariants, end with this byte.
constexpr bool endsVariant(uint8_t end, uint8_t variant) {
  return (end & LineVariants[variant].endMask) == LineVariants[variant].end;
}

/// Returns the variant that ends its frames with this byte, or NoVariant. (A template instead of a loop halves the
/// cost of a line of headers.)
template <uint8_t Row = 0>
constexpr uint8_t variantOfEnd(uint8_t end) {
  return endsVariant(end, Row) ? Row : variantOfEnd<Row + 1>(end);
}

/// Ends the recursion after the last row.
template <>
constexpr uint8_t variantOfEnd<VariantCount>(uint8_t) {
  return NoVariant;
}

/// Returns true if a frame may end with this byte: 00, 04, 14, 24, 34 or 08.
constexpr bool isEndByte(uint8_t byte) { return variantOfEnd(byte) != NoVariant; }

constexpr uint8_t EndByteZeros = 0xC3;  ///< bits that are 0 in every end byte

constexpr uint8_t SlotSize = 3;       ///< characters of a telemetry slot: ID, data0, data1 (sbus2/Slots.h)
constexpr uint8_t GroupSizeMax = 33;  ///< characters between two frames: eight slots, and a break before and after each

/// Returns true if `byte` may be the ID of a slot, the first of three characters that a sensor sends. Its next two bits
/// are the group that the previous end byte announced; some home-made sensors send another group's bits.
constexpr bool isSlotId(uint8_t byte) { return (byte & 0x07) == 0x03; }

/// Returns true if the unused bits of this flags byte are 0.
constexpr bool isFlagsByte(uint8_t byte) { return (byte & FlagsUnused) == 0; }

/// Returns true if `frame` (25 bytes) has the header, flags and end byte of a frame. S.Bus has no checksum.
constexpr bool isFrame(const uint8_t *frame) {
  return frame[0] == HeaderByte && isFlagsByte(frame[FlagsIndex]) && isEndByte(frame[EndIndex]);
}

/// Returns the index of the first header, 0F or 2F, in `frame` (`size` bytes) that follows an end byte of `variant`, or
/// of any variant for NoVariant; otherwise `size`.
int innerHeader(const uint8_t *frame, int size, uint8_t variant);

/// The parameter of a function that reads or writes `Count` channels: an array, which does not compile if it is too
/// small, or a pointer to as many values. `Value` is const uint16_t, or uint16_t if the function writes.
template <typename Value, uint8_t Count>
class ChannelArray {
  template <typename>
  struct OfPointer {};
  template <typename Any>
  struct OfPointer<Any *> {
    using Type = Any *;
  };

 public:
  /// Takes an array.
  template <size_t Size>
  ChannelArray(Value (&array)[Size]) : _first(array) {
    static_assert(Size >= Count || Count != 16, "The array is too small: CH1..CH16 are uint16_t channels[16]");
    static_assert(Size >= Count || Count != 18,
                  "The array is too small: CH1..CH16, CH17 and CH18 are uint16_t channels[18]");
    static_assert(Size >= Count || Count != 24, "The array is too small: CH1..CH24 are uint16_t channels[24]");
  }

  /// Takes a pointer, or an array with a size that only another file knows. nullptr does not compile.
  template <typename Pointer>
  ChannelArray(Pointer pointer, decltype(static_cast<Value *>(typename OfPointer<Pointer>::Type())) = nullptr)
      : _first(pointer) {}

  /// Returns the address of CH1, or nullptr if the pointer was nullptr.
  operator Value *() const { return _first; }

 private:
  Value *_first;
};

/// Writes all channels of `frame` (25 bytes; header and end byte are ignored) to `channels`: 18 values, CH1..CH16
/// as 0..2047, CH17 and CH18 as 0 or 1.
void unpack(const uint8_t *frame, ChannelArray<uint16_t, ChannelCount> channels);

/// Unpacks a frame on a little-endian machine, with its payload (byte 1) aligned to four bytes: a Cortex-M0+ needs 84
/// instructions instead of unpack()'s 167 (`make bench`), and 18 bytes less.
void unpackAligned(const uint8_t *frame, ChannelArray<uint16_t, ChannelCount> channels);

/// Writes the 16 channels of a frame with header 2F to `channels`: CH17..CH32, 0..2047.
void unpackExtra(const uint8_t *frame, ChannelArray<uint16_t, ProportionalCount> channels);

/// Writes a frame, 25 bytes with end byte 00, from 18 `channels`: the exact inverse of unpack(). CH1..CH16 are clamped
/// to 2047; CH17 and CH18 are sent as 1 unless they are 0.
void pack(uint8_t *frame, ChannelArray<const uint16_t, ChannelCount> channels, bool failsafe, bool lostFrame);

/// Writes the 24 channels of a 36-byte `frame` to `channels`: CH1..CH24, 0..2047.
void unpack24(const uint8_t *frame, ChannelArray<uint16_t, ChannelCount24> channels);

/// Writes a 36-byte frame from 24 `channels`, clamped to 2047: the exact inverse of unpack24().
void pack24(uint8_t *frame, ChannelArray<const uint16_t, ChannelCount24> channels, bool failsafe, bool lostFrame);

/// The format of a frame of 16 channels, for templates.
struct Frame16 {
  using Value = ::SBusFrame;                         ///< what read() writes
  static constexpr uint8_t Size = FrameSize;         ///< bytes, the flags and the end byte last
  static constexpr uint8_t Channels = ChannelCount;  ///< values that unpack() writes
  static constexpr uint8_t Variants = VariantCount;  ///< how many rows of LineVariants such lines can have
  static constexpr uint8_t OtherSize = FrameSize24;  ///< bytes of a frame of the other format
  static constexpr bool HasSlots = true;             ///< telemetry slots may follow: S.BUS2
  static constexpr bool HasExtra = false;            ///< frames with extra channels are accepted
  static constexpr bool ZeroMeansLost = false;       ///< unpack() leaves the channels of some lost frames alone
  static constexpr unsigned SpreadMax = 22;          ///< characters: 16 of a frame spread over 4 ms, and a gap
  /// Returns the time that `count` characters take, in characters: some receivers spread a frame over 4 ms instead
  /// of 3.
  static constexpr unsigned spread(unsigned count) { return count + count / 4 + 1; }
  /// Returns the flags of a frame.
  static constexpr uint8_t flags(const uint8_t *frame) { return frame[Size - 2]; }
  /// Calls unpackAligned().
  static void unpack(const uint8_t *frame, uint16_t *channels) { unpackAligned(frame, channels); }
  /// Calls pack().
  static void pack(uint8_t *frame, const uint16_t *channels, bool failsafe, bool lostFrame) {
    sbus::pack(frame, channels, failsafe, lostFrame);
  }
};

/// The format of a frame of 24 channels.
struct Frame24 {
  using Value = ::SBusFrame24;                         ///< what read() writes
  static constexpr uint8_t Size = FrameSize24;         ///< bytes
  static constexpr uint8_t Channels = ChannelCount24;  ///< values that unpack() writes
  static constexpr uint8_t Variants = 1;               ///< end byte 00 only
  static constexpr uint8_t OtherSize = FrameSize;      ///< bytes of a frame of the other format
  static constexpr bool HasSlots = false;              ///< no telemetry
  static constexpr bool HasExtra = false;              ///< no extra channels
  static constexpr bool ZeroMeansLost = false;         ///< see Frame16
  static constexpr unsigned SpreadMax = 19;            ///< characters: 16, an idle one, and a gap
  /// Returns `count`: no receiver spreads these frames.
  static constexpr unsigned spread(unsigned count) { return count; }
  /// Returns the flags of a frame.
  static constexpr uint8_t flags(const uint8_t *frame) { return frame[Size - 2]; }
  /// Calls unpack24().
  static void unpack(const uint8_t *frame, uint16_t *channels) { unpack24(frame, channels); }
  /// Calls pack24().
  static void pack(uint8_t *frame, const uint16_t *channels, bool failsafe, bool lostFrame) {
    pack24(frame, channels, failsafe, lostFrame);
  }
};

/// Frame16, with frames of extra channels (header 2F) between. For Frame16 these are bytes between two frames.
struct Frame16Extra : Frame16 {
  static constexpr bool HasExtra = true;  ///< see Frame16
};

/// Returns true if CH1..CH4 are 0: as a receiver sends them that has lost the radio and is set to "no pulses".
constexpr bool hasNoPulses(const uint16_t *channels) {
  return (channels[0] | channels[1] | channels[2] | channels[3]) == 0;
}

/// Frame16 from a receiver that sends raw 0 for "no pulses", on all channels or on the first four, and does not always
/// set a flag: github.com/ArduPilot/ardupilot/issues/9400, 25169. These frames count as lost, and their channels are
/// not handed out.
struct Frame16NoPulses : Frame16 {
  static constexpr bool ZeroMeansLost = true;  ///< see Frame16
  /// Returns true if CH1..CH4 of the frame are 0: below any end that a radio lets four sticks have.
  static bool isZero(const uint8_t *frame);
  /// Returns the flags of a frame.
  static uint8_t flags(const uint8_t *frame) {
    return static_cast<uint8_t>(Frame16::flags(frame) | (isZero(frame) ? FlagLostFrame : 0));
  }
  /// Calls unpackAligned(), unless CH1..CH4 are 0.
  static void unpack(const uint8_t *frame, uint16_t *channels) {
    if (!isZero(frame)) {
      unpackAligned(frame, channels);
    }
  }
};

/// Returns true if a frame of this format may begin with this byte.
template <typename Format>
constexpr bool isHeaderByte(uint8_t byte) {
  return byte == HeaderByte || (Format::HasExtra && byte == ExtraHeader);
}

/// A frame as a value, which DecodeSBus::read() writes and EncodeSBus::write() sends: `Count` channels and the flags.
/// Until read() has written it both flags are true: set them to false in a frame that you fill yourself.
template <uint8_t Count>
struct FrameValue {
  uint16_t channels[Count] = {};  ///< CH1 is channels[0]; 0..2047
  bool failsafe = true;           ///< the link is lost: no frames come, or the receiver is in failsafe
  bool lostFrame = true;          ///< this radio frame did not arrive, and the channels repeat old values
  unsigned long age = ULONG_MAX;  ///< ms, when read() was called last; ULONG_MAX before the first frame
};

}  // namespace sbus

/// CH1..CH16, two switches and the flags, for DecodeSBus and EncodeSBus.
struct SBusFrame : sbus::FrameValue<sbus::ChannelCount> {
  bool ch17() const { return channels[16] != 0; }  ///< returns the switch CH17
  bool ch18() const { return channels[17] != 0; }  ///< returns the switch CH18
};

/// CH1..CH24 and the flags, for DecodeSBus24 and EncodeSBus24.
struct SBusFrame24 : sbus::FrameValue<sbus::ChannelCount24> {};
