// The newest values of all channels, in memory that does not grow: some five minutes of 111 frames a second.

import { Flag, type Stretch } from './line';

export class History {
  static readonly capacity = 1 << 15;
  static readonly channels = 32;

  private readonly times = new Float64Array(History.capacity); // s
  private readonly values = new Float32Array(History.capacity * History.channels).fill(NaN);
  private readonly flags = new Uint8Array(History.capacity);
  private taken = 0; // since clear()

  clear(): void {
    this.taken = 0;
  }

  add(stretch: Stretch): void {
    const at = this.taken % History.capacity;
    this.times[at] = stretch.endUs / 1e6;
    this.flags[at] = stretch.flags;
    for (let i = 0; i < History.channels; i++) {
      this.values[at * History.channels + i] = i < stretch.channels.length ? stretch.channels[i] : NaN;
    }
    this.taken++;
  }

  // Samples are numbered from clear() on; the oldest may be gone.
  get end(): number {
    return this.taken;
  }

  get begin(): number {
    return Math.max(0, this.taken - History.capacity);
  }

  time(sample: number): number {
    return this.times[sample % History.capacity];
  }

  value(sample: number, channel: number): number {
    return this.values[(sample % History.capacity) * History.channels + channel];
  }

  failsafe(sample: number): boolean {
    return (this.flags[sample % History.capacity] & Flag.Failsafe) !== 0;
  }

  lost(sample: number): boolean {
    return (this.flags[sample % History.capacity] & Flag.LostFrame) !== 0;
  }

  switches(sample: number): [number, number] {
    const flags = this.flags[sample % History.capacity];
    return [flags & Flag.Channel17, (flags & Flag.Channel18) >> 1];
  }

  // The first sample that is not older.
  find(seconds: number): number {
    let low = this.begin;
    let high = this.end;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.time(middle) < seconds) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return low;
  }
}
