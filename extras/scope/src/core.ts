// The library itself, compiled to WebAssembly (../wasm). All knowledge of S.Bus is there.

import wasm from '../scope.wasm?inline';
import { Flag, Kind, type Line, type Sink, type Status, type Stretch } from './line';
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
  InterruptsOff,
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

const bytes = Uint8Array.from(atob(wasm.slice(wasm.indexOf(',') + 1)), (letter) => letter.charCodeAt(0));

export class Core implements Line {
  // The module that a worker runs.
  readonly wasm = bytes;
  private calibrating = false;
  private readonly native: Native['calls'];

  // Throws if the page and WebAssembly were not built together.
  private constructor(private readonly memory: Native) {
    this.native = memory.calls;
    memory.layout.enumeration('Finding', Finding);
    memory.layout.enumeration('CalibrationError', CalibrationError);
    memory.layout.enumeration('Scale', Scale);
  }

  static async load(): Promise<Core> {
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

  // Opens a port; a board's carries text, 8N1.
  openPort(nowUs: number, baud: number, board: boolean): void {
    this.native.openPort(nowUs, baud, Number(board));
  }

  received(bytes: Uint8Array, nowUs: number): void {
    this.memory.transfer(bytes, (count) => this.native.received(count, nowUs));
  }

  receivedBad(nowUs: number): void {
    this.native.receivedBad(nowUs);
  }

  // Hands over all that has come by `nowUs`.
  advance(nowUs: number, sink: Sink): void {
    this.memory.records(nowUs, (records) => this.stretchesIn(records).forEach((stretch) => sink.take(stretch)));
  }

  // Returns the stretches in the records of a worker.
  stretchesIn(records: Uint8Array): Stretch[] {
    return this.memory.stretchesIn(records);
  }

  status(nowUs: number): Status {
    return this.memory.status(nowUs);
  }

  telemetry(nowUs: number): string[] {
    return this.memory.telemetry(nowUs);
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

  // Forgets all that came before.
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
    this.calibrating = step !== 0;
    this.native.calibrate(step);
  }

  // Feeds a frame to the calibration, if one is running.
  feedCalibrator({ kind, channels, flags }: Stretch): void {
    if (this.calibrating && (kind === Kind.Frame || kind === Kind.Frame24)) {
      const raw = Uint16Array.from(channels);
      this.memory.transfer(new Uint8Array(raw.buffer), () =>
        this.native.feedCalibrator(flags & Flag.Failsafe, flags & Flag.LostFrame),
      );
    }
  }

  calibrationError(channel: number): CalibrationError {
    return this.native.calibrationErrorOf(channel);
  }

  // Returns a text that follows the channel's name: " hardly moved: ...".
  calibrationErrorText(error: CalibrationError): string {
    return this.memory.words(this.native.calibrationErrorText(error));
  }

  // Returns '', or why it failed: "CH3 hardly moved: ...".
  finishCalibration(wanted: number): string {
    const channel = this.native.finishCalibration(wanted);
    return channel < 0 ? '' : `CH${channel + 1}${this.calibrationErrorText(this.native.finishCalibrationError())}`;
  }

  // The bytes to store.
  get calibration(): Uint8Array {
    return this.calibrationBytes().slice();
  }

  // Returns false if it is no calibration, or damaged.
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

  record(): void {
    this.native.record(1);
  }

  takeRecorded(): string {
    return this.memory.words(this.native.takeRecorded());
  }

  async endRecorded(): Promise<string> {
    this.native.record(0);
    return this.takeRecorded();
  }

  private calibrationBytes(): Uint8Array {
    return new Uint8Array(this.native.memory.buffer, this.native.calibrationBytes(), this.native.calibrationSize());
  }
}
