// What the page and its worker tell each other. Everything that both know of a line's data is here, so that no other module has to
// know another for it.

import type { Finding, Status } from './border';

// How serial lines are set.
export interface Setting {
  baud: number;
  inverted: boolean;
}

// A simulated receiver.
export interface Simulation {
  calibration: boolean;
  channels: 16 | 24 | 32;
  noise: number; // disturbances a second
  line: Setting;
}

// What is wrong, and what to do.
export interface Problem {
  text: string;
  remedy: string;
}

// Of a source or a port: worker/connection.ts.
export type State = 'closed' | 'choosing' | 'opening' | 'open' | 'reopening' | 'failed';

// Frames or rows, the oldest first.
export interface Samples {
  times: Float64Array; // s
  values: Float64Array; // History.columns of each
  flags: Uint8Array;
}

// A whole recording, in parts of equal length: what is drawn where frames are closer than pixels.
export interface Envelope {
  partUs: number;
  low: Float32Array; // by History.columns, then by part; Infinity: nothing
  high: Float32Array; // likewise; -Infinity
  flags: Uint8Array; // of any frame of a part
  ends: [number, number]; // of all channels
}

// Of a recording.
export enum Fault {
  Failsafe,
  NoPulses, // 0 on CH1 to CH4, without a flag
  LostFrame, // without failsafe
  Damage,
  NoFrames,
  Late, // the PC was late: what the line did is not known
}

export const faults = [Fault.Failsafe, Fault.NoPulses, Fault.LostFrame, Fault.Damage, Fault.NoFrames, Fault.Late];
export const faultNames = ['failsafe', 'no pulses', 'lost frames', 'damaged bytes', 'no frames', 'PC late'];

export const binCount = 512; // of a recording, whatever its length

// Returns the longest time without a frame that is no silence, as for sbus summary; for rows, the time of three of them.
export const silenceUs = (isRow: boolean, meanUs: number): number => (isRow ? Math.max(1500000, 3 * meanUs) : 100000);

// Where a fault begins and ends; damage in quick succession is one.
export interface Span {
  fault: Fault;
  fromUs: number;
  toUs: number;
}

export interface Found extends Span {
  number: number; // among all faults, from 1 on
}

// The faults along a recording, as far as it is decoded.
export interface FaultMap {
  us: number; // decoded up to here
  isComplete: boolean;
  bins: Uint8Array; // 1 << Fault; binCount of them are the whole recording
  damaged: Float32Array; // of each bin, in us
  counts: number[]; // of spans, by Fault
}

// A part of a recording: from and to, in us; the share of its frames that was lost, 0..1; and what there was, a FlightKind.
export type FlightPart = [number, number, number, number];

// A whole recording, as sbus summary has it: wasm/Flight.cpp.
export interface Flight {
  severity: number; // line::FlightVerdict::Severity
  text: string;
  fromUs: number;
  toUs: number;
  frames: number;
  lostFrames: number;
  failsafeFrames: number;
  missing: number;
  framesPerSecond: number;
  discardedBytes: number;
  characterErrors: number;
  spans: { count: number; us: number; longest: [number, number, string][] }[]; // by FlightKind; the longest: from, to, in us; which channels
  worst: FlightPart[]; // seconds, the worst first
  strip: FlightPart[];
}

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
}

// Asks a worker for a recording, which answers at the port that comes with it; of a capture, by this signal.
export interface Open {
  kind: 'open';
  wasm: Uint8Array;
  file: File;
  signal?: string;
}

export type Request =
  | { kind: 'advance'; id: number; us: number } // all characters complete by then; of a port, all that have come
  | { kind: 'seek'; id: number; us: number } // as if it had been played up to there
  | { kind: 'fault'; id: number; us: number; at?: Span; only?: Fault; back: boolean } // to the next one after `us`, or after the fault `at`
  | { kind: 'report' } // of a recording whose flight is known
  | { kind: 'event'; id: number; us: number; steps: Uint8Array; afterUs: number } // to so much after the next one after `us`
  | { kind: 'sensors'; sensors: Uint8Array } // see Sensors.bytes; a recording is decoded from its beginning once more
  | { kind: 'wire'; fromUs: number; toUs: number; columns: number } // of a capture
  | { kind: 'use'; setting: Setting } // of a live line
  | { kind: 'cutWire'; cut: boolean }
  | { kind: 'replugged'; place: PortPlace }
  | { kind: 'resetMarks' }
  | { kind: 'watch'; steps?: Uint8Array } // marks the events of this condition (Flag.Event) from now on, or none
  | { kind: 'record'; on: boolean }
  | { kind: 'close' };

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
  us: number;
  status: Status;
  travel: ([number, number] | undefined)[]; // by channel: the lowest and highest value
  // The slots that came within the last second ("slots 0, 1"), then what sensors measured in it: its place among a stretch's readings,
  // name, value and unit, with tabs between. Empty without telemetry.
  telemetry: string[];
  records: Uint8Array[]; // see Native.stretchesIn()
  recorded: string;
  faults: number; // at `us`: bits 1 << Fault
  found?: Found | null; // the fault at `us`; null: no further fault in that direction
  event?: number | null; // when the condition became true; null: it does not any more
  live?: LiveState; // not of a recording
  missedUs?: number; // when the condition first became true in records that are not kept: the page was in the background
}

export type Answer =
  | { kind: 'progress'; part: number } // of the file that is read, or of the line that is decoded to get to a place; 0..1
  | { kind: 'failed'; error: string }
  | { kind: 'refused' } // the worker does not find the port
  // Of a file: what carries the line in a capture; its signals with S.Bus, that one first; what a user should know; what is wrong with its bytes, and what to do; its own time at time 0, not above 0; when time 0 was, in us since
  // 1970; whether its times are the line's.
  | { kind: 'opened'; lengthUs: number; carrier: string; signals?: string[]; note?: string; damage?: string[]; zeroUs?: number; startUs?: number; hasTimes: boolean; picture: Picture }
  | Picture
  | Wire
  | { kind: 'faults'; map: FaultMap }
  | { kind: 'envelope'; envelope: Envelope } // once all is decoded
  | { kind: 'flight'; flight: Flight } // once all is decoded, of a recording with frames
  | { kind: 'report'; html: string }
  | { kind: 'past'; id: number; samples: Samples } // of the history, before the picture of a seek
  | { kind: 'recorded'; text: string }; // the end of it
