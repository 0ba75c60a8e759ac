// Characters for the rules of FrameRules.h, and the rules' verdict as a text.
#pragma once

#include <string>

#include "Bytes.h"
#include "KnownFrames.h"
#include "sbus/FrameRules.h"

constexpr int Far = 255;  // Case::gapAt without a gap

// A frame and what follows it. By default it is where a frame is expected, on a line of its variant.
struct Case {
  Bytes bytes;
  int gapAt = Far;
  int offBy = 0;
  bool isInSync = true;
  bool hasLineVariant = true;
  bool isGapCertain = true;
  sbus::Silence inside = sbus::Silence::Unknown;  // the longest gap inside before the newest
  bool beginsWide = false;
  bool isGapWide = false;

  template <typename Format = sbus::Frame16>
  sbus::Candidate<Format> candidate() const {
    const sbus::Silence gap = isGapWide      ? sbus::Silence::Wide
                              : isGapCertain ? sbus::Silence::Gap
                                             : sbus::Silence::Likely;
    return {bytes.data(), static_cast<int>(bytes.size()), gapAt, gap, inside, beginsWide || (isInSync && offBy == 0), sbus::variantOfEnd(bytes[24]),
            hasLineVariant ? sbus::variantOfEnd(bytes[24]) : sbus::UnknownVariant, offBy, isInSync && offBy == 0};
  }
};

inline const Bytes Plain = bytesOf(plainFrame(1));
inline const Bytes Failsafe = bytesOf(FailsafeFrame);  // allows a false sync at 23

// Returns a line of which nothing has been seen yet.
template <typename Format = sbus::Frame16>
sbus::FrameSizeCheck<Format> noneSeen() {
  sbus::FrameSizeCheck<Format> acquisition;
  acquisition.reset();
  return acquisition;
}

// Returns a line on which two gaps have been seen, `run` characters apart.
inline sbus::FrameSizeCheck<sbus::Frame16> twoGaps(unsigned run) {
  sbus::FrameSizeCheck<sbus::Frame16> acquisition = noneSeen();
  acquisition.gap(0, true);
  acquisition.characters(run);
  acquisition.gap(static_cast<int>(run), true);
  return acquisition;
}

// Returns a line whose sender stretches frames.
inline sbus::FrameSizeCheck<sbus::Frame16> stretching() {
  sbus::FrameSizeCheck<sbus::Frame16> acquisition = noneSeen();
  acquisition.stretchedFrame();
  acquisition.stretchedFrame();
  return acquisition;
}

// Returns "accept", "aligned", "wait", or why it is rejected and after how many characters the search continues.
template <typename Format = sbus::Frame16>
std::string judged(const Case &c, sbus::FrameSizeCheck<Format> acquisition = noneSeen<Format>()) {
  static const char *const names[] = {"no end", "flags", "gap inside", "goes on", "not at gap", "false sync"};
  const sbus::Verdict verdict = sbus::rules::judge(c.candidate<Format>(), acquisition);
  return verdict.isAligned() ? "aligned"
         : verdict.isAccepted() ? "accept"
         : verdict.isOpen()     ? "wait"
                                : names[static_cast<unsigned>(verdict.why())] + (" " + std::to_string(verdict.skip()));
}
