// Compares two recordings, A and B, while B is decoded: A, which may be at another place, is decoded once more, as far as B.

import type { Comparison } from '../messages';
import type { Comparing } from './comparing';
import type { Decoder } from './decoder';

export class Beside {
  constructor(
    private readonly comparing: Comparing,
    private readonly a: Decoder,
    private readonly endUs: number, // of A
  ) {}

  // Takes the next records of B.
  take(records: Uint8Array): void {
    this.comparing.take(1, records);
  }

  // B is decoded up to there. Returns false at the time `hurry`, in ms: A is not that far yet.
  follow(us: number, hurry: number): boolean {
    const isThere = this.toA(us + this.comparing.laterUs, hurry);
    if (isThere) {
      this.comparing.knownUntil(0, this.a.us);
      this.comparing.knownUntil(1, us);
    }
    return isThere;
  }

  // After the last records of B. Returns undefined at the time `hurry`, in ms.
  finish(hurry: number): Comparison | undefined {
    return this.toA(this.endUs, hurry) ? this.comparing.found(true) : undefined;
  }

  private toA(us: number, hurry: number): boolean {
    return us <= this.a.us || this.a.advance(Math.min(us, this.endUs), (records) => this.comparing.take(0, records), hurry);
  }
}
