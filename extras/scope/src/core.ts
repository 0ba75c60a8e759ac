// The library itself, compiled to WebAssembly (../wasm). All knowledge of S.Bus is there.

import wasm from '../scope.wasm.gz';
import { type CalibrationError, type Exports, type Finding, Flag, Kind, ReadConditionReader, type Scale } from './border';
import { imports, Native, type Stretch } from './native';
import type { SensorType } from './sensors';
import type { Range } from './unit';

export { CalibrationError, Scale } from './border';

// A condition at which the picture stops; or what is wrong with its text, and where.
interface Condition {
  steps: Uint8Array;
  error: string;
  from: number;
  to: number;
}

// Packed it is a third as large.
async function unpacked(): Promise<Uint8Array> {
  return new Uint8Array(await new Response(new Blob([wasm]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer());
}

export class Core extends Native {
  private calibrating = false;

  private constructor(
    calls: Exports,
    readonly wasm: Uint8Array, // the module that a worker runs
  ) {
    super(calls);
  }

  static async load(): Promise<Core> {
    const bytes = await unpacked();
    const { instance } = await WebAssembly.instantiate(bytes as BufferSource, imports);
    return new Core(Native.of(instance).calls, bytes);
  }

  isWell(finding: Finding): boolean {
    return this.calls.findingIsWell(finding) !== 0;
  }

  // Returns the known sensors of telemetry, in WebAssembly's order.
  get sensors(): SensorType[] {
    return this.words(this.calls.sensorNames()).trim().split('\n').map((line) => line.split(' ')).map(([name, slots]) => ({ name, slots: Number(slots) }));
  }

  setScale(scale: Scale): void {
    this.calls.setScale(scale);
  }

  microseconds(channel: number, raw: number): number {
    return this.calls.microseconds(channel, raw);
  }

  percent(channel: number, raw: number): number {
    return this.calls.thousandths(channel, raw) / 10;
  }

  // Reads a text such as "ch5 > 1500 us && !failsafe". `isBoard`: it compares the numbers of a board; undefined while that is not known.
  condition(text: string, isBoard?: boolean): Condition {
    const bytes = new TextEncoder().encode(`${text} `);
    let at = 0;
    this.transfer(bytes, (count) => (at = this.calls.readCondition(count, Number(isBoard ?? 2))));
    const { buffer } = this.calls.memory;
    const { error, errorAt, errorLength, steps, size } = new ReadConditionReader(new DataView(buffer), at);
    const place = (end: number): number => new TextDecoder().decode(bytes.subarray(0, end)).length;
    return { steps: new Uint8Array(buffer, steps, size).slice(), error: this.words(error), from: place(errorAt), to: place(errorAt + errorLength) };
  }

  range(channel: number): Range {
    const [low, centre, high] = this.doubles(this.calls.rangeOf(channel), 3);
    return { low, centre, high };
  }

  calibrate(step: number): void {
    this.calibrating = step !== 0;
    this.calls.calibrate(step);
  }

  // Feeds a frame to the calibration, if one is running.
  feedCalibrator({ kind, channels, flags }: Stretch): void {
    if (this.calibrating && (kind === Kind.Frame || kind === Kind.Frame24)) {
      const raw = Uint16Array.from(channels);
      this.transfer(new Uint8Array(raw.buffer), () =>
        this.calls.feedCalibrator(flags & Flag.Failsafe, flags & Flag.LostFrame),
      );
    }
  }

  calibrationError(channel: number): CalibrationError {
    return this.calls.calibrationErrorOf(channel);
  }

  // Returns a text that follows the channel's name: " hardly moved: ...".
  calibrationErrorText(error: CalibrationError): string {
    return this.words(this.calls.calibrationErrorText(error));
  }

  // Returns '', or why it failed: "CH3 hardly moved: ...".
  finishCalibration(wanted: number): string {
    const channel = this.calls.finishCalibration(wanted);
    return channel < 0 ? '' : `CH${channel + 1}${this.calibrationErrorText(this.calls.finishCalibrationError())}`;
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
    return this.calls.calibrationIsGood() !== 0;
  }

  // Returns the channel to which a bit of a frame of `size` bytes belongs, and which of its bits it is.
  ownerOfBit(size: number, byte: number, bit: number): { channel: number; bit: number } | undefined {
    const owner = this.calls.ownerOfBit(size, byte, bit);
    return owner < 0 ? undefined : { channel: owner & 0xff, bit: owner >> 8 };
  }

  private calibrationBytes(): Uint8Array {
    return new Uint8Array(this.calls.memory.buffer, this.calls.calibrationBytes(), this.calls.calibrationSize());
  }
}
