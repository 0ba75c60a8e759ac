/// @file
/// When are 25 characters a frame? One function a rule; extras/docs/receiver.md has what each is worth.
#pragma once

#include <stdint.h>

#include "Acquisition.h"
#include "Frame.h"
#include "Rule.h"

/// A call of a rule would cost more than the rule.
#define SBUS_IN_LINE __attribute__((always_inline)) inline

namespace sbus {

/// Why 25 characters that begin with a header are no frame.
enum class Rejection : uint8_t {
  NoEnd,         ///< no end byte
  Flags,         ///< unused bits of the flags are set
  GapInside,     ///< a gap lies within
  GoesOn,        ///< more belong to them than to a frame
  NotAtGap,      ///< before the first frame: the line's frames stand at gaps, or are of the other size
  SecondReading  ///< they may be the halves of two frames
};

/// What is to be done with 25 characters (36).
class Verdict {
 public:
  /// It is a frame. `isCertain`: and so is its place, even if the place of the frame before it was not.
  static constexpr Verdict accept(bool isCertain) {
    return Verdict(isCertain ? Certain : Accepted, Rejection::NoEnd);
  }
  static constexpr Verdict wait() { return Verdict(Open, Rejection::NoEnd); }  ///< what follows tells more
  /// Another frame may begin `next` characters further on, 1 or more.
  static constexpr Verdict reject(Rejection why, int next = 1) { return Verdict(next, why); }

  constexpr bool isAccepted() const { return _next < Open; }     ///< accept()
  constexpr bool isCertain() const { return _next == Certain; }  ///< accept(true)
  constexpr bool isOpen() const { return _next == Open; }        ///< wait()
  constexpr int next() const { return _next; }                   ///< of a rejection
  constexpr Rejection why() const { return _why; }               ///< of a rejection

 private:
  enum : int_fast8_t { Certain = -2, Accepted = -1, Open = 0 };

  constexpr Verdict(int next, Rejection why) : _next(static_cast<int_fast8_t>(next)), _why(why) {}

  int_fast8_t _next;
  Rejection _why;
};

/// Characters that begin with a header, and what is known of their place.
template <typename Format>
struct Candidate {
  const uint8_t *bytes;  ///< from the header on
  int count;             ///< of them, 25 or more
  int gapAt;             ///< index of the first one after the newest gap; may lie outside
  bool isGapCertain;     ///< there was one; else loop() may have been blocked
  uint8_t variant;          ///< by its end byte: a row of LineVariants
  uint8_t lineVariant;      ///< of the line's frames; UnknownVariant before the first
  int offBy;             ///< so many characters stand between the frame before and this one; below 0: its tail lacks some
  bool isSure;           ///< none, and that frame's place was certain

