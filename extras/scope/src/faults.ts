// The faults of a recording.

import type { Stretch } from './line';

export { FlightKind } from './border';

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

// The fields of a stretch by which faults are found.
export interface Sample extends Pick<Stretch, 'endUs' | 'kind' | 'flags'> {
  lateUs: number; // it may have come this much earlier
  damagedUs: number; // when the first damaged bytes since the last frame came; 0: none
}

// Where a fault begins and ends; faults in quick succession are one.
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
  spans: { count: number; us: number; longest: [number, number][] }[]; // by FlightKind; the longest: from, to, in us
  worst: FlightPart[]; // seconds, the worst first
  strip: FlightPart[];
}

const leastLateUs = 100000; // a read that is later shows that the PC was busy

// Returns whether the PC was late, and no silence, before a frame that came `afterUs` after the one before.
export const isLate = (afterUs: number, lateUs: number, limitUs: number): boolean => lateUs >= leastLateUs && afterUs <= limitUs + lateUs;

// Returns the longest time without a frame that is no silence, as for sbus summary; for rows, the time of three of them.
export const silenceUs = (isRow: boolean, meanUs: number): number => (isRow ? Math.max(1500000, 3 * meanUs) : 100000);
