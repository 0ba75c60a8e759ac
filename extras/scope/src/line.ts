// A line as the page sees it, wherever it is decoded.

import type { Kind, LinkState } from './border';
import type { Samples } from './messages';

export { Flag, Kind, LinkState, type Status } from './border';

// A piece of the line: a frame, or the bytes between two.
export interface Stretch {
  endUs: number;
  kind: Kind;
  flags: number;
  state: LinkState; // of the link to show, at its end
  channels: Float64Array; // raw values; of a Row, the numbers as printed
  readings: Float64Array; // what sensors measured within the last second; NaN: nothing; empty without any
  bytes: Uint8Array; // empty for a Row
  isTelemetry: boolean; // slots of S.BUS2, no frame
  why: string; // why it is no frame; '' for a frame
}

// Receives the stretches of a line.
export interface Sink {
  take(stretch: Stretch): void;
  // The line has jumped: all that was taken belongs to another place. `recalled`: the newest stretches before this one.
  jump(recalled: readonly Stretch[]): void;
  // Brings the history before the place that the line has jumped to.
  precede(samples: Samples): void;
}