  SBUS_IN_LINE bool isLines() const { return variant == lineVariant; }          ///< of the line's variant
  SBUS_IN_LINE const LineVariant &line() const { return LineVariants[variant]; }   ///< what is known of its variant
  SBUS_IN_LINE uint8_t end() const { return bytes[Format::Size - 1]; }    ///< its end byte
  /// With its tail.
  SBUS_IN_LINE int size() const { return Format::Size + (holds(Rule::tail) ? line().tailSize : 0); }
  /// A gap follows it, or cuts its tail short.
  SBUS_IN_LINE bool isGapAfter() const { return isGapCertain && gapAt >= Format::Size && gapAt <= size(); }
  SBUS_IN_LINE bool isGapBefore() const { return isGapCertain && gapAt == 0; }  ///< it stands at a gap
};

/// Each says what its name says of a candidate. All but isUsual() are for lines on which something is unusual.
namespace rules {

constexpr int MostNoise = 4;  ///< characters; more in a row are no noise
/// Where the first character on a line, or behind a long silence, stands by Candidate::offBy: nothing is expected there.
constexpr int FirstOffBy = 2;

/// The flags' unused bits are 0.
SBUS_IN_LINE bool areFlags(uint8_t byte) {
  return !holds(Rule::flags) || isFlagsByte(byte);
}

/// A gap lies within: the halves of two frames.
template <typename Format>
SBUS_IN_LINE bool hasGapInside(const Candidate<Format> &c) {
  return holds(Rule::inside) && c.gapAt > 0 && c.gapAt < Format::Size;
}

/// The next frame's header follows it, 2F too where such frames come between.
template <typename Format>
SBUS_IN_LINE bool isHeaderNext(const Candidate<Format> &c) {
  return (c.bytes[c.size()] & (holds(Rule::extraHeader) ? c.line().headerMask : 0xFF)) == HeaderByte;
}

/// The ID of a telemetry slot follows it, as it does on S.BUS2 lines.
template <typename Format>
SBUS_IN_LINE bool isSlotNext(const Candidate<Format> &c) {
  return holds(Rule::slots) && Format::HasExtra && c.variant == SlotsVariant && isSlotId(c.bytes[c.size()]);
}

/// Before the first frame: one stray character may stand straight behind it. The gaps before and after tell, and a
/// second byte that is no header: then the first could be the stray one.
template <typename Format>
SBUS_IN_LINE bool mayHaveStray(const Candidate<Format> &c) {
  return holds(Rule::stray) && c.lineVariant == UnknownVariant && c.bytes[1] != HeaderByte;
}
/// One does.
template <typename Format>
SBUS_IN_LINE bool hasStray(const Candidate<Format> &c, const Acquisition<Format> &acquisition) {
  const int after = c.size() + 1;
  return c.gapAt == after && acquisition.lastRun() == after && mayHaveStray(c);
}

/// Before the first frame: what looks like a tail before a gap may be the end of the next frame, unless a gap stands
/// before it as well.
template <typename Format>
SBUS_IN_LINE bool mayBeNoTail(const Candidate<Format> &c, const Acquisition<Format> &acquisition) {
  return !c.isLines() && c.gapAt > Format::Size && c.gapAt <= c.size() && acquisition.lastRun() != c.gapAt;
}

/// Its end byte comes twice: noise may stand before the true header, or a stray character behind the true end. That is
/// told where one stood behind the frame before it, too, and a gap stands before this one.
template <typename Format>
SBUS_IN_LINE bool endsTwice(const Candidate<Format> &c) {
  return holds(Rule::endsTwice) && c.bytes[c.size()] == c.end() && !(c.offBy == 1 && c.gapAt == 0);
}

/// More characters follow than noise, and no header.
template <typename Format>
SBUS_IN_LINE bool goesOn(const Candidate<Format> &c) {
  return holds(Rule::goesOn) && c.count > c.size() + MostNoise && c.bytes[c.size() + 1] != HeaderByte;
}

/// Index of a header behind an end byte within it: it may be the halves of two frames from there on. Size if nowhere.
/// Where the line's variant is not known, any end byte counts.
template <typename Format>
SBUS_IN_LINE int secondReading(const Candidate<Format> &c) {
  const uint8_t variant = c.isLines() || Format::Kinds == 1 ? c.variant : UnknownVariant;
  return holds(Rule::halves) ? innerHeader(c.bytes, Format::Size, variant) : Format::Size;
}

/// A gap after it may still make its place certain. Not where the part up to the second reading may be the rest of a
/// frame, and what follows one that lost as many characters: that part is short, and more than noise stands before it.
template <typename Format>
SBUS_IN_LINE bool mayBecomeCertain(const Candidate<Format> &c, int inner) {
  return holds(Rule::waits) && c.count <= c.size() && (inner >= Format::Size / 2 || c.offBy <= MostNoise);
}

/// A frame with further channels stands where a frame is expected, or at a gap: a noise character 2F straight before a
/// frame would else take that frame for its own. It is believed on a line whose variant is known only, and ends before a
/// header or a gap.
template <typename Format>
SBUS_IN_LINE Verdict judgeExtra(const Candidate<Format> &c, Acquisition<Format> &acquisition) {
  const bool isPlaced = c.offBy == 0 || c.gapAt == 0 || c.gapAt == Format::Size;
  if (!isPlaced || !c.isLines()) {
    if (isPlaced) {
      acquisition.forget();  // the first frame may follow without a gap
    }
    return Verdict::reject(Rejection::NotAtGap);
  }
  if (c.gapAt == Format::Size || (c.count > Format::Size && isHeaderNext(c))) {
    return Verdict::accept(true);
  }
  return c.count > Format::Size ? Verdict::reject(Rejection::GoesOn) : Verdict::wait();
}

/// What `filled` characters are on nearly all lines nearly always: the line's next frame, and no character more. Says
/// nothing but what the whole judgement would say, in 160 cycles less.
template <typename Format>
SBUS_IN_LINE bool isUsual(const uint8_t *bytes, int filled, int gapAt, uint8_t variant, bool isSure) {
  return filled == Format::Size && isSure && (gapAt == 0 || gapAt > Format::Size) && bytes[0] == HeaderByte &&
         areFlags(bytes[Format::Size - 2]) && endsVariant(bytes[Format::Size - 1], variant);
}

/// The whole judgement, the cheapest rules first.
template <typename Format>
SBUS_IN_LINE Verdict judge(const Candidate<Format> &c, Acquisition<Format> &acquisition) {
  if (hasGapInside(c)) {
    return Verdict::reject(Rejection::GapInside, c.gapAt);
  }
  if (Format::HasExtra && c.bytes[0] == ExtraHeader) {
    return judgeExtra(c, acquisition);
  }
  // Where it ends: at a gap, before a header, or as the line's frames are known to end.
  const bool isGapAfter = c.isGapAfter();
  bool isAtGap = isGapAfter || c.isGapBefore();
  bool isPlaced = isAtGap && !mayBeNoTail(c, acquisition);
  bool isInTurn = false;
  if (!isGapAfter) {
    if (c.count <= c.size()) {
      if (holds(Rule::variant) && !c.isLines()) {
        return Verdict::wait();
      }
    } else if (!isHeaderNext(c)) {
      // Of two headers in a row the second may be the true one, or not: if the first is rejected, so are both.
      if (c.isLines()) {
        if (!isSlotNext(c) && (endsTwice(c) || goesOn(c))) {
          return Verdict::reject(Rejection::GoesOn, 2);
        }
      } else if (hasStray(c, acquisition)) {
        isAtGap = true;
        isPlaced = true;
      } else if (c.gapAt == 0 && c.count == c.size() + 1 && mayHaveStray(c)) {
        return Verdict::wait();
      } else {
        isInTurn = isSlotNext(c) && (acquisition.isInTurn(c.end()) || !holds(Rule::turn));
        if (!isInTurn) {
          return Verdict::reject(Rejection::GoesOn, 2);
        }
      }
    }
  }
  if (!c.isLines() && !acquisition.allows(isAtGap || isInTurn, c.offBy <= FirstOffBy)) {
    return Verdict::reject(Rejection::NotAtGap);
  }
  // Where its place is not certain it may be the halves of two frames.
  const int inner = isPlaced || c.isSure ? Format::Size : secondReading(c);
  if (inner < Format::Size) {
    return mayBecomeCertain(c, inner) ? Verdict::wait() : Verdict::reject(Rejection::SecondReading, inner);
  }
  return Verdict::accept(isPlaced || c.offBy == 0);
}

}  // namespace rules
}  // namespace sbus
