// The messages between the page and the worker that plays a recording.

import type { FaultMap, Found, Span } from '../faults';
import type { Samples } from '../history';
import type { Status } from '../line';

export type Travel = [number, number] | undefined;

export type Request =
  | { kind: 'open'; wasm: Uint8Array; file: File }
  | { kind: 'advance'; id: number; us: number } // all characters complete by then
  | { kind: 'seek'; id: number; us: number } // as if it had been played up to there
  | { kind: 'fault'; id: number; us: number; at?: Span; back: boolean } // to the next one after `us`, or after the fault `at`
  | { kind: 'resetMarks' }
  | { kind: 'record'; on: boolean };

// The line as it is at `us`.
export interface Picture {
  kind: 'picture';
  id: number; // of the request
  jumped: boolean; // what came before is in it, or follows as the past
  us: number;
  status: Status;
  travel: Travel[]; // by channel
  telemetry: string[]; // see Line.telemetry()
  records: Uint8Array[]; // see Native.stretchesIn()
  recorded: string;
  faults: number; // at `us`: bits 1 << Fault
  found?: Found | null; // the fault at `us`; null: no further fault in that direction
}

export type Answer =
  | { kind: 'progress'; part: number } // of the file that is read, or of the line that is decoded to get to a place; 0..1
  | { kind: 'failed'; error: string }
  | { kind: 'opened'; lengthUs: number; carrier: string; picture: Picture }
  | Picture
  | { kind: 'faults'; map: FaultMap }
  | { kind: 'past'; id: number; samples: Samples } // of the history, before the picture of a seek
  | { kind: 'recorded'; text: string }; // the end of it
