// A second recording, B, beside the one that is played, A: it is at the same moment, by the delay that was measured.

import { type Comparison, otherUs } from '../comparison';
import type { Core } from '../core';
import { History, isSample, type Samples } from '../history';
import type { Sink, Stretch } from '../line';
import type { RecordingSource } from './recording';
import { Remote } from './remote';

const jumpUs = 2000000; // what is further away is sought
let ids = 0;

export class Second implements Sink {
  readonly history = new History();
  private readonly id = ++ids;
  private askedUs = NaN;

  private constructor(
    private readonly first: RecordingSource,
    private readonly line: Remote,
    readonly name: string,
    file: File,
  ) {
    first.line.ask({ kind: 'compare', id: this.id, file });
  }

  // Reads the file. Throws an Error that says what is wrong with the recording, a Problem, or the reason of `signal`.
  static async read(core: Core, file: File, first: RecordingSource, signal: AbortSignal): Promise<Second> {
    const line = await Remote.read(core, file, signal, () => undefined);
    return new Second(first, line, file.name, file);
  }

  // Returns undefined before it is made, null if both have no frame in common.
  get comparison(): Comparison | null | undefined {
    const { compared } = this.first.line;
    return compared?.id === this.id ? (compared.comparison ?? null) : undefined;
  }

  // Goes to the moment at which A is. Call it for each picture.
  follow(): void {
    const { comparison, line, askedUs } = this;
    if (comparison) {
      const us = Math.min(Math.max(otherUs(comparison, this.first.line.us), 0), line.lengthUs + 1000);
      this.askedUs = us;
      if (us >= askedUs && us < askedUs + jumpUs) {
        line.wantedUs = us;
      } else {
        line.seek(us);
      }
      line.advance(us, this);
    }
  }

  take(stretch: Stretch): void {
    if (isSample(stretch)) {
      this.history.add(stretch);
    }
  }

  jump(): void {
    this.history.clear();
  }

  precede(samples: Samples): void {
    this.history.precede(samples);
  }

  close(): void {
    this.line.close();
  }
}
