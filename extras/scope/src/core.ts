// The library itself, compiled to WebAssembly (../wasm): all that is known of S.Bus is known there.

import wasm from '../scope.wasm?inline';

export enum LinkState {
  NeverSeen,
  Ok,
  Lossy,
  Failsafe,
  Stale,
}

// sbus::Finding
export enum Finding {
  NoSignal,
  NoFrames,
  Channels24,
  WrongPolarity,
  WrongBaud,
  WrongPolarityAndBaud,
  PolledTooSeldom,
  Noise,
  Failsafe,
  NoRadio,
  Lossy,
  AllWellAndMore,
  AllWell,
}

// sbus::CalibrationError
export enum CalibrationError {
  None,
  NeverSeen,
  HardlyMoved,
  CentreOutside,
  NotStill,
  NotCentred,
  NotPushed,
  MovedOneWay,
  NotRested,
  NotHeld,
}

export enum Kind {
  Frame, // 16 channels and two switches
  Frame24,
  Extra, // header 2F: CH17..CH32
  NoFrame,
  Row, // numbers that a board has printed
}

export enum Flag {
  Channel17 = 1,
  Channel18 = 2,
  LostFrame = 4,
  Failsafe = 8,
}

// A piece of the line: a frame, or what is none.
export interface Stretch {
  endUs: number;
  kind: Kind;
  flags: number;
  channels: Float64Array; // raw; of a Row as it was printed
  bytes: Uint8Array; // empty for a Row
  why: string; // it is no frame
}

// As in wasm/Status.cpp.
const statusNames = [
  'state', 'ageUs', 'framesPerSecond', 'gapMinUs', 'gapMeanUs', 'gapMaxUs', 'characters', 'badCharacters', 'frames',
  'lostFrames', 'failsafeFrames', 'rejectedByEnd', 'rejectedByFlags', 'rejectedByLength', 'discardedBytes', 'resyncs', 'overflows',
  'extraFrames', 'rows', 'otherLines', 'garbled',
] as const;
export type Status = Record<(typeof statusNames)[number], number>;

export interface Setting {
  baud: number;
  inverted: boolean;
}

export interface Simulation {
  calibration: boolean;
  channels: 16 | 24 | 32;
  noise: number; // disturbances a second
  line: Setting;
}

export interface Range {
  low: number;
  centre: number;
  high: number;
}

export enum Scale {
  FrSky,
  Futaba,
  Calibrated,
}

// As in wasm/Scope.h.
const recordSize = 392;
const channelsAt = 8;
const bytesAt = 268;
const whyAt = 304;
const enough = 256; // records

// The C++ library of Debian 13 writes its last words to standard error. There is none: WASI's error ENOSYS is 52.
const noSystem = new Proxy({}, { get: () => () => 52 });

// As in line/Recording.h.
export const recordingBeginning = 4096; // bytes

type Native = Record<string, (...values: number[]) => number> & { memory: WebAssembly.Memory };

export class Core {
  private readonly text = new TextDecoder();

  private constructor(private readonly native: Native) {}

  static async load(): Promise<Core> {
    const bytes = Uint8Array.from(atob(wasm.slice(wasm.indexOf(',') + 1)), (letter) => letter.charCodeAt(0));
    const { instance } = await WebAssembly.instantiate(bytes, { wasi_snapshot_preview1: noSystem });
    const native = instance.exports as Native;
    native._initialize();
    return new Core(native);
  }

  // The line.

  openSimulated({ calibration, channels, noise, line }: Simulation): void {
    this.native.openSimulated(Number(calibration), channels, noise, line.baud, Number(line.inverted));
  }

  setPort(nowUs: number, port: Setting): void {
    this.native.setPort(nowUs, port.baud, Number(port.inverted));
  }

  cutWire(cut: boolean): void {
    this.native.cutWire(Number(cut));
  }

  // A board's port carries text: 8N1.
  openPort(nowUs: number, baud: number, board: boolean): void {
    this.native.openPort(nowUs, baud, Number(board));
  }

  received(bytes: Uint8Array, nowUs: number): void {
    this.transfer(bytes, (count) => this.native.received(count, nowUs));
  }

  receivedBad(nowUs: number): void {
    this.native.receivedBad(nowUs);
  }

  // `beginning`: recordingBeginning bytes, or all there are. They tell how its line was set.
  openRecording(beginning: Uint8Array): void {
    this.transfer(beginning, (count) => this.native.openRecording(count));
  }

  recordingText(text: Uint8Array): void {
    this.transfer(text, (count) => this.native.recordingText(count));
  }

  // What is wrong with the recording, or ''. Until playRecording() the line is as it was.
  endRecording(): string {
    return this.words(this.native.endRecording());
  }

  playRecording(): void {
    this.native.playRecording();
  }

  get recordingLengthUs(): number {
    return this.native.recordingLengthUs();
  }

  rewindRecording(): void {
    this.native.rewindRecording();
  }

