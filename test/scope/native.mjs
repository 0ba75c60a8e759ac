// Runs the page's WebAssembly without the page: one line, decoded from its beginning.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { build, load } from './modules.mjs';

const { CharacterSize, EndUs, Enough, RecordReader, StatusReader, TransferSize } = await load('border');

export { EndUs };
export class Native {
  async load() {
    const noSystem = new Proxy({}, { get: () => () => 52 });
    const wasm = readFileSync(path.join(build, 'scope.wasm'));
    const { instance } = await WebAssembly.instantiate(wasm, { wasi_snapshot_preview1: noSystem });
    instance.exports._initialize();
    return Object.assign(this, { wasm: instance.exports });
  }

  words(at) {
    const bytes = new Uint8Array(this.wasm.memory.buffer, at);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  give(bytes, take) {
    new Uint8Array(this.wasm.memory.buffer, this.wasm.transferBuffer()).set(bytes);
    take(bytes.length);
  }

  status(us, name) {
    return new StatusReader(new DataView(this.wasm.memory.buffer), this.wasm.status(us))[name];
  }

  // Returns the records that have come by then: when, and of which kind. `take`: takes their bytes.
  advance(us, take) {
    const records = [];
    for (let count = Enough; count >= Enough || this.wasm.needsMore(); ) {
      if (this.wasm.needsMore()) {
        const size = this.wasm.recordingPart(this.fed);
        this.fed += size / CharacterSize;
        this.wasm.feed(size, Number(this.fed === this.wasm.recordingSize()));
      }
      count = this.wasm.advance(us);
      take?.(new Uint8Array(this.wasm.memory.buffer, this.wasm.records(), count * RecordReader.size).slice());
      const record = new RecordReader(new DataView(this.wasm.memory.buffer), this.wasm.records());
      for (const end = record.at + count * RecordReader.size; record.at < end; record.at += RecordReader.size) {
        records.push({ endUs: record.endUs, kind: record.kind });
      }
      this.wasm.takenRecords();
    }
    return records;
  }

  // Returns the figures of the whole recording, after open().
  flight() {
    const us = this.wasm.recordingLengthUs() + EndUs;
    const size = Math.floor(TransferSize / RecordReader.size) * RecordReader.size;
    this.wasm.beginFlight();
    this.advance(us, (records) => {
      for (let at = 0; at < records.length; at += size) this.give(records.subarray(at, at + size), (count) => this.wasm.flightRecords(count));
    });
    const counts = ['frames', 'lostFrames', 'failsafeFrames', 'discardedBytes', 'characterErrors'].map((name) => this.status(us, name));
    return JSON.parse(this.words(this.wasm.flightNumbers(...counts)));
  }

  travel(channel) {
    return Array.from(new Float64Array(this.wasm.memory.buffer, this.wasm.travel(channel), 2));
  }

  // Opens a recording at its beginning; advance() plays it.
  open(text) {
    const bytes = new TextEncoder().encode(text);
    this.give(bytes.subarray(0, 65536), (count) => this.wasm.openFile(count));
    for (let at = 0; at < bytes.length; at += 65536) {
      this.give(bytes.subarray(at, at + 65536), (count) => this.wasm.fileText(count));
    }
    assert.equal(this.words(this.wasm.endFile()), '');
    this.rewind();
  }

  rewind() {
    this.wasm.recordingSettings();
    this.wasm.playRecording();
    this.fed = 0;
  }
}
