// Where a line comes from.

import type { Setting } from '../core';
import type { Line } from '../line';
import type { State } from './connection';

// What is wrong, and what to do.
export interface Problem {
  text: string;
  remedy: string;
}

export interface Source {
  // What it is, for a person.
  readonly title: string;

  // What it is plugged in with, if that is known.
  readonly device?: string;

  // What comes of it.
  readonly line: Line;

  // What is awaited, while that takes time; or ''.
  readonly progress?: string;

  // Nothing can come unless it is open.
  readonly state: State;

  // The line's time: all that was through by then has come. Asked for each picture.
  nowUs(): number;

  // Its time stands still: it is paused, or at its end.
  readonly stands?: boolean;

  // The settings that its port can have, the one that is meant first; none, or one, if there is nothing to try.
  readonly settings: readonly Setting[];
  // Resolves once the port has that setting.
  use(setting: Setting): Promise<void>;

  // Rows of numbers are awaited, no S.Bus.
  readonly isBoard?: boolean;

  readonly problem?: Problem;

  // What has happened to the port, by cause.
  readonly events?: ReadonlyMap<string, number>;

  close(): void;
}
