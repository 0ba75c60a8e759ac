// A receiver on a bad wire: its frames, and what becomes of them on the way.
#pragma once

#include <cstdint>
#include <deque>

#include <runtime/Line.h>
#include <runtime/Wire.h>

#include "Random.h"
#include "Sticks.h"

// What the receiver sends besides plain frames.
enum class Kind {
  Plain,
  Sbus2,     // end bytes 04, 14, 24, 34 in turn; every other 04 is answered by three bytes of telemetry, 2 ms behind it
  R7003SB,   // end byte 08 and five more bytes straight behind the frame
  Further,   // behind every third frame a 2F frame or a 36-byte frame, in turn
};

// Probabilities.
struct Impairments {
  double dropped = 0;   // of a character: its parity is wrong, so the UART drops it
  double inserted = 0;  // of a character: any other one comes straight before it
  double flipped = 0;   // of a character: two of its bits are wrong, and parity misses it
  double noise = 0;     // of a pause: it holds one character, anything, anywhere; not with Kind::Further
};

// What goes over the wire, and how fast.
struct Transmission {
  Impairments impairments{};
  Kind kind = Kind::Plain;
  Sticks sticks = Sticks::Neutral;
  unsigned long baud = sbus::Baud;
  uint32_t periodUs = 9000;
  uint64_t frames = 20000;
  uint32_t grainUs = 1;  // times at random are multiples of it: with 2 they are twice those with 1, from the same seed

  uint32_t characterUs() const { return host::Wire{baud}.characterUs(); }
};

// A frame as it stood on the wire. Good characters are numbered as they come, from 0; the UART drops bad ones unseen.
struct SentFrame {
  Frame bytes{};
  bool intact = true;   // all there, nothing in between, and header, flags and end byte are those of a frame
  uint64_t first = 0;   // number of its first good character
  uint64_t behind = 0;  // number of the good character behind it
};

class WireLine : public host::Line {
 public:
  // The first frame begins at `startUs`.
  WireLine(const Transmission &transmission, uint64_t startUs, Random &random);

  bool next(uint64_t nowUs, host::Character &character) override;
  bool finished(uint64_t nowUs) const override;

  // When the next character will be through, if the line has not finished.
  uint64_t nextUs();

  // The next frame that was sent, the oldest first; false if there is none. No character of a frame comes before it.
  bool nextSent(SentFrame &frame);

  uint64_t noiseCharacters() const { return _noiseCharacters; }

 private:
  void sendFrame();
  void sendTail(uint8_t end);
  void sendNoise(uint64_t nextFrameUs);
  uint64_t sendFurther(uint64_t nextFrameUs);
  void send(uint8_t value, bool bad = false);

  const Transmission _transmission;
  const uint32_t _characterUs;
  Random &_random;
  StickFrames _sticks;

  uint64_t _framesLeft;
  uint64_t _number = 0;  // of the next frame
  uint64_t _frameUs;     // when it begins
  uint64_t _timeUs;      // when what was sent so far is through
  uint64_t _good = 0;    // good characters sent so far
  uint64_t _noiseCharacters = 0;
  std::deque<host::Character> _characters;
  std::deque<SentFrame> _sent;
};
