/// @file
/// Decides whether 25 characters are a frame, with one function for each rule. extras/docs/rules.md says what each
/// rule is worth.
#pragma once

#include <stdint.h>

#include "FrameSizeCheck.h"
#include "Frame.h"
#include "LineTiming.h"

/// For functions that cost more to call than to inline.
#define SBUS_IN_LINE __attribute__((always_inline)) inline

namespace sbus {

/// Why 25 characters that begin with a header are rejected.
enum class Rejection : uint8_t {
  NoEnd,      ///< no end byte
  Flags,      ///< unused bits of the flags are set
  GapInside,  ///< a gap lies inside
  GoesOn,     ///< more characters follow than a frame has
  NotAtGap,   ///< out of sync: the line's frames begin at gaps, or have the other size
  FalseSync   ///< they may be the end of one frame and the start of the next
};

/// The judgement of 25 characters (36 for 24 channels).
class Verdict {
 public:
  /// They are a frame. `isAligned`: certainly, whatever came before them.
  static constexpr Verdict accept(bool isAligned) { return Verdict(isAligned ? Aligned : Accepted, Rejection::NoEnd); }
  static constexpr Verdict wait() { return Verdict(Open, Rejection::NoEnd); }  ///< the next characters decide
  /// They are not a frame. The next one may begin `skip` characters further on, 1 or more.
  static constexpr Verdict reject(Rejection why, int skip = 1) { return Verdict(skip, why); }

  constexpr bool isAccepted() const { return _skip < Open; }     ///< accept()
  constexpr bool isAligned() const { return _skip == Aligned; }  ///< accept(true)
  constexpr bool isOpen() const { return _skip == Open; }        ///< wait()
  constexpr int skip() const { return _skip; }                   ///< of a rejection
  constexpr Rejection why() const { return _why; }               ///< of a rejection

 private:
  enum : int_fast8_t { Aligned = -2, Accepted = -1, Open = 0 };

  constexpr Verdict(int skip, Rejection why) : _skip(static_cast<int_fast8_t>(skip)), _why(why) {}

  int_fast8_t _skip;
  Rejection _why;
};

/// Characters that begin with a header, and what is known about their place.
template <typename Format>
struct Candidate {
  const uint8_t *bytes;  ///< from the header on
  int_fast8_t count;     ///< 25 or more; 8 bits: 56 bytes less on an AVR
  int_fast8_t gapAt;     ///< index of the first character after the newest gap; may lie outside
  Silence gap;           ///< how certain that gap is: Late, Likely, Gap or Wide
  Silence inside;        ///< what the gaps inside before that one are: FrameBuffer::inside()
  bool isPlaced;         ///< a wide gap comes before it, or it is in sync and in time: parts of two frames come later
  uint8_t variant;       ///< of its end byte, a row of LineVariants
  uint8_t lineVariant;   ///< of the line, or NoVariant
  int_fast8_t distance;  ///< characters between the previous frame and this one; below 0: that frame's tail lacks some
  bool isInSync;         ///< it follows an aligned frame directly

