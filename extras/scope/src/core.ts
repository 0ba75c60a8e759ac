// The library itself, compiled to WebAssembly (../wasm): all that is known of S.Bus is known there.

import wasm from '../scope.wasm?inline';
import type { Status, Stretch } from './line';
import { imports, Native, type Exports } from './native';

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

export class Core {
  private readonly native: Native['calls'];

  // Throws if the page and WebAssembly were not built together.
  private constructor(private readonly memory: Native) {
    this.native = memory.calls;
    memory.layout.enumeration('Finding', Finding);
    memory.layout.enumeration('CalibrationError', CalibrationError);
    memory.layout.enumeration('Scale', Scale);
  }

  static async load(): Promise<Core> {
    const bytes = Uint8Array.from(atob(wasm.slice(wasm.indexOf(',') + 1)), (letter) => letter.charCodeAt(0));
    const { instance } = await WebAssembly.instantiate(bytes, imports);
    const native = instance.exports as Exports;
    native._initialize();
    return new Core(new Native(native));
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
    this.memory.transfer(bytes, (count) => this.native.received(count, nowUs));
  }

  receivedBad(nowUs: number): void {
    this.native.receivedBad(nowUs);
  }

  // How many bytes of a file tell what it is.
  get recordingBeginning(): number {
    return this.memory.layout.constant('RecordingBeginning');
  }

  // `beginning`: recordingBeginning bytes, or all there are. They tell how its line was set.
  openRecording(beginning: Uint8Array): void {
    this.memory.transfer(beginning, (count) => this.native.openRecording(count));
  }

  recordingText(text: Uint8Array): void {
    this.memory.transfer(text, (count) => this.native.recordingText(count));
  }

  // What is wrong with the recording, or ''. Until playRecording() the line is as it was.
  endRecording(): string {
    return this.memory.words(this.native.endRecording());
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
    this.memory.advance(nowUs, take);
  }

  status(nowUs: number): Status {
    return this.memory.status(nowUs);
  }

  travel(channel: number): [number, number] | undefined {
    return this.memory.travel(channel);
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

  // What has come before is forgotten.
  mark(): void {
    this.native.mark();
  }

  findingText(finding: Finding): string {
    return this.memory.words(this.native.findingText(finding));
  }

  findingRemedy(finding: Finding): string {
    return this.memory.words(this.native.findingRemedy(finding));
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
    const [low, centre, high] = this.memory.doubles(this.native.rangeOf(channel), 3);
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
    return this.memory.words(this.native.calibrationErrorText(error));
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
    return this.memory.words(this.native.takeRecorded());
  }

  private calibrationBytes(): Uint8Array {
    return new Uint8Array(this.native.memory.buffer, this.native.calibrationBytes(), this.native.calibrationSize());
  }
}
