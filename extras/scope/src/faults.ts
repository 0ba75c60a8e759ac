// The faults of a recording.

import { Fault } from './messages';

export const faults = [Fault.Failsafe, Fault.NoPulses, Fault.LostFrame, Fault.Damage, Fault.NoFrames, Fault.Late];
export const faultNames = ['failsafe', 'no pulses', 'lost frames', 'damaged bytes', 'no frames', 'PC late'];

export const binCount = 512; // of a recording, whatever its length

// Returns the longest time without a frame that is no silence, as for sbus summary; for rows, the time of three of them.
export const silenceUs = (isRow: boolean, meanUs: number): number => (isRow ? Math.max(1500000, 3 * meanUs) : 100000);
