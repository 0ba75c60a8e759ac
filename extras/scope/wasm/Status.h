// The figures of the whole line.
#pragma once

namespace scope {

// Its fields, each a double.
#define SCOPE_STATUS(field)                                                                                           \
  field(state) field(showsLostFrame) field(showsFailsafe) field(ageUs) field(linkQuality) field(framesPerSecond)      \
      field(gapMinUs) field(gapMeanUs) field(gapMaxUs) field(characters) field(characterErrors) field(frames)         \
          field(lostFrames) field(failsafeFrames) field(rejectedByEnd) field(rejectedByFlags) field(rejectedByLength) \
              field(discardedBytes) field(resyncs) field(overflows) field(extraFrames) field(rows) field(otherLines)  \
                  field(garbled) field(lateUs) field(lateReads) field(quietUs) field(finding) field(findingSoFar)

struct Status {
#define SCOPE_FIELD(name) double name = 0;
  SCOPE_STATUS(SCOPE_FIELD)
#undef SCOPE_FIELD
};

}  // namespace scope
