// WebAssembly's memory, as the page and its worker read it.

import { Enough, type Exports, type Finding, Kind, type LinkState, RecordReader, type Status, StatusReader, type Text, TransferSize } from './border';
import type { Picture } from './messages';

// A piece of the line: a frame, or the bytes between two.
export interface Stretch {
  beginUs: number; // of its first start bit
  endUs: number;
  lateUs: number; // it may have come this much earlier
  kind: Kind;
  flags: number;
  state: LinkState; // of the link to show, at its end
  channels: Float64Array; // raw values; of a Row, the numbers as printed
  readings: Float64Array; // what sensors measured within the last second; NaN: nothing; empty without any
  bytes: Uint8Array; // empty for a Row
  isTelemetry: boolean; // slots of S.BUS2, no frame
  why: string; // why it is no frame; '' for a frame
}

const channels = 32;

// Debian 13's C++ library writes to standard error before it aborts. The page has none: WASI's error ENOSYS is 52.
const noSystem = new Proxy({}, { get: () => () => 52 });
export const imports: WebAssembly.Imports = { wasi_snapshot_preview1: noSystem };

export class Native {
  private readonly text = new TextDecoder();

  protected constructor(readonly calls: Exports) {}

  // Takes an instance. `isNew`: not one whose memory is replaced.
  static of(instance: WebAssembly.Instance, isNew = true): Native {
    const calls = instance.exports as unknown as Exports;
    if (isNew) {
      calls._initialize();
    }
    return new Native(calls);
  }

  // Opens a port; a board's carries text, 8N1.
  openPort(nowUs: number, baud: number, board: boolean): void {
    this.calls.openPort(nowUs, baud, Number(board));
  }

  received(bytes: Uint8Array, nowUs: number): void {
    this.transfer(bytes, (count) => this.calls.received(count, nowUs));
  }

  receivedBad(nowUs: number): void {
    this.calls.receivedBad(nowUs);
  }

  // Hands over all that has come by `nowUs`, as records. `feed` hands over a recording's next part.
  records(nowUs: number, take: (records: Uint8Array) => void, feed = (): void => undefined): void {
    for (let count = Enough; count >= Enough || this.calls.needsMore(); ) {
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
    const stretches: Stretch[] = [];
    this.each(records, (record) => stretches.push(this.stretch(record)));
    return stretches;
  }

  // Marks the records from now on at which a condition (Core.condition()) becomes true. Returns true if it
  // may become true while nothing comes.
  watchFor(steps?: Uint8Array): boolean {
    let needsTime = this.calls.watchFor(0);
    this.transfer(steps ?? new Uint8Array(), (size) => (needsTime = this.calls.watchFor(size)));
    return needsTime !== 0;
  }

  status(nowUs: number): Status {
    return new StatusReader(new DataView(this.calls.memory.buffer), this.calls.status(nowUs)).copy();
  }

  findingText(finding: Finding): string {
    return this.words(this.calls.findingText(finding));
  }

  findingRemedy(finding: Finding): string {
    return this.words(this.calls.findingRemedy(finding));
  }

  // Begins or ends a recording.
  record(on: boolean): void {
    this.calls.record(Number(on));
  }

  // Returns what was recorded since the last call.
  recorded(): string {
    return this.words(this.calls.takeRecorded());
  }

  // Returns what a picture says of the line at `us`.
  picture(us: number): Pick<Picture, 'us' | 'status' | 'travel' | 'telemetry' | 'recorded'> {
    const travel = Array.from({ length: channels }, (_, i) => this.travel(i));
    return { us, status: this.status(us), travel, telemetry: this.telemetry(us), recorded: this.recorded() };
  }

  private travel(channel: number): [number, number] | undefined {
    const at = this.calls.travel(channel);
    return at === 0 ? undefined : (Array.from(this.doubles(at, 2)) as [number, number]);
  }

  // See Picture.
  private telemetry(nowUs: number): string[] {
    return this.words(this.calls.telemetry(nowUs)).split('\n').filter(Boolean);
  }

  // Copies bytes to WebAssembly in parts, and calls `call` with the size of each.
  transfer(bytes: Uint8Array, call: (count: number) => void): void {
    const at = this.calls.transferBuffer();
    for (let from = 0; from < bytes.length; from += TransferSize) {
      const part = bytes.subarray(from, from + TransferSize);
      new Uint8Array(this.calls.memory.buffer, at).set(part);
      call(part.length);
    }
  }

  doubles(at: number, count: number): Float64Array {
    return new Float64Array(this.calls.memory.buffer, at, count);
  }

  words(at: Text): string {
    return this.wordsIn(new Uint8Array(this.calls.memory.buffer, at));
  }

  private wordsIn(bytes: Uint8Array): string {
    return this.text.decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  private taken(count: number): Uint8Array {
    const records = new Uint8Array(this.calls.memory.buffer, this.calls.records(), count * RecordReader.size).slice();
    this.calls.takenRecords();
    return records;
  }

  // Hands over each record, which is valid during the call: a recording may have 5 million.
  each(records: Uint8Array, take: (record: RecordReader) => void): void {
    const record = new RecordReader(new DataView(records.buffer));
    for (; record.at < records.length; record.at += RecordReader.size) {
      take(record);
    }
  }

  private stretch(record: RecordReader): Stretch {
    const { beginUs, endUs, lateUs, kind, flags, state } = record;
    return {
      beginUs, endUs, lateUs, kind, flags, state,
      channels: record.channels.slice(0, record.channelCount),
      readings: record.readings.slice(0, record.readingCount),
      bytes: record.bytes.slice(0, record.size),
      isTelemetry: record.slots > 0,
      why: kind === Kind.NoFrame ? this.wordsIn(record.why) : '',
    };
  }
}
