// Compares two lines, A and B, by their records.

import { RecordReader, TransferSize } from '../border';
import type { Comparison } from '../messages';
import type { Native } from '../native';
import type { Decoder } from './decoder';

const mostBytes = Math.floor(TransferSize / RecordReader.size) * RecordReader.size;

export class Comparing {
  // `native`: compares. `laterUs`: how much later B's time 0 is.
  constructor(
    private readonly native: Native,
    laterUs: number,
  ) {
    native.calls.compare(laterUs);
  }

  // Takes the next records of a line, 0 or 1.
  take(side: number, records: Uint8Array): void {
    for (let at = 0; at < records.length; at += mostBytes) {
      this.native.transfer(records.subarray(at, at + mostBytes), (size) => this.native.calls.compareRecords(side, size));
    }
  }

  // No other record of that line comes up to this time of it.
  knownUntil(side: number, us: number): void {
    this.native.calls.comparedUntil(side, us);
  }

  // Returns what was found so far, or at the end of both.
  found(atEnd = false): Comparison {
    return JSON.parse(this.native.words(this.native.calls.comparison(Number(atEnd))));
  }
}

// Compares recordings while B is decoded: A, which may be at another place, is decoded once more, as far as B.
export class Beside {
  constructor(
    private readonly comparing: Comparing,
    private readonly a: Decoder,
    private readonly endUs: number, // of A
    private readonly laterUs: number,
  ) {}

  // Takes the next records of B.
  take(records: Uint8Array): void {
    this.comparing.take(1, records);
  }

  // B is decoded up to there. Returns false at the time `hurry`, in ms: A is not that far yet.
  follow(us: number, hurry: number): boolean {
    const isThere = this.toA(us + this.laterUs, hurry);
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
