// Runs the page's WebAssembly without the page: one line, decoded from its beginning.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { build } from './support.mjs';

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
    const at = this.wasm.status(us) + this.layout(`field Status ${name}`);
    return new DataView(this.wasm.memory.buffer).getFloat64(at, true);
  }

  // Returns the records that have come by then: when, and of which kind.
  advance(us) {
    const records = [];
    const recordSize = this.layout('size Record');
    const [endUsAt, kindAt] = ['endUs', 'kind'].map((name) => this.layout(`field Record ${name}`));
    for (let count = 256; count >= 256 || this.wasm.needsMore(); ) {
      if (this.wasm.needsMore()) {
        const size = this.wasm.recordingPart(this.fed);
        this.fed += size / this.layout('constant CharacterSize');
        this.wasm.feed(size, Number(this.fed === this.wasm.recordingSize()));
      }
      count = this.wasm.advance(us);
      const view = new DataView(this.wasm.memory.buffer, this.wasm.records());
      for (let at = 0; at < count * recordSize; at += recordSize) {
        records.push({ endUs: view.getFloat64(at + endUsAt, true), kind: view.getUint8(at + kindAt) });
      }
      this.wasm.takenRecords();
    }
    return records;
  }

  travel(channel) {
    return Array.from(new Float64Array(this.wasm.memory.buffer, this.wasm.travel(channel), 2));
  }

  // Returns a number of the layout: the first one after these words.
  layout(words) {
    this.text ??= this.words(this.wasm.layout());
    return Number(new RegExp(`^${words} (\\d+)`, 'm').exec(this.text)[1]);
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
