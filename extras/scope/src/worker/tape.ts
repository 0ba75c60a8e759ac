// Reads a file in a WebAssembly instance of its own: the characters of a recording, or of a capture of the wire.

import { CharacterSize, FileHeadMax, RecordReader, type Status, TransferSize } from '../border';
import type { Flight, Wire } from '../messages';
import { imports, Native } from '../native';
import { bytesOf, directory, unpack, type Entry } from './zip';

const mostEdges = 4000; // more of them are shown by levels
const mostCharacters = 64;
const recordsSize = Math.floor(TransferSize / RecordReader.size) * RecordReader.size; // bytes that WebAssembly takes at once

export class Tape {
  settings: Uint8Array = new Uint8Array();
  sensors: Uint8Array = new Uint8Array(); // in its telemetry's slots
  size = 0; // characters
  lengthUs = 0;
  carrier = ''; // of a capture: the signal that carries the line
  signals: string[] = []; // of a capture: those that carry S.Bus, this one first
  note = ''; // what a user should know of the file
  damage: string[] = []; // what is wrong with its bytes, and what to do
  zeroUs = 0; // the file's own time at time 0, not above 0
  private readonly native: Native;

  constructor(module: WebAssembly.Module) {
    this.native = Native.of(new WebAssembly.Instance(module, imports));
  }

  // Returns what is wrong with the file, or ''. Throws an Error if it cannot be unpacked.
  // `signal`: of a capture, the one to decode.
  async read(file: File, progress: (part: number) => void, signal = ''): Promise<string> {
    const { calls } = this.native;
    let bytes = 0;
    const taken = (count: number): void => progress((bytes += count) / file.size);
    this.native.transfer(new TextEncoder().encode(file.name), (count) => calls.nameFile(count));
    this.native.transfer(new TextEncoder().encode(signal), (count) => calls.chooseSignal(count));
    const [first, second] = new Uint8Array(await file.slice(0, 2).arrayBuffer());
    const isZip = first === 0x50 && second === 0x4b;
    const packing = first === 0x1f && second === 0x8b ? 'gzip' : undefined;
    const error = isZip ? await this.readZip(file, taken) : await this.readText(file, packing, taken);
    if (error !== '') {
      return error;
    }
    const wrong = this.native.words(calls.endFile());
    if (wrong === '') {
      this.settings = this.handed(calls.recordingSettings());
      this.size = calls.recordingSize();
      this.lengthUs = calls.recordingLengthUs();
      this.carrier = this.native.words(calls.carrier());
      this.signals = this.native.words(calls.signals()).split('\n').filter(Boolean);
      this.note = this.native.words(calls.fileNote());
      this.damage = this.native.words(calls.fileDamage()).split('\n').filter(Boolean);
      this.zeroUs = calls.recordingZeroUs();
    }
    return wrong;
  }

  // `taken`: how many more bytes of the file were read.
  private async readText(file: File, packing: CompressionFormat | undefined, taken: (count: number) => void): Promise<string> {
    const reader = bytesOf(file, packing, taken);
    const text = new Text(this.native);
    for (let part = await reader.read(); !part.done; part = await reader.read()) {
      text.take(part.value);
    }
    return text.end();
  }

  // A session of sigrok and PulseView, or a ZIP of one file. A session's samples are one entry, or several that are numbered.
  private async readZip(file: File, taken: (count: number) => void): Promise<string> {
    const { calls } = this.native;
    const entries = await directory(file);
    const files = [...entries].filter(([name]) => !/(^|\/)(\.[^/]*)?$/.test(name)); // macOS adds __MACOSX/._NAME, .DS_Store
    if (!entries.has('metadata')) {
      const text = new Text(this.native);
      if (files.length === 1) {
        await unpack(file, files[0][1], (bytes) => text.take(bytes), taken);
      } else {
        text.take(new Uint8Array(await file.slice(0, 64).arrayBuffer())); // which program's it is
      }
      const error = text.end();
      if (error !== '' || files.length === 1) {
        return error;
      }
    }
    const put = async (entry: Entry | undefined, call: (count: number) => void): Promise<boolean> => {
      if (entry) {
        await unpack(file, entry, (bytes) => this.native.transfer(bytes, call), taken);
      }
      return entry !== undefined;
    };
    await put(entries.get('metadata'), (count) => calls.sessionMetadata(count));
    const error = this.native.words(calls.openSession());
    if (error !== '') {
      return error;
    }
    const name = this.native.words(calls.samplesName());
    const samples = (count: number): void => void calls.sessionSamples(count);
    let part = 1;
    const isWhole = await put(entries.get(name), samples);
    while (!isWhole && (await put(entries.get(`${name}-${part}`), samples))) part++;
    return isWhole || part > 1 ? '' : this.native.words(calls.noSamples());
  }

