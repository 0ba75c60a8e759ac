// WebAssembly's memory, as the page and its worker read it.

import type { Sample } from './faults';
import { Layout } from './layout';
import { Flag, Kind, LinkState, statusNames, type Status, type Stretch } from './line';

export type Exports = Record<string, (...values: number[]) => number> & { memory: WebAssembly.Memory };

// Debian 13's C++ library writes to standard error before it aborts. The page has none: WASI's error ENOSYS is 52.
const noSystem = new Proxy({}, { get: () => () => 52 });
export const imports: WebAssembly.Imports = { wasi_snapshot_preview1: noSystem };

const recordTypes = {
  endUs: 'double 1', lateUs: 'double 1', damagedUs: 'double 1', channels: 'double 32', kind: 'byte 1', flags: 'byte 1', channelCount: 'byte 1', size: 'byte 1',
  slots: 'byte 1', state: 'byte 1', bytes: 'byte 36', why: 'letter 88',
};
const statusTypes = Object.fromEntries(statusNames.map((name) => [name, 'double 1'])) as Record<keyof Status, string>;

export class Native {
  readonly layout: Layout;
  private readonly text = new TextDecoder();
  private readonly record: Record<keyof typeof recordTypes, number>;
  readonly recordSize: number;
  private readonly statusAt: Record<keyof Status, number>;
  private readonly enough: number;

  // Throws if the page and WebAssembly were not built together. `layout`: that of another instance.
  constructor(
    readonly calls: Exports,
    layout?: Layout,
  ) {
    this.layout = layout ?? new Layout(this.words(calls.layout()));
    this.layout.enumeration('LinkState', LinkState);
    this.layout.enumeration('Kind', Kind);
    this.layout.enumeration('Flag', Flag);
    this.record = this.layout.struct('Record', recordTypes);
    this.recordSize = this.layout.size('Record');
    this.statusAt = this.layout.struct('Status', statusTypes);
    this.enough = this.layout.constant('Enough');
  }

  // Hands over all that has come by `nowUs`, as records. `feed` hands over a recording's next part.
  records(nowUs: number, take: (records: Uint8Array) => void, feed = (): void => undefined): void {
    for (let count = this.enough; count >= this.enough || this.calls.needsMore(); ) {
      if (this.calls.needsMore()) {
        feed();
      }
      count = this.calls.advance(nowUs);
      if (count > 0) {
        take(this.taken(count));
      }
    }
  }

  // Returns once more the records that the page shows.
  recalled(): Uint8Array {
    return this.taken(this.calls.recall());
  }

  stretchesIn(records: Uint8Array): Stretch[] {
    return Array.from({ length: records.length / this.recordSize }, (_, i) => this.stretch(records, i * this.recordSize));
  }

  // Reads only the fields by which faults are found: a recording may have 5 million records.
  eachSample(records: Uint8Array, take: (sample: Sample) => void): void {
    const { record } = this;
    const view = new DataView(records.buffer);
    for (let at = 0; at < records.length; at += this.recordSize) {
      take({
        endUs: view.getFloat64(at + record.endUs, true),
        lateUs: view.getFloat64(at + record.lateUs, true),
        damagedUs: view.getFloat64(at + record.damagedUs, true),
        kind: view.getUint8(at + record.kind),
        flags: view.getUint8(at + record.flags),
      });
    }
  }

  // Marks the records from now on at which a condition (Core.condition()) becomes true. Returns true if it
  // may become true while nothing comes.
  watchFor(steps?: Uint8Array): boolean {
    let needsTime = this.calls.watchFor(0);
    this.transfer(steps ?? new Uint8Array(), (size) => (needsTime = this.calls.watchFor(size)));
    return needsTime !== 0;
  }

  status(nowUs: number): Status {
    const at = this.calls.status(nowUs);
    const view = new DataView(this.calls.memory.buffer);
    return Object.fromEntries(statusNames.map((name) => [name, view.getFloat64(at + this.statusAt[name], true)])) as Status;
  }

  travel(channel: number): [number, number] | undefined {
    const at = this.calls.travel(channel);
    return at === 0 ? undefined : (Array.from(this.doubles(at, 2)) as [number, number]);
  }

  // See Line.telemetry().
  telemetry(nowUs: number): string[] {
    return this.words(this.calls.telemetry(nowUs)).split('\n').filter(Boolean);
  }

  // Copies bytes to WebAssembly in parts, and calls `call` with the size of each.
  transfer(bytes: Uint8Array, call: (count: number) => void): void {
    const at = this.calls.transferBuffer();
    const size = this.layout.constant('TransferSize');
    for (let from = 0; from < bytes.length; from += size) {
      const part = bytes.subarray(from, from + size);
      new Uint8Array(this.calls.memory.buffer, at).set(part);
      call(part.length);
    }
  }

  doubles(at: number, count: number): Float64Array {
    return new Float64Array(this.calls.memory.buffer, at, count);
  }

  words(at: number): string {
    return this.wordsIn(new Uint8Array(this.calls.memory.buffer, at));
  }

  private wordsIn(bytes: Uint8Array): string {
    return this.text.decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  private taken(count: number): Uint8Array {
    const records = new Uint8Array(this.calls.memory.buffer, this.calls.records(), count * this.recordSize).slice();
    this.calls.takenRecords();
    return records;
  }

  private stretch({ buffer }: Uint8Array, at: number): Stretch {
    const { record } = this;
    const view = new DataView(buffer, at, this.recordSize);
    const kind = view.getUint8(record.kind);
    return {
      endUs: view.getFloat64(record.endUs, true),
      kind,
      flags: view.getUint8(record.flags),
      state: view.getUint8(record.state),
      channels: new Float64Array(buffer, at + record.channels, view.getUint8(record.channelCount)).slice(),
      bytes: new Uint8Array(buffer, at + record.bytes, view.getUint8(record.size)).slice(),
      isTelemetry: view.getUint8(record.slots) > 0,
      why: kind === Kind.NoFrame ? this.wordsIn(new Uint8Array(buffer, at + record.why)) : '',
    };
  }
}
