// Frames with channels known from sources outside this repository, each with its source.
#pragma once

#include "BitByBit.h"

// End bytes of other makes: S.BUS2's first of four, after which sensors may answer; an R7003SB's, with five more bytes.
constexpr uint8_t Sbus2End = 0x04;
constexpr uint8_t R7003End = 0x08;

struct KnownFrame {
  const char *source;
  Frame bytes;
  Channels channels;
};

// J. Lemaire, "Decoding the S-Bus protocol with a Grasshopper", chapters 4.1 and 4.2: an R-XSR, throttle low. The paper
// prints the first eight bytes and CH1..CH5. The rest is ours: CH6..CH16 at FrSky's centre 992, flags 0, end byte 00.
constexpr KnownFrame PaperLow = {
    "paper, chapter 4.1, throttle low",
    {0x0F, 0xE3, 0x03, 0x1F, 0x2B, 0xC0, 0xC7, 0x0A, 0xF0, 0x81, 0x0F, 0x7C, 0xE0,
     0x03, 0x1F, 0xF8, 0xC0, 0x07, 0x3E, 0xF0, 0x81, 0x0F, 0x7C, 0x00, 0x00},
    {995, 992, 172, 992, 172, 992, 992, 992, 992, 992, 992, 992, 992, 992, 992, 992, 0, 0}};

// The same receiver, chapter 4.2, throttle high; completed in the same way.
constexpr KnownFrame PaperHigh = {
    "paper, chapter 4.2, throttle high",
    {0x0F, 0xE3, 0x0B, 0xDF, 0xC4, 0xC1, 0xC7, 0x0A, 0xF0, 0x81, 0x0F, 0x7C, 0xE0,
     0x03, 0x1F, 0xF8, 0xC0, 0x07, 0x3E, 0xF0, 0x81, 0x0F, 0x7C, 0x00, 0x00},
    {995, 993, 1811, 992, 172, 992, 992, 992, 992, 992, 992, 992, 992, 992, 992, 992, 0, 0}};

// A whole frame of a FrSky receiver with neutral sticks: github.com/Cleric-K/vJoySerialFeeder, issue 3. Its payload
// holds the header byte 0F twice.
constexpr KnownFrame Neutral = {"FrSky, neutral sticks, vJoySerialFeeder issue 3",
                                {0x0F, 0xE5, 0x03, 0x1F, 0xF8, 0xC0, 0x07, 0x3E, 0xF0, 0x81, 0x0F, 0x7C, 0xE0,
                                 0x03, 0x06, 0xF8, 0x80, 0x91, 0x3D, 0xF0, 0x81, 0x0F, 0x7C, 0x00, 0x00},
                                {997, 992, 992, 992, 992, 992, 992, 992, 992, 192, 992, 192, 985, 992, 992, 992, 0, 0}};

// A real R-XSR's failsafe frame: from its flags byte on, the line looks like frames as well.
constexpr Frame SecondReading = {0x0F, 0xD8, 0x1B, 0x1F, 0x2B, 0xB2, 0xC7, 0x0A, 0x0F, 0x7C, 0x00, 0x00, 0x00,
                                 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x0F, 0x00};

// A frame of a Futaba R7008SB on S.BUS2, telemetry slot 3: PX4-Autopilot, src/lib/rc/rc_tests/test_data/
// sbus2_r7008SB.txt (BSD-3-Clause).
constexpr KnownFrame Sbus2 = {
    "Futaba R7008SB, S.BUS2, PX4-Autopilot sbus2_r7008SB.txt",
    {0x0F, 0x11, 0x04, 0x20, 0xA8, 0x01, 0x08, 0x16, 0x50, 0x03, 0x10, 0x80, 0x00,
     0x04, 0x20, 0x00, 0x01, 0x08, 0x40, 0x00, 0x02, 0x10, 0x80, 0x00, 0x34},
    {1041, 1024, 1696, 1024, 352, 1696, 1024, 1024, 1024, 1024, 1024, 1024, 1024, 1024, 1024, 1024, 0, 0}};

constexpr KnownFrame KnownFrames[] = {PaperLow, PaperHigh, Neutral, Sbus2};

// FrSky's 24 channels: github.com/nseinlet/Modelisme, src/FrSky_SBus.cpp, which says that CH1 is 1025 and CH2 1024. The
// others are worked out bit by bit.
struct KnownLongFrame {
  LongFrame bytes;
  LongChannels channels;
};
constexpr KnownLongFrame Published24 = {
    {0x0F, 0x01, 0x04, 0x20, 0x00, 0xFF, 0x07, 0x40, 0x00, 0x02, 0x10, 0x80, 0x2C, 0x64, 0x21, 0x0B, 0x59, 0x08,
     0x40, 0x00, 0x02, 0x10, 0x80, 0x2C, 0x64, 0x21, 0x0B, 0x59, 0x08, 0x40, 0x00, 0x02, 0x10, 0x80, 0x00, 0x00},
    {1025, 1024, 1024, 1023, 1024, 1024, 1024, 1024, 1068, 1068, 1068, 1068,
     1024, 1024, 1024, 1024, 1068, 1068, 1068, 1068, 1024, 1024, 1024, 1024}};

// A failsafe frame of a real receiver. It allows a false sync, which begins with its flags, 0F, and ends before those
// of the next frame.
constexpr Frame FailsafeFrame = {0x0F, 0xD8, 0x1B, 0x1F, 0x2B, 0xB2, 0xC7, 0x0A, 0x0F, 0x7C, 0x00, 0x00, 0x00,
                                 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x0F, 0x00};

// Returns frame number `number` of a line whose CH1 counts from `first`, and whose other channels are at `centre`.
inline Frame countingFrame(uint16_t centre, unsigned first, unsigned number, uint8_t end) {
  Channels channels{};
  for (unsigned channel = 0; channel < 16; channel++) {
    channels[channel] = centre;
  }
  channels[0] = static_cast<uint16_t>(first + number);
  Frame frame = writeBitByBit(channels);
  frame[24] = end;
  return frame;
}

// Returns a frame with FrSky's neutral sticks, 992: 0F twice in the payload.
inline Frame neutralFrame(unsigned number, uint8_t end = 0x00) { return countingFrame(992, 900, number, end); }

// Returns a frame with Futaba's centre, 1024: no 0F in the payload.
inline Frame plainFrame(unsigned number, uint8_t end = 0x00) { return countingFrame(1024, 1024, number, end); }

// Returns frame number `number` of 24 channels, plain or neutral.
inline LongFrame longFrame(unsigned number, bool neutral = false) {
  LongChannels channels;
  channels.fill(neutral ? 992 : 1024);
  channels[0] = static_cast<uint16_t>(1000 + number);
  return writeBitByBit(channels);
}

// Returns frame number `number` of Futaba's extra channels.
inline Frame extraFrame(unsigned number, uint8_t end = 0x00) {
  Frame frame = countingFrame(1500, 300, number, end);
  frame[0] = 0x2F;
  return frame;
}
