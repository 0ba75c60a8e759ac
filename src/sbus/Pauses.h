// Tells the pauses of a line from the times at which its bytes were read.
#pragma once

#include <stdint.h>

namespace sbus {

// Bytes come late and in lumps: the board's core hands them over when 16 have come, or when the line has been idle
// for one character; a loop() fetches them once a pass. Between two looks that find bytes, a line without a pause is
// silent no longer than
//   a lump takes  +  a pass of loop()      so what lasts longer was a pause, and
//   its own bytes +  a pass of loop()      so was this, if fewer bytes came than a lump.
// Nobody tells how long a pass is, and it differs from sketch to sketch. The shortest time between two looks is not
// less, and not much more.
//
// Times are in us, and wrap after 71 minutes. All calls come from the context that reads the port.
class Pauses {
 public:
  // Forgets what was seen. `characterTime` in us: 120 at 100000 baud, 60 at 200000.
  void reset(uint32_t now, uint8_t characterTime) {
    _lastLook = now;
    _pass = FirstPass;
    _characterTime = characterTime;
  }

  // When the last look was that found bytes, or reset().
  uint32_t lastLook() const { return _lastLook; }

  // us since lastLook(). 0: the same look.
  uint32_t quiet(uint32_t now) const { return now - _lastLook; }

  // To be told of each look that finds bytes: `burst` of them, 1 or more, after so much quiet, not 0. True if the first
  // of them came behind a pause.
  bool before(unsigned burst, uint32_t quiet) {
    const unsigned pass = _pass;
    _lastLook += quiet;
    if (quiet < pass) {
      _pass = static_cast<uint16_t>(quiet);
      return false;
    }
    if (pass < LongestPass) {
      _pass = static_cast<uint16_t>(pass + pass / Forgetting);
    }
    const unsigned busy = burst * _characterTime;
    const unsigned lump = lumpTime();
    if (busy > lump + pass) {
      return false;  // more than a lump and a pass bring: this pass was longer than others, and its time says nothing
    }
    const unsigned silence = busy + (lump + pass) / Tolerance;
    return quiet - pass > (silence < lump ? silence : lump);
  }

  // True if so much quiet means that nothing follows the last bytes at once.
  bool isSilence(uint32_t quiet) const { return quiet > lumpTime(); }

  // True if passes are shorter than a lump: what is read in one look then came without a pause.
  bool shortPasses() const { return _pass < lumpTime(); }

 private:
  static constexpr unsigned LumpSize = 17;        // characters: 16 of the driver's half ring, and the idle one
  static constexpr unsigned Tolerance = 8;        // passes may differ by an eighth, and some characters may be missing
  static constexpr unsigned FirstPass = 4000;     // us, until a shorter one was seen
  static constexpr unsigned LongestPass = 16384;  // us
  static constexpr unsigned Forgetting = 32;      // loop() may become slower: the shortest pass grows by 3 % a look

  unsigned lumpTime() const { return LumpSize * _characterTime; }

  uint32_t _lastLook;      // us
  uint16_t _pass;          // us
  uint8_t _characterTime;  // us
};

}  // namespace sbus
