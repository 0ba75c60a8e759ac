// A file that is read: the characters of a recording, in a WebAssembly of their own.

import { imports, Native, type Exports } from '../native';

export class Tape {
  settings: Uint8Array = new Uint8Array();
  size = 0; // characters
  lengthUs = 0;
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
    const beginning = await file.slice(0, layout.constant('RecordingBeginning')).arrayBuffer();
    if (/^(?!time,|seconds,)"?time\b/im.test(new TextDecoder().decode(beginning))) {
      return 'is a capture of the wire';
    }
    this.native.transfer(new Uint8Array(beginning), (count) => calls.openRecording(count));
    let bytes = 0;
    const reader = file.stream().getReader();
    for (let part = await reader.read(); !part.done; part = await reader.read()) {
      this.native.transfer(part.value, (count) => calls.recordingText(count));
      bytes += part.value.length;
      progress(bytes / file.size);
    }
    const error = this.native.words(calls.endRecording());
    if (error === '') {
      this.settings = this.handed(calls.recordingSettings());
      this.size = calls.recordingSize();
      this.lengthUs = calls.recordingLengthUs();
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
