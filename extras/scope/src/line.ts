// A line as the page sees it, wherever it is decoded.

import type { Samples } from './history';

export enum LinkState {
  NeverSeen,
  Ok,
  Lossy,
  Failsafe,
  Stale,
}

export enum Kind {
  Frame, // 16 channels and two switches
  Frame24,
  Extra, // header 2F: CH17..CH32
  NoFrame,
  Row, // numbers that a board has printed
  Silence, // nothing, but an event
}

export enum Flag {
  Channel17 = 1,
  Channel18 = 2,
  LostFrame = 4,
  Failsafe = 8, // by the frame's flag, or by too many lost frames in a row
  ByLosses = 128, // by these
  Event = 16, // a condition becomes true here
  HasFlags = 64, // a row with columns for failsafe and lost frame
  HasSwitches = 32, // a row with columns for CH17 and CH18
}

// A piece of the line: a frame, or the bytes between two.
export interface Stretch {
  endUs: number;
  kind: Kind;
  flags: number;
  state: LinkState; // of the link to show, at its end
  channels: Float64Array; // raw values; of a Row, the numbers as printed
  bytes: Uint8Array; // empty for a Row
  isTelemetry: boolean; // slots of S.BUS2, no frame
  why: string; // why it is no frame; '' for a frame
}

export const statusNames = [
  'state', 'showsLostFrame', 'showsFailsafe', 'ageUs',
  'linkQuality', // percent; only for frames
  'framesPerSecond', 'gapMinUs', 'gapMeanUs', 'gapMaxUs', 'characters', 'characterErrors', 'frames',
  'lostFrames', 'failsafeFrames', 'rejectedByEnd', 'rejectedByFlags', 'rejectedByLength', 'discardedBytes', 'resyncs', 'overflows',
  'extraFrames', 'rows', 'otherLines', 'garbled',
  'lateUs', // that the PC is late; 0 if it is less than 0.1 s
  'lateReads', // of a port: those that were 0.1 s late or more
  'quietUs', // since the newest character
  'finding', // of the last whole second of the line's time; -1 before the first is over
  'findingSoFar', // of all that has come
] as const;
export type Status = Record<(typeof statusNames)[number], number>;

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
  // Returns the slots that came within the last second ("slots 0, 1"), then what sensors measured in it ("receiver voltage
  // 4.6 V"); empty without telemetry.
  telemetry(): readonly string[];
  // Returns the lowest and highest value of a channel, from 0 on; undefined before the first value.
  travel(channel: number): [number, number] | undefined;
  resetMarks(): void;

  // Begins a recording.
  record(): void;
  // Returns what was recorded since the last call.
  takeRecorded(): string;
  // Ends the recording. Returns the rest of it.
  endRecorded(): Promise<string>;
}
