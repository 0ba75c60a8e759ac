// The line in WebAssembly's memory: a simulated receiver or a port.

import type { Setting, Simulation } from '../core';
import type { Exports, Finding } from '../border';
import { imports, Native } from '../native';

export class LineCore {
  private readonly calls: Exports;

  private constructor(readonly native: Native) {
    this.calls = native.calls;
  }

  static async load(wasm: Uint8Array): Promise<LineCore> {
    const { instance } = await WebAssembly.instantiate(wasm as BufferSource, imports);
    return new LineCore(Native.of(instance));
  }

  openSimulated({ calibration, channels, noise, line }: Simulation): void {
    this.calls.openSimulated(Number(calibration), channels, noise, line.baud, Number(line.inverted));
  }

  setPort(nowUs: number, port: Setting): void {
    this.calls.setPort(nowUs, port.baud, Number(port.inverted));
  }

  cutWire(cut: boolean): void {
    this.calls.cutWire(Number(cut));
  }

  // Opens a port; a board's carries text, 8N1.
  openPort(nowUs: number, baud: number, board: boolean): void {
    this.calls.openPort(nowUs, baud, Number(board));
  }

  received(bytes: Uint8Array, nowUs: number): void {
    this.native.transfer(bytes, (count) => this.calls.received(count, nowUs));
  }

  receivedBad(nowUs: number): void {
    this.calls.receivedBad(nowUs);
  }

  // Trials of settings.

  beginRound(): void {
    this.calls.beginRound();
  }

  addTrial(): void {
    this.calls.addTrial();
  }

  endRound(): { finding: Finding; best: number } {
    return { finding: this.calls.roundFinding(), best: this.calls.roundBest() };
  }

  // Forgets all that came before.
  mark(): void {
    this.calls.mark();
  }

  findingText(finding: Finding): string {
    return this.native.words(this.calls.findingText(finding));
  }

  findingRemedy(finding: Finding): string {
    return this.native.words(this.calls.findingRemedy(finding));
  }
}
