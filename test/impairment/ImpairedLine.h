// A receiver on an impaired line: its frames, and what happens to them on the way.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>

#include "Payload.h"
#include "line/Line.h"
#include "line/LineSettings.h"

// What the receiver sends.
enum class Kind {
  Plain,
  Sbus2,       // end bytes 04, 14, 24, 34 in turn
  R7003SB,     // end byte 08 and five more bytes straight after the frame
  Fasst12,     // these five as an oscilloscope shows them: 00, after 310 us telemetry slot 0, and 00
  With2F,      // Futaba's further channels: a 2F frame 0.6 to 6 ms before each frame
  Odd2F,       // after every third frame a 2F frame, wherever that is
  Channels24,  // 36-byte frames only
};

// Probabilities.
struct Impairments {
  double dropped = 0;   // of a character: its parity is wrong, so the UART drops it
  double burst = 0;     // of a character: with it a burst of 2 to 12 begins, which are dropped; one in eight is junk
  double eleven = 0;    // of a character: with it eleven are dropped, and 25 of 36 are left
  double inserted = 0;  // of a character: another, random one comes straight before it
  double flipped = 0;   // of a character: two of its bits are wrong, and parity misses it
  double noise = 0;     // of a gap: it holds one character, anything, anywhere
};

// What other characters are on the wire.
struct Company {
  unsigned slots = 0;            // of telemetry, after each frame that ends in 04
  bool afterEach = false;        // also after 14, 24 and 34
  int32_t lateUs = 0;            // sensors answer this much too late; below 0: too early
  uint8_t group = 0;             // added to the group of which their slots should be
  int strayBefore = NoStray;     // a character straight before each frame; AnyStray: anything but a header
  int strayAfter = NoStray;      // a character straight after each frame
  bool breakAfterSlots = false;  // a 00 straight after each slot
  double cutSlots = 0;           // of a slot: one or two of its characters are lost, or all with the 00 after them

  static constexpr int NoStray = -1, AnyStray = 256;
};

// Silences within frames, as senders have them that write each character when they find the time.
struct Silences {
  unsigned count = 0;     // in a frame, some of which may coincide
  uint32_t leastUs = 60;  // from the end of a character to the next one
  uint32_t mostUs = 480;
  unsigned after = 0;      // this many characters of the frame; 0: places are drawn
  bool eachFrame = false;  // draws for each frame, not once for the line
};

// Noise just before a frame.
struct NoiseBefore {
  double probability = 0;  // of a frame: 1 to 4 characters come before it; in every other case one of them is a header
  uint32_t leastUs = 0;    // from their end to the frame
  uint32_t mostUs = 0;
};

// The wire is open from one character of a frame on, up to but without another. Frames count from 0.
struct Cut {
  uint64_t fromFrame = 0;
  unsigned fromCharacter = 0;
  uint64_t toFrame = 0;
  unsigned toCharacter = 0;
  uint64_t every = 0;  // again after this many frames, each time a character later

  // After the cut another receiver sends, with other sticks, and this long after the last character of the first. Each
  // end of the cut may leave a part of a character, which the UART takes for any character, or drops.
  bool swaps = false;
  uint32_t silenceUs = 0;
};

// What goes over the line, and how fast.
struct Transmission {
  Impairments impairments{};
  Kind kind = Kind::Plain;
  Payload sticks = Payload::Neutral;
  unsigned long baud = sbus::Baud;
  uint32_t periodUs = 9000;
  uint32_t unsteadyUs = 0;  // a period is up to this much shorter or longer
  uint32_t spreadUs = 0;    // between the characters of a frame
  uint32_t jitterUs = 0;    // up to this much more, drawn for each character
  Silences silences{};
  uint64_t frames = 100;
  uint64_t stopEvery = 0;  // after this many frames the line is silent for 100 ms
  Company company{};
  NoiseBefore noiseBefore{};
  Cut cut{};

  uint32_t characterUs() const { return line::LineSettings{baud}.characterUs(); }
  // Returns the longest time from the end of a character of a frame to the next one.
  uint32_t longestSilenceUs() const { return spreadUs + jitterUs + (silences.count != 0 ? silences.mostUs : 0); }
};

// A frame as it was on the line. Good characters are numbered as they come, from 0; the UART drops the others unseen.
struct SentFrame {
  LongFrame bytes{};
  unsigned size = sbus::FrameSize;
  bool extra = false;     // its header is 2F
  bool intact = true;     // all there, nothing in between, and header, flags and end byte are those of a frame
  bool altered = false;   // not what the receiver sent
  bool straight = false;  // nothing comes between it and the intact frame before it, with all that belongs to that
                          // frame; nor was the line silent for longer than any frame period
  uint64_t first = 0;     // number of its first good character
  uint64_t after = 0;     // number of the good character after it
  uint64_t endUs = 0;     // when its last character was complete
};

class ImpairedLine : public line::Line {
 public:
  // The first frame begins at `startUs`.
  ImpairedLine(const Transmission &transmission, uint64_t startUs, Random &random);

  bool next(uint64_t nowUs, line::Character &character) override;
  bool finished(uint64_t nowUs) const override;

  // Returns when the next character will be complete; UINT64_MAX once the line has finished.
  uint64_t nextUs();

  // Takes the oldest frame that was sent; returns false without one. No character of a frame comes before it.
  bool nextSent(SentFrame &frame);

  // Returns when the first character after the cut begins, if only frames are sent, and spread evenly; without a cut,
  // the first of all.
  uint64_t joinedUs() const { return _joinedUs; }

  uint64_t noiseCharacters() const { return _noiseCharacters; }

 private:
  void sendFrame();
  // `size` bytes: the frame, and what belongs to it.
  void sendImpaired(const uint8_t *bytes, unsigned size, SentFrame &sent);
  void sendExtra();
  void sendBetween(uint8_t end);
  void sendSlots(unsigned group);
  void sendStray(int stray);
  void sendNoiseBefore();
  void sendFragment();
  void drawSilences(unsigned size);
  void swap();
  void send(uint8_t value, bool bad = false);
  bool isCut(unsigned character) const;

  const Transmission _transmission;
  const uint32_t _characterUs;
  const uint64_t _joinedUs;
  Random &_random;
  PayloadFrames _sticks;
  PayloadFrames _moreSticks;                  // CH17 to CH24, or CH32
  std::optional<PayloadFrames> _otherSticks;  // of the receiver after a swap

  uint64_t _framesLeft;
  uint64_t _number = 0;  // of the next frame
  uint64_t _frameUs;     // when it begins
  uint64_t _timeUs;      // when all that was sent so far is complete
  uint64_t _good = 0;    // good characters sent so far
  uint64_t _noiseCharacters = 0;
  uint64_t _burstEndUs = 0, _elevenEndUs = 0;
  uint64_t _cutUs = 0;                                  // when the first character that was cut off would have begun
  bool _straight = false;                               // of the next frame
  std::array<uint32_t, sbus::FrameSize24> _silentUs{};  // before each character of a frame
  std::deque<line::Character> _characters;
  std::deque<SentFrame> _sent;
};
