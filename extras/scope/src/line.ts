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
}

export enum Flag {
  Channel17 = 1,
  Channel18 = 2,
  LostFrame = 4,
  Failsafe = 8,
}

// A piece of the line: a frame, or the bytes between two.
export interface Stretch {
  endUs: number;
  kind: Kind;
  flags: number;
  channels: Float64Array; // raw; of a Row as it was printed
  bytes: Uint8Array; // empty for a Row
  isTelemetry: boolean; // it is no frame, but slots of S.BUS2
  why: string; // it is no frame
}

export const statusNames = [
  'state', 'ageUs',
  'linkQuality', // percent; of rows none
  'framesPerSecond', 'gapMinUs', 'gapMeanUs', 'gapMaxUs', 'characters', 'characterErrors', 'frames',
  'lostFrames', 'failsafeFrames', 'rejectedByEnd', 'rejectedByFlags', 'rejectedByLength', 'discardedBytes', 'resyncs', 'overflows',
  'extraFrames', 'rows', 'otherLines', 'garbled',
  'quietUs', // since the newest character
  'finding', // of the last whole second of the line's time; -1 before the first is over
  'findingSoFar', // of all that has come
] as const;
export type Status = Record<(typeof statusNames)[number], number>;

// What takes a line in.
export interface Sink {
  take(stretch: Stretch): void;
  // All that was taken belongs to another place of the line. These are the newest ones before it.
  jump(recalled: readonly Stretch[]): void;
  // The history before a place that was jumped to.
  precede(samples: Samples): void;
}

export interface Line {
  // Hands over all that has come by `nowUs`.
  advance(nowUs: number, sink: Sink): void;
  status(nowUs: number): Status;
  // What sensors have measured within the last second ("receiver voltage 4.6 V"), after the slots that came ("slots 0, 1"); none
  // without telemetry.
  telemetry(nowUs: number): readonly string[];
  // Returns the least and the most of a channel, from 0 on; undefined before the first value.
  travel(channel: number): [number, number] | undefined;
  resetMarks(): void;

  // From now on what comes is kept.
  record(): void;
  // What was recorded since this was last asked.
  takeRecorded(): string;
  // Ends the recording. Returns the rest of it.
  endRecorded(): Promise<string>;
}
