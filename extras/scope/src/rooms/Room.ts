// A part of the page that has to do with the line.

import type { Status } from '../border';
import type { Stretch } from '../native';
import type { Source } from '../source/Source';
import type { Unit } from '../unit';

// What a picture shows of the line.
export interface Shown {
  source: Source;
  nowUs: number;
  status: Status;
  newest?: Stretch; // frame or row
  unit: Unit;
}

export interface Room {
  // What it draws for each picture, by the words that tell of its failure.
  readonly views: Record<string, (shown: Shown) => void>;
  // The line ends.
  leave?(): void;
  // Another line begins.
  enter?(source: Source): void;
  // Redraws what depends on the theme.
  repaint?(): void;
}
