// A file that is read, in a WebAssembly of its own: the characters of a recording, or of a capture of the wire.

import { imports, Native, type Exports } from '../native';

export class Tape {
  settings: Uint8Array = new Uint8Array();
  size = 0; // characters
  lengthUs = 0;
  carrier = ''; // of a capture: the signal that has the line
  private readonly native: Native;

  constructor(module: WebAssembly.Module) {
    this.native = new Native(new WebAssembly.Instance(module, imports).exports as Exports);
    this.native.calls._initialize();
  }

  get layout(): Native['layout'] {
    return this.native.layout;
  }

  // Returns what is wrong with the file, or ''.
  async read(file: File, progress: (part: number) => void): Promise<string> {
    const { calls, layout } = this.native;
    const magic = new Uint8Array(await file.slice(0, 2).arrayBuffer());
    if (magic[0] === 0x50 && magic[1] === 0x4b) {
      return `${file.name}: is packed: sbus decode reads a session of PulseView (.sr); or export it as VCD or CSV`;
    }
    let bytes = 0;
    const counting = new TransformStream<Uint8Array, Uint8Array>({
      transform(part, out): void {
        bytes += part.length;
        progress(bytes / file.size);
        out.enqueue(part);
      },
    });
    const plain = file.stream().pipeThrough(counting);
    const isGzip = magic[0] === 0x1f && magic[1] === 0x8b;
    const reader = (isGzip ? plain.pipeThrough(new DecompressionStream('gzip') as TransformStream) : plain).getReader();
    this.native.transfer(new TextEncoder().encode(file.name), (count) => calls.nameFile(count));
    let head = new Uint8Array();
    let part = await reader.read();
    for (; !part.done && head.length < layout.constant('HeadSize'); part = await reader.read()) {
      head = joined(head, part.value);
    }
    this.native.transfer(head.subarray(0, layout.constant('HeadSize')), (count) => calls.openFile(count));
    if (head.length === 0) {
      calls.openFile(0);
    }
    this.native.transfer(head, (count) => calls.fileText(count));
    for (; !part.done; part = await reader.read()) {
      this.native.transfer(part.value, (count) => calls.fileText(count));
    }
    const error = this.native.words(calls.endFile());
    if (error === '') {
      this.settings = this.handed(calls.recordingSettings());
      this.size = calls.recordingSize();
      this.lengthUs = calls.recordingLengthUs();
      this.carrier = this.native.words(calls.carrier());
    }
    return error;
  }

  // Returns the characters from there on, as many as a decoder takes at once.
  part(from: number): { bytes: Uint8Array; count: number } {
    const bytes = this.handed(this.native.calls.recordingPart(from));
    return { bytes, count: bytes.length / this.layout.constant('CharacterSize') };
  }

  timeOf(character: number): number {
    return character < this.size ? this.native.calls.recordingUs(character) : 0;
  }

  private handed(size: number): Uint8Array {
    const { calls } = this.native;
    return new Uint8Array(calls.memory.buffer, calls.transferBuffer(), size).slice();
  }
}

function joined(first: Uint8Array, second: Uint8Array): Uint8Array<ArrayBuffer> {
  const both = new Uint8Array(first.length + second.length);
  both.set(first);
  both.set(second, first.length);
  return both;
}
