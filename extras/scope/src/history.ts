// The newest values of all channels, in memory of a fixed size: about five minutes of 111 frames a second.

import { Flag, Kind } from './border';
import type { Samples } from './messages';
import type { Stretch } from './native';
import { firstFrom } from './numbers';

export const keptSeconds = 240; // of a usual line, at least

export class History implements Samples {
  static readonly capacity = 1 << 15;
  static readonly seconds = 300;
  static readonly channels = 32;
  static readonly columns = 65; // the channels, then the readings of sensors

  readonly times = new Float64Array(History.capacity); // s
  readonly values = new Float64Array(History.capacity * History.columns);
  readonly flags = new Uint8Array(History.capacity);
  private taken = 0; // samples, since clear()

  clear(): void {
    this.taken = 0;
  }

  add(stretch: Stretch): void {
    put(this, this.taken % History.capacity, stretch);
    this.taken++;
  }

  // Puts older samples before all that are held.
  precede({ times, values, flags }: Samples): void {
    const held = this.taken;
    const count = Math.min(times.length, History.capacity - held);
    const from = times.length - count; // the oldest have no room
    if (count > 0) {
      this.times.copyWithin(count, 0, held);
      this.times.set(times.subarray(from));
      this.flags.copyWithin(count, 0, held);
      this.flags.set(flags.subarray(from));
      this.values.copyWithin(count * History.columns, 0, held * History.columns);
      this.values.set(values.subarray(from * History.columns));
      this.taken += count;
    }
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

  value(sample: number, column: number): number {
    return this.values[(sample % History.capacity) * History.columns + column];
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

  // Returns the first sample that is not older.
  find(seconds: number): number {
    return firstFrom(this.begin, this.end, (sample) => this.time(sample) < seconds);
  }

  // Returns the samples of a time, with the one before and the one after it: from `begin` to before `end`.
  around(from: number, to: number): { begin: number; end: number } {
    return { begin: Math.max(this.find(from) - 1, this.begin), end: Math.min(this.find(to) + 1, this.end) };
  }

  // Returns the sample nearest to that time; begin if there are no samples.
  nearest(seconds: number): number {
    const after = Math.min(this.find(seconds), Math.max(this.end - 1, this.begin));
    return after > this.begin && seconds - this.time(after - 1) < this.time(after) - seconds ? after - 1 : after;
  }
}

// Returns true for a row, and for a frame that has CH1.
export const isSample = ({ kind }: { kind: Kind }): boolean => kind !== Kind.NoFrame && kind !== Kind.Extra && kind !== Kind.Silence;

export function samplesOf(stretches: readonly Stretch[]): Samples {
  const count = stretches.length;
  const samples = { times: new Float64Array(count), values: new Float64Array(count * History.columns), flags: new Uint8Array(count) };
  stretches.forEach((stretch, i) => put(samples, i, stretch));
  return samples;
}

function put({ times, values, flags }: Samples, at: number, stretch: Stretch): void {
  times[at] = stretch.endUs / 1e6;
  flags[at] = stretch.flags;
  values.fill(NaN, at * History.columns, (at + 1) * History.columns);
  values.set(stretch.channels, at * History.columns);
  values.set(stretch.readings, at * History.columns + History.channels);
}
