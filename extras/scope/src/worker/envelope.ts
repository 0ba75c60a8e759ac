// Collects the least and greatest values along a recording, in memory that does not grow.

import type { Record } from '../border';
import { History, isSample } from '../history';
import type { Envelope } from '../messages';

const mostParts = 8192; // 0.4 s of an hour
const leastUs = 1000; // of a part

export class EnvelopeIndex {
  readonly envelope: Envelope;

  constructor(endUs: number) {
    const parts = Math.min(Math.ceil(endUs / leastUs), mostParts);
    const size = History.columns * parts;
    this.envelope = {
      partUs: endUs / parts, low: new Float32Array(size).fill(Infinity), high: new Float32Array(size).fill(-Infinity), flags: new Uint8Array(parts), ends: [0, 0],
    };
  }

  // Takes the next stretch of the line.
  take(record: Record): void {
    if (!isSample(record)) {
      return;
    }
    const { partUs, flags } = this.envelope;
    const part = Math.min(Math.floor(record.endUs / partUs), flags.length - 1);
    flags[part] |= record.flags;
    this.put(0, part, record.channels, record.channelCount);
    this.put(History.channels, part, record.readings, record.readingCount);
  }

  // After the last one.
  finish(): Envelope {
    const { low, high, flags, ends } = this.envelope;
    for (let at = 0; at < History.channels * flags.length; at++) {
      if (low[at] <= high[at]) {
        ends[0] = Math.min(ends[0], low[at]);
        ends[1] = Math.max(ends[1], high[at]);
      }
    }
    return this.envelope;
  }

  private put(column: number, part: number, values: Float64Array, count: number): void {
    const { low, high, flags: { length: parts } } = this.envelope;
    for (let i = 0, at = column * parts + part; i < count; i++, at += parts) {
      low[at] = values[i] < low[at] ? values[i] : low[at];
      high[at] = values[i] > high[at] ? values[i] : high[at];
    }
  }
}
