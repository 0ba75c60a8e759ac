// What a comparison of two lines has found: by WebAssembly, as sbus compare has it. Of a pair, the first is of A.

type Pair = [number, number];

export interface Comparison {
  frames: Pair;
  alone: Pair; // before the other's first frame, or after its last
  lost: Pair; // by it: only the other has them, or only it has the flag
  spans: Pair; // in which these are
  late: Pair; // not compared: the PC was late, or the delay not known yet
  longest: [fromUs: number, toUs: number, frames: number][][]; // of them, by who lost them
  same: number; // frames
  different: number;
  delays: number; // frames that have told the delay; 0: it is not known
  medianUs: number; // the delay: how much later B is
  leastUs: number;
  mostUs: number;
  driftPpm: number; // by which the delay grows
  atZeroUs: number; // the delay at A's time 0
  laterUs: number; // how much later B's time 0 is, as far as that is known; it is a part of the delay
  evidence: string; // of the delay
  areDelaysLate: boolean; // all of them are of frames that came while the PC was late
}

// Returns B's time at a time of A, in us.
export const otherUs = ({ atZeroUs, driftPpm, laterUs }: Comparison, us: number): number => us + atZeroUs + (driftPpm * us) / 1e6 - laterUs;
