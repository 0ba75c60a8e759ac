// Decodes a tape in a WebAssembly instance of its own. All that it knows is in its memory: a copy of that is the line's state.

import type { Exports } from '../border';
import { imports, Native } from '../native';
import type { Tape } from './tape';

const stepUs = 1000000;
const blockSize = 256; // numbers of 32 bits

// A copy of the memory: the blocks that differ from the first one.
export interface Image {
  us: number;
  next: number; // the next character
  size: number; // bytes of the memory
  places: Uint32Array; // of blocks
  blocks: Uint32Array;
}

export class Decoder {
  us = 0;
  next = 0; // the first character that it has not decoded
  private native: Native;
  private readonly first: Uint32Array;
  steps?: Uint8Array; // of the condition that it watches for

  constructor(
    private readonly module: WebAssembly.Module,
    private readonly tape: Tape,
  ) {
    this.native = this.instance(true);
    this.native.transfer(tape.sensors, (count) => this.native.calls.setSensors(count));
    this.native.transfer(tape.settings, () => this.native.calls.playRecording());
    this.advance(0);
    this.first = this.memory.slice();
  }

  get calls(): Exports {
    return this.native.calls;
  }

  get reader(): Native {
    return this.native;
  }

  // Hands over all that comes up to `us`, as records. Returns false if `hurry`, a time in ms, came first.
  advance(us: number, take: (records: Uint8Array) => void = () => undefined, hurry = Infinity): boolean {
    for (;;) {
      this.us = Math.min(us, Math.max(this.us + stepUs, this.tape.timeOf(this.next))); // a silence is one step
      this.native.records(this.us, take, () => this.feed());
      if (this.us >= us) {
        return true;
      }
      if (performance.now() > hurry) {
        return false;
      }
    }
  }

  // See Native.watchFor(). Also after restore().
  watchFor(steps?: Uint8Array): boolean {
    this.steps = steps;
    return this.native.watchFor(steps);
  }

  image(): Image {
    const { memory, first } = this;
    const places = [];
    for (let at = 0; at < memory.length; at += blockSize) {
      for (let i = at; i < at + blockSize; i++) {
        if (memory[i] !== (first[i] ?? 0)) {
          places.push(at);
          break;
        }
      }
    }
    const blocks = new Uint32Array(places.length * blockSize);
    places.forEach((at, i) => blocks.set(memory.subarray(at, at + blockSize), i * blockSize));
    return { us: this.us, next: this.next, size: memory.byteLength, places: Uint32Array.from(places), blocks };
  }

  // Goes to where an image was taken, by this decoder or by another one of the same tape.
  restore(image: Image): void {
    if (this.memory.byteLength > image.size) {
      this.native = this.instance(false); // a memory never shrinks, and its heap begins behind the end
    }
    const lacking = image.size - this.memory.byteLength;
    if (lacking > 0) {
      this.calls.memory.grow(lacking / 65536);
    }
    const { memory } = this;
    memory.set(this.first);
    memory.fill(0, this.first.length);
    image.places.forEach((at, i) => memory.set(image.blocks.subarray(i * blockSize, (i + 1) * blockSize), at));
    this.us = image.us;
    this.next = image.next;
    this.native.watchFor(this.steps);
  }

  private get memory(): Uint32Array {
    return new Uint32Array(this.calls.memory.buffer);
  }

  private instance(isNew: boolean): Native {
    return Native.of(new WebAssembly.Instance(this.module, imports), isNew);
  }

  private feed(): void {
    const part = this.tape.part(this.next);
    this.next += part.count;
    this.native.transfer(part.bytes, (size) => this.calls.feed(size, Number(this.next === this.tape.size)));
  }
}
