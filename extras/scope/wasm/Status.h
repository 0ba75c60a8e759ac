// The figures of the whole line.
#pragma once

namespace scope {

// The page reads it, by border.mjs.
struct Status {
  double state;
  double showsLostFrame;
  double showsFailsafe;
  double ageUs;
  double linkQuality;  // percent; only for frames
  double framesPerSecond;
  double gapMinUs;
  double gapMeanUs;
  double gapMaxUs;
  double characters;
  double characterErrors;
  double frames;
  double lostFrames;
  double failsafeFrames;
  double rejectedByEnd;
  double rejectedByFlags;
  double rejectedByLength;
  double discardedBytes;
  double resyncs;
  double extraFrames;
  double rows;
  double otherLines;
  double garbled;
  double lateUs;        // that the PC is late; 0 if it is less than 0.1 s
  double lateReads;     // of a port: those that were 0.1 s late or more
  double quietUs;       // since the newest character
  double finding;       // of the last whole second of the line's time; -1 before the first is over
  double findingSoFar;  // of all that has come
};

}  // namespace scope