  SBUS_IN_LINE bool hasLineVariant() const { return variant == lineVariant; }     ///< has the line's variant
  SBUS_IN_LINE const LineVariant &line() const { return LineVariants[variant]; }  ///< its variant
  SBUS_IN_LINE uint8_t end() const { return bytes[Format::Size - 1]; }            ///< its end byte
  /// Returns the size with the tail.
  SBUS_IN_LINE int_fast8_t size() const { return static_cast<int_fast8_t>(Format::Size + line().tailSize); }
  /// Returns true if a gap follows it, or cuts its tail short.
  SBUS_IN_LINE bool isGapAfter() const { return isGapCertain() && gapAt >= Format::Size && gapAt <= size(); }
  SBUS_IN_LINE bool isGapBefore() const { return isGapCertain() && gapAt == 0; }  ///< a gap comes before it
  SBUS_IN_LINE bool isGapCertain() const { return isCertain(gap); }  ///< otherwise loop() may have been blocked
};

/// The rules, a function each: without a rule its function always returns what test/impairment/RULES says. All but
/// isExactlyNext() matter only on unusual lines.
namespace rules {

constexpr int NoiseMax = 4;  ///< characters in a row that may be noise
/// Candidate::distance of the first character on a line, or after a long silence.
constexpr int FirstDistance = 2;

/// Returns true if the unused bits of the flags are 0.
SBUS_IN_LINE bool areFlags(uint8_t byte) { return isFlagsByte(byte); }

/// Returns true if a gap lies inside: the end of one frame and the start of the next, or a stretched frame.
template <typename Format>
SBUS_IN_LINE bool hasGapInside(const Candidate<Format> &c) {
  return (c.gapAt > 0 && c.gapAt < Format::Size) || c.inside != Silence::Unknown;
}

/// Returns true if its sender may have stretched it: it begins where and when a frame is due, or after a wide gap, and
/// no gap inside is wide. Parts of two frames that fit together are a frame period apart.
template <typename Format>
SBUS_IN_LINE bool mayBeStretched(const Candidate<Format> &c) {
  return c.isPlaced && !isWide(c.inside) && (!isWide(c.gap) || c.gapAt >= Format::Size);
}

/// Returns true if a header follows it; 2F counts on lines with such frames (needed where the gap before is not
/// seen).
template <typename Format>
SBUS_IN_LINE bool isHeaderNext(const Candidate<Format> &c) {
  return (c.bytes[c.size()] & c.line().headerMask) == HeaderByte;
}

/// Returns true if only what follows can prove it: while the line variant is unknown.
template <typename Format>
SBUS_IN_LINE bool mustBeFollowed(const Candidate<Format> &c) {
  return !c.hasLineVariant();
}

/// Returns true if telemetry slots may follow the frames of this variant.
template <typename Format>
SBUS_IN_LINE bool hasSlots(uint8_t variant) {
  return Format::HasSlots && variant == SlotsVariant;
}

/// Returns true if one stray character may follow it directly: before the first frame, or after a missing frame,
/// because the line's variant may be mistaken. No frame may begin at its second byte: otherwise the first byte could be
/// the stray one. (isEndByte() instead of the mask costs 52 bytes on a Cortex-M0+.)
template <typename Format>
SBUS_IN_LINE bool mayHaveStray(const Candidate<Format> &c) {
  const bool isLate = c.distance != 0 && !(c.hasLineVariant() && hasSlots<Format>(c.variant));
  return (c.lineVariant == NoVariant || isLate) &&
         (c.bytes[1] != HeaderByte || !isFlagsByte(c.end()) || (c.bytes[Format::Size] & EndByteZeros) != 0);
}
/// Returns true if one stray character follows it directly: the gaps before and after prove that.
template <typename Format>
SBUS_IN_LINE bool hasStray(const Candidate<Format> &c, const FrameSizeCheck<Format> &sizeCheck) {
  const int after = c.size() + 1;
  return c.gapAt == after && sizeCheck.betweenGaps() == after && mayHaveStray(c);
}

/// Returns true if, before the first frame, the five bytes of its tail may belong to the next frame: a gap follows
/// them, but no gap comes before it.
template <typename Format>
SBUS_IN_LINE bool isDoubtfulTail(const Candidate<Format> &c, const FrameSizeCheck<Format> &sizeCheck) {
  return !c.hasLineVariant() && c.gapAt > Format::Size && c.gapAt <= c.size() && sizeCheck.betweenGaps() != c.gapAt;
}

/// Returns true if its end byte comes twice: noise may precede the true header, or a stray character may follow the
/// true end. If a stray character and then a gap followed the previous frame, it is the latter.
template <typename Format>
SBUS_IN_LINE bool repeatsEnd(const Candidate<Format> &c) {
  return c.bytes[c.size()] == c.end() && !(c.distance == 1 && c.gapAt == 0);
}

/// Returns true if this character and the one three further on may be the IDs of two slots of one group in turn, and
/// another slot of the group or a header follows them: an S.BUS2 frame has ended before them. (The mask is isSlotId()
/// and the first bit of an ID: 4 bytes less.)
SBUS_IN_LINE bool areSlots(const uint8_t *at) {
  return (*at & 0x87) == 0x03 && (*at ^ at[SlotSize]) == 0x80 &&
         (((*at ^ at[2 * SlotSize]) & GroupOfId) == 0 || at[2 * SlotSize] == HeaderByte);
}

/// How many characters after a frame are searched for slots.
constexpr int SlotsBehind = 12;

/// Returns the index of a header after an end byte inside it, where the next frame may begin; otherwise Size. While the
/// line's variant is unknown any end byte counts, and so do slots, inside it or behind it: then the header behind it
/// was no header, but a byte of the frame before them. Slots directly behind it, or behind its break, are its own. (Not
/// inlined: 24 bytes less on a Cortex-M0+.)
template <typename Format>
__attribute__((noinline)) int falseSyncAt(const Candidate<Format> &c) {
  if (c.hasLineVariant() || Format::Variants == 1) {
    return innerHeader(c.bytes, Format::Size, c.variant);
  }
  for (int_fast8_t i = static_cast<int_fast8_t>(c.count - 2 * SlotSize - 1); i > 0; i--) {
    if (areSlots(c.bytes + i) && static_cast<unsigned>(i - Format::Size) > 1) {
      return 1;
    }
  }
  return innerHeader(c.bytes, Format::Size, NoVariant);
}

/// Returns true if slots may still come behind the first frame, although a header follows it: no gap comes before it,
/// and it is not the line's beginning.
template <typename Format>
SBUS_IN_LINE bool maySlotsFollow(const Candidate<Format> &c, bool isAtGap) {
  return Format::HasSlots && c.lineVariant == NoVariant && !isAtGap && c.distance > FirstDistance &&
         c.count < Format::Size + SlotsBehind && falseSyncAt(c) == Format::Size;
}

/// Returns true if its characters only came late, and it ends where the next frame may begin: the rest of another frame
/// would come a period later. It must not look like the end of one frame and the start of the next: in false sync each
/// frame has a gap inside.
template <typename Format>
SBUS_IN_LINE bool isOnlyLate(const Candidate<Format> &c) {
  return LineTiming::ClockRuns && c.gap == Silence::Late && c.inside <= Silence::Late &&
         (c.count == Format::Size || isHeaderNext(c)) && falseSyncAt(c) == Format::Size;
}

/// Returns true if a gap after it would still prove that it is aligned. It would not after the short rest of one frame
/// and a frame from `inner` on that lost as many characters; more characters than noise has come before such a rest,
/// and not just a frame's number of them, which are a frame with header 2F.
template <typename Format>
SBUS_IN_LINE bool silenceMayProve(const Candidate<Format> &c, int inner) {
  return c.count <= c.size() && (inner >= Format::Size / 2 || c.distance <= NoiseMax || c.distance == FrameSize);
}

/// Returns true if this may be the break that some receivers send after each frame and each slot (a Futaba R7008SB).
SBUS_IN_LINE bool isBreak(uint8_t byte) { return byte == 0; }

/// Returns true if its end byte may be a break: it may be an S.BUS2 frame that has lost a character.
template <typename Format>
SBUS_IN_LINE bool mayEndInBreak(uint8_t variant, bool hasBreaks) {
  return Format::HasSlots && hasBreaks && variant != SlotsVariant;
}

/// Returns true if, before the first frame, these flags may be the end byte 04 of an S.BUS2 frame that has lost a
/// character, and the end byte after them, of `variant`, a break. If a frame's number of characters has come twice in a
/// row, they are flags.
template <typename Format>
SBUS_IN_LINE bool mayBeEnd(const uint8_t *frame, uint8_t variant, uint8_t lineVariant, int betweenGaps) {
  return Format::HasSlots && lineVariant == NoVariant && betweenGaps != Format::Size &&
         frame[Format::Size - 2] == LineVariants[SlotsVariant].end && variant != SlotsVariant;
}

// ---- For unseen gaps, as when a port is polled too seldom: where each gap is seen, these rules and isInTurn() change
// nothing, except that breaks would not be noticed.

/// Returns true if a slot follows it, perhaps after a break. FrameSizeCheck::isInTurn() says when that proves the first
/// frame.
template <typename Format>
SBUS_IN_LINE bool isSlotNext(const Candidate<Format> &c) {
  const int id = c.size() + (isBreak(c.bytes[c.size()]) ? 1 : 0);
  return hasSlots<Format>(c.variant) && id < c.count && isSlotId(c.bytes[id]);
}

/// Returns true if more characters follow than noise has, and no header is the second of them.
template <typename Format>
SBUS_IN_LINE bool goesOn(const Candidate<Format> &c) {
  return c.count > c.size() + NoiseMax && c.bytes[c.size() + 1] != HeaderByte;
}

// ---- The verdict

/// Judges a frame with extra channels. It must begin where a frame is expected, or at a gap: otherwise a noise
/// character 2F directly before a frame would swallow that frame. The line's variant must be known, and a header or a
/// gap must follow.
template <typename Format>
SBUS_IN_LINE Verdict judgeExtra(const Candidate<Format> &c) {
  const bool isExpected = c.distance == 0 || c.gapAt == 0 || c.gapAt == Format::Size;
  if (!isExpected || !c.hasLineVariant()) {
    return Verdict::reject(Rejection::NotAtGap);
  }
  if (c.gapAt == Format::Size || (c.count > Format::Size && isHeaderNext(c))) {
    return Verdict::accept(true);
  }
  return c.count > Format::Size ? Verdict::reject(Rejection::GoesOn) : Verdict::wait();
}

/// Returns true if the characters are exactly the next frame of a line in sync, as they nearly always are. judge()
/// would also accept them, but takes 160 cycles more.
template <typename Format>
SBUS_IN_LINE bool isExactlyNext(const uint8_t *bytes, int filled, int gapAt, uint8_t variant, bool isInSync) {
  return filled == Format::Size && isInSync && (gapAt == 0 || gapAt > Format::Size) && bytes[0] == HeaderByte &&
         areFlags(bytes[Format::Size - 2]) && endsVariant(bytes[Format::Size - 1], variant);
}

/// Judges a frame with a gap inside. A gap must follow it directly (a wide one, until the line's variant is known),
/// unless it only came late. (Not inlined: 104 bytes less on a Cortex-M0+.)
template <typename Format>
__attribute__((noinline)) Verdict judgeStretched(const Candidate<Format> &c, FrameSizeCheck<Format> &sizeCheck) {
  int skip = c.gapAt < Format::Size ? c.gapAt : int{Format::Size};
  if (mayBeStretched(c)) {
    if (isOnlyLate(c) || (c.gapAt == Format::Size && c.gap >= (c.hasLineVariant() ? Silence::Gap : Silence::Wide))) {
      sizeCheck.stretchedFrame();
      if (sizeCheck.isStretched() && c.inside != Silence::Likely) {
        return Verdict::accept(true);
      }
      skip = Format::Size;
    } else if (c.count == Format::Size) {
      return Verdict::wait();
    }
  }
  return Verdict::reject(Rejection::GapInside, skip);
}

/// Judges by all rules, the cheapest first.
template <typename Format>
SBUS_IN_LINE Verdict judge(const Candidate<Format> &c, FrameSizeCheck<Format> &sizeCheck) {
  if (hasGapInside(c)) {
    return judgeStretched(c, sizeCheck);
  }
  if (Format::HasExtra && c.bytes[0] == ExtraHeader) {
    return judgeExtra(c);
  }
  // It must end at a gap, before a header, or as the line's frames end.
  const bool isGapAfter = c.isGapAfter();
  bool isAtGap = isGapAfter || c.isGapBefore();
  bool isProved = isAtGap && !isDoubtfulTail(c, sizeCheck);
  bool isInTurn = false;
  if (!isGapAfter) {
    if (c.count <= c.size()) {
      if (mustBeFollowed(c)) {
        return Verdict::wait();
      }
    } else if (!isHeaderNext(c)) {
      // A rejection here skips two characters: if both are headers, either may be the true one.
      if (hasStray(c, sizeCheck)) {
        isAtGap = true;
        isProved = true;
      } else if (c.count == c.size() + 1 && mayHaveStray(c)) {
        return Verdict::wait();  // for a gap, or a slot after a break (20 bytes less than waiting for these only)
      } else if (c.hasLineVariant()) {
        if (!isSlotNext(c) && (repeatsEnd(c) || goesOn(c))) {
          return Verdict::reject(Rejection::GoesOn, 2);
        }
      } else {
        isInTurn = isSlotNext(c) && sizeCheck.isInTurn(c.end());
        if (!isInTurn) {
          return Verdict::reject(Rejection::GoesOn, 2);
        }
      }
    } else if (maySlotsFollow(c, isAtGap)) {
      return Verdict::wait();
    }
  }
  if (!c.hasLineVariant() && !sizeCheck.allows(isAtGap || isInTurn, c.distance <= FirstDistance)) {
    return Verdict::reject(Rejection::NotAtGap);
  }
  // Out of sync it may be the end of one frame and the start of the next.
  const int inner = isProved || c.isInSync ? Format::Size : falseSyncAt(c);
  if (inner < Format::Size) {
    return silenceMayProve(c, inner) ? Verdict::wait() : Verdict::reject(Rejection::FalseSync, inner);
  }
  return Verdict::accept(isProved || c.distance == 0);
}

}  // namespace rules
}  // namespace sbus