  // Returns the characters from there on, as many as a decoder takes at once.
  part(from: number): { bytes: Uint8Array; count: number } {
    const bytes = this.handed(this.native.calls.recordingPart(from));
    return { bytes, count: bytes.length / CharacterSize };
  }

  // Returns a part of a capture's wire.
  wire(fromUs: number, toUs: number, columns: number): Wire {
    const { calls } = this.native;
    const first = calls.edges(fromUs, toUs, mostEdges);
    const edges = first < 0 ? undefined : new Float64Array(this.handed(8 * (first & 0xffff)).buffer);
    calls.levels(fromUs, toUs, columns);
    const levels = edges ? undefined : this.handed(columns);
    const bitUs = calls.bitUs();
    const count = toUs - fromUs < 12 * bitUs * mostCharacters ? calls.characters(fromUs, mostCharacters) : 0;
    const values = new Float64Array(this.handed(16 * count).buffer);
    const characters = Array.from({ length: count }, (_, i) => ({
      us: values[2 * i],
      value: values[2 * i + 1] & 0xff,
      parityWrong: (values[2 * i + 1] & 256) !== 0,
      stopWrong: (values[2 * i + 1] & 512) !== 0,
    })).filter(({ us }) => us < toUs);
    return { kind: 'wire', fromUs, toUs, bitUs, edges, isHigh: first > 0xffff, levels, characters, keptUs: calls.edgesEndUs() };
  }

  timeOf(character: number): number {
    return character < this.size ? this.native.calls.recordingUs(character) : 0;
  }

  beginFlight(): void {
    this.native.calls.beginFlight();
  }

  // Takes the next records of the whole recording's decoder.
  flightRecords(records: Uint8Array): void {
    for (let at = 0; at < records.length; at += recordsSize) {
      this.native.transfer(records.subarray(at, at + recordsSize), (size) => this.native.calls.flightRecords(size));
    }
  }

  // Returns undefined of a recording without frames. After the last records; `status`: of their decoder.
  flight({ frames, lostFrames, failsafeFrames, discardedBytes, characterErrors }: Status): Flight | undefined {
    const text = this.native.words(this.native.calls.flightNumbers(frames, lostFrames, failsafeFrames, discardedBytes, characterErrors));
    return text === '' ? undefined : JSON.parse(text);
  }

  // Returns the flight's report as a page of its own.
  report(): string {
    return this.native.words(this.native.calls.flightPage());
  }

  get hasTimes(): boolean {
    return this.native.calls.recordingHasTimes() !== 0;
  }

  get startUs(): number | undefined {
    return this.native.calls.recordingStartUs() || undefined;
  }

  private handed(size: number): Uint8Array {
    const { calls } = this.native;
    return new Uint8Array(calls.memory.buffer, calls.transferBuffer(), size).slice();
  }
}

// Hands over a file's bytes, its head first.
class Text {
  private head?: Uint8Array<ArrayBuffer> = new Uint8Array();
  private error = '';

  constructor(private readonly native: Native) {}

  take(bytes: Uint8Array): void {
    if (!this.head) {
      this.hand(bytes);
    } else if ((this.head = joined(this.head, bytes)).length >= FileHeadMax) {
      this.open();
    }
  }

  // Returns why the page cannot read the file, or ''.
  end(): string {
    this.open();
    return this.error;
  }

  private open(): void {
    const { head = new Uint8Array() } = this;
    if (this.head) {
      const open = (count: number): void => void (this.error = this.native.words(this.native.calls.openFile(count)));
      if (head.length === 0) {
        open(0);
      }
      this.native.transfer(head.subarray(0, FileHeadMax), open);
      this.head = undefined;
      this.hand(head);
    }
  }

  private hand(bytes: Uint8Array): void {
    if (this.error === '') {
      this.native.transfer(bytes, (count) => this.native.calls.fileText(count));
    }
  }
}

function joined(first: Uint8Array, second: Uint8Array): Uint8Array<ArrayBuffer> {
  const both = new Uint8Array(first.length + second.length);
  both.set(first);
  both.set(second, first.length);
  return both;
}
