// A line as the page sees it, wherever it is decoded.

import type { Kind, LinkState, Status } from './border';
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

export interface Line {
  // Hands over all that has come by `nowUs`.
  advance(nowUs: number, sink: Sink): void;
  status(): Status;
  // True until the line before the place that it has jumped to is decoded: what the status counts, and the link
  // quality, is not known.
  readonly isPreview: boolean;
  // Returns the slots that came within the last second ("slots 0, 1"), then what sensors measured in it: its place among a
  // stretch's readings, name, value and unit, with tabs between. Empty without telemetry.
  telemetry(): readonly string[];
  // Returns the lowest and highest value of a channel, from 0 on; undefined before the first value.
  travel(channel: number): [number, number] | undefined;
  resetMarks(): void;

  // The line's time from which the newest recording counts.
  readonly recordingUs: number;
  // Begins a recording.
  record(): void;
  // Returns what was recorded since the last call.
  takeRecorded(): string;
  // Ends the recording. Returns the rest of it.
  endRecorded(): Promise<string>;
}
