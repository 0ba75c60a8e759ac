// What is wrong at places of a recording.

import type { Stretch } from './line';

export enum Fault {
  Failsafe,
  LostFrame, // without failsafe
  Damage,
  NoFrames,
}

export const faults = [Fault.Failsafe, Fault.LostFrame, Fault.Damage, Fault.NoFrames];
export const faultNames = ['failsafe', 'lost frames', 'damaged bytes', 'no frames'];

export const binCount = 512; // of a recording, whatever its length

// What of a stretch tells a fault.
export interface Sample extends Pick<Stretch, 'endUs' | 'kind' | 'flags'> {
  damagedUs: number; // since when bytes were damaged that came since the last frame; 0: none
}

// From where to where a fault is, or comes and goes.
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
  us: number; // decoded
  isComplete: boolean;
  bins: Uint8Array; // 1 << Fault; binCount of them are the whole recording
  counts: number[]; // of spans, by Fault
}

// A longer time without a frame is a silence, as for sbus summary; three rows of a slow sketch are missing then.
export const silenceUs = (isRow: boolean, meanUs: number): number => (isRow ? Math.max(1500000, 3 * meanUs) : 100000);