  // Hands over all that has come by `nowUs`.
  advance(nowUs: number, take: (stretch: Stretch) => void): void {
    for (let count = enough; count >= enough; ) {
      count = this.native.advance(nowUs);
      const at = this.native.records();
      const view = new DataView(this.native.memory.buffer);
      const stretches = Array.from({ length: count }, (_, i) => this.stretch(view, at + i * recordSize));
      this.native.takenRecords();
      stretches.forEach(take); // it may call what makes the memory grow, and the view is then detached
    }
  }

  status(nowUs: number): Status {
    const values = this.doubles(this.native.status(nowUs), statusNames.length);
    return Object.fromEntries(statusNames.map((name, i) => [name, values[i]])) as Status;
  }

  travel(channel: number): [number, number] | undefined {
    const at = this.native.travel(channel);
    return at === 0 ? undefined : (Array.from(this.doubles(at, 2)) as [number, number]);
  }

  resetMarks(): void {
    this.native.resetMarks();
  }

  // The verdict.

  beginRound(): void {
    this.native.beginRound();
  }

  addTrial(): void {
    this.native.addTrial();
  }

  endRound(): { finding: Finding; best: number } {
    return { finding: this.native.roundFinding(), best: this.native.roundBest() };
  }

  mark(): void {
    this.native.mark();
  }

  // Of what came since mark().
  get verdict(): Finding {
    return this.native.verdict();
  }

  findingText(finding: Finding): string {
    return this.words(this.native.findingText(finding));
  }

  findingRemedy(finding: Finding): string {
    return this.words(this.native.findingRemedy(finding));
  }

  isWell(finding: Finding): boolean {
    return this.native.findingIsWell(finding) !== 0;
  }

  // Values.

  setScale(scale: Scale): void {
    this.native.setScale(scale);
  }

  microseconds(channel: number, raw: number): number {
    return this.native.microseconds(channel, raw);
  }

  percent(channel: number, raw: number): number {
    return this.native.thousandths(channel, raw) / 10;
  }

  range(channel: number): Range {
    const [low, centre, high] = this.doubles(this.native.rangeOf(channel), 3);
    return { low, centre, high };
  }

  calibrate(step: number): void {
    this.native.calibrate(step);
  }

  calibrationError(channel: number): CalibrationError {
    return this.native.calibrationErrorOf(channel);
  }

  // Follows the channel's name: " hardly moved: ...".
  calibrationErrorText(error: CalibrationError): string {
    return this.words(this.native.calibrationErrorText(error));
  }

  // Why not: "CH3 hardly moved: ..."; or ''.
  finishCalibration(wanted: number): string {
    const channel = this.native.finishCalibration(wanted);
    return channel < 0 ? '' : `CH${channel + 1}${this.calibrationErrorText(this.native.finishCalibrationError())}`;
  }

  // As it is stored.
  get calibration(): Uint8Array {
    return this.calibrationBytes().slice();
  }

  // False if it is none, or damaged.
  restoreCalibration(bytes: Uint8Array): boolean {
    const place = this.calibrationBytes();
    if (bytes.length !== place.length) {
      return false;
    }
    place.set(bytes);
    return this.native.calibrationIsGood() !== 0;
  }

  // Returns the channel to which a bit of a frame of `size` bytes belongs, and which of its bits it is.
  ownerOfBit(size: number, byte: number, bit: number): { channel: number; bit: number } | undefined {
    const owner = this.native.ownerOfBit(size, byte, bit);
    return owner < 0 ? undefined : { channel: owner & 0xff, bit: owner >> 8 };
  }

  // Recording.

  record(on: boolean): void {
    this.native.record(Number(on));
  }

  takeRecorded(): string {
    return this.words(this.native.takeRecorded());
  }

  private transfer(bytes: Uint8Array, call: (count: number) => void): void {
    const at = this.native.transferBuffer();
    const size = 1 << 16;
    for (let from = 0; from < bytes.length; from += size) {
      const part = bytes.subarray(from, from + size);
      new Uint8Array(this.native.memory.buffer, at).set(part);
      call(part.length);
    }
  }

  private stretch(view: DataView, at: number): Stretch {
    const [kind, flags, count, size] = new Uint8Array(view.buffer, at + channelsAt + 256, 4);
    return {
      endUs: view.getFloat64(at, true),
      kind,
      flags,
      channels: new Float64Array(view.buffer, at + channelsAt, count).slice(),
      bytes: new Uint8Array(view.buffer, at + bytesAt, size).slice(),
      why: kind === Kind.NoFrame ? this.words(at + whyAt) : '',
    };
  }

  private calibrationBytes(): Uint8Array {
    return new Uint8Array(this.native.memory.buffer, this.native.calibrationBytes(), this.native.calibrationSize());
  }

  private doubles(at: number, count: number): Float64Array {
    return new Float64Array(this.native.memory.buffer, at, count);
  }

  private words(at: number): string {
    const bytes = new Uint8Array(this.native.memory.buffer, at);
    return this.text.decode(bytes.subarray(0, bytes.indexOf(0)));
  }
}
