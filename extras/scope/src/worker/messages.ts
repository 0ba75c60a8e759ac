// The messages between the page and what decodes a line for it: mostly a worker.

import type { Bookmark } from '../bookmarks';
import type { Comparison } from '../comparison';
import type { Setting, Simulation } from '../core';
import type { Fault, FaultMap, Flight, Found, Span } from '../faults';
import type { Finding } from '../border';
import type { Samples } from '../history';
import type { Status } from '../line';
import type { Problem } from '../source/Source';
import type { State } from './connection';

type Travel = [number, number] | undefined;

// Among the ports that this page may use, in the browser's order; a SerialPort cannot be sent to a worker.
export interface PortPlace {
  index: number;
  count: number;
  ids: string;
}

// What a live line is opened with.
export type Opening =
  | { kind: 'simulated'; simulation: Simulation; port: Setting }
  | { kind: 'port'; place: PortPlace; isBoard: boolean; baud: number };

// Asks a worker for a live line, which answers at the port that comes with it.
export interface Live {
  kind: 'live';
  wasm: Uint8Array;
  opening: Opening;
  id: number;
  beside?: number; // the line, open there, with which it is compared
}

export type Request =
  | { kind: 'open'; wasm: Uint8Array; file: File } // a recording
  | { kind: 'advance'; id: number; us: number } // all characters complete by then; of a port, all that have come
  | { kind: 'seek'; id: number; us: number } // as if it had been played up to there
  | { kind: 'fault'; id: number; us: number; at?: Span; only?: Fault; back: boolean } // to the next one after `us`, or after the fault `at`
  | { kind: 'report' } // of a recording whose flight is known
  | { kind: 'event'; id: number; us: number; steps: Uint8Array; afterUs: number } // to so much after the next one after `us`
  | { kind: 'sensors'; sensors: Uint8Array } // see Sensors.bytes; a recording is decoded from its beginning once more
  | { kind: 'compare'; id: number; file: File } // of a recording: with another one, which can be read
  | { kind: 'wire'; fromUs: number; toUs: number; columns: number } // of a capture
  | { kind: 'use'; setting: Setting } // of a live line
  | { kind: 'cutWire'; cut: boolean }
  | { kind: 'replugged'; place: PortPlace }
  | { kind: 'resetMarks' }
  | { kind: 'watch'; steps?: Uint8Array } // marks the events of this condition, or none
  | { kind: 'record'; on: boolean }
  | { kind: 'close' }; // a live line

// What a live line comes from.
export interface LiveState {
  title?: string;
  state: State;
  problem?: Problem;
  isUnplugged?: boolean;
  events?: ReadonlyMap<string, number>; // at the port: counts by cause
  note: string; // the setting that is being tried, or what the trials found
  round?: Finding; // of the last round of trials
}

// A part of a capture's wire: its edges if they are few, else the levels of each column.
export interface Wire {
  kind: 'wire';
  fromUs: number;
  toUs: number;
  bitUs: number;
  edges?: Float64Array; // us; each leads to the other level, the first to `isHigh`
  isHigh: boolean;
  levels?: Uint8Array; // 1 low, 2 high, 3 both, 0 not known
  characters: { us: number; value: number; parityWrong: boolean; stopWrong: boolean }[]; // if they are few
  keptUs: number; // up to when edges are kept; 0: all are
}

// The line as it is at `us`.
export interface Picture {
  kind: 'picture';
  id: number; // of the request
  jumped: boolean; // what came before is in it, or follows as the past
  isPreview?: boolean; // of a place that is not decoded yet: the line before it is not known, and the picture follows
  us: number;
  status: Status;
  travel: Travel[]; // by channel
  telemetry: string[]; // see Line.telemetry()
  records: Uint8Array[]; // see Native.stretchesIn()
  recorded: string;
  faults: number; // at `us`: bits 1 << Fault
  found?: Found | null; // the fault at `us`; null: no further fault in that direction
  event?: number | null; // when the condition became true; null: it does not any more
  live?: LiveState; // not of a recording
  compared?: Comparison; // so far, of a line beside another one: if there is news
}

export type Answer =
  | { kind: 'progress'; part: number } // of the file that is read, or of the line that is decoded to get to a place; 0..1
  | { kind: 'failed'; error: string; remedy?: string }
  | { kind: 'refused' } // the worker does not find the port, or the line beside it
  | { kind: 'opened'; lengthUs: number; carrier: string; note?: string; zeroUs?: number; bookmarks?: Bookmark[]; picture: Picture } // bookmarks: of a recording as a plain text
  | Picture
  | Wire
  | { kind: 'faults'; map: FaultMap }
  | { kind: 'flight'; flight: Flight } // once all is decoded, of a recording with frames
  | { kind: 'compared'; id: number; comparison?: Comparison } // none: they have no frame in common
  | { kind: 'report'; html: string }
  | { kind: 'past'; id: number; samples: Samples } // of the history, before the picture of a seek
  | { kind: 'recording'; us: number } // it has begun: its times count from then
  | { kind: 'recorded'; text: string }; // the end of it
