// Compares two lines, A and B, by their records.

import { RecordReader, TransferSize } from '../border';
import type { Comparison } from '../messages';
import type { Native } from '../native';

const mostBytes = Math.floor(TransferSize / RecordReader.size) * RecordReader.size;

export class Comparing {
  // `native`: compares. `laterUs`: how much later B's time 0 is.
  constructor(
    private readonly native: Native,
    readonly laterUs: number,
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
