// Where a line comes from.

import type { Found, State } from '../messages';
import type { Remote } from './remote';

export interface Source {
  // Its name for the user.
  readonly title: string;

  // The USB device that it is, if that is known.
  readonly device?: string;

  // The line that it delivers.
  readonly line: Remote;

  // What is being done and how much of it, while that takes time; or ''.
  readonly progress?: string;

  // Bytes come only while it is open.
  readonly state: State;

  // Returns the line's time: all characters complete by then have come. Called for each picture.
  nowUs(): number;

  // True while its time stands still: it is paused, or at its end.
  readonly stands?: boolean;

  // The fault at its position, if it went there.
  readonly found?: Found;

  // True for the built-in receiver.
  readonly isSimulated?: boolean;

  // True if rows of numbers are expected, not S.Bus.
  readonly isBoard?: boolean;

  close(): void;
}
