// Compares two live lines while they run.

import { RecordReader, TransferSize } from '../border';
import type { Comparison } from '../messages';
import type { Native } from '../native';
import { Throttle } from '../throttle';

const tellingMs = 500;
const mostBytes = Math.floor(TransferSize / RecordReader.size) * RecordReader.size;

export class Comparing {
  private readonly telling = new Throttle(tellingMs);

  // `laterUs`: how much later the second line's time 0 is.
  constructor(
    private readonly native: Native,
    laterUs: number,
  ) {
    native.calls.compareLive(laterUs);
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

  // Returns what was found so far, twice a second; else undefined.
  news(): Comparison | undefined {
    return this.telling.due ? JSON.parse(this.native.words(this.native.calls.comparisonSoFar())) : undefined;
  }
}
