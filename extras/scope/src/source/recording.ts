// A recording, rows of CSV or a capture of the wire, with a time line.

import { EndUs } from '../border';
import type { Core } from '../core';
import type { Fault, Found } from '../messages';
import { Remote } from './remote';
import type { Source } from './Source';

export class RecordingSource implements Source {
  readonly state = 'open';
  speed = 1;
  loop = false;
  playing = true;
  found?: Found; // the fault at the position, until that changes
  isLast = false; // there is no further fault in the direction asked for
  private us = 0; // the position that is wanted
  private lastMs = performance.now();

  private constructor(
    readonly line: Remote,
    readonly title: string,
    readonly file: File,
    readonly signals: readonly string[], // of a capture: those that carry S.Bus
  ) {}

  // Reads the file; of a capture, one of the signals of `before`, the same capture. Returns a function that plays it. Throws an Error that says what is wrong with the recording, or a Problem.
  static async read(core: Core, file: File, signal: AbortSignal, progress: (part: number) => void, wire?: string, before?: RecordingSource): Promise<() => RecordingSource> {
    const line = await Remote.read(core, file, wire, signal, progress);
    const { startUs, carrier, note } = line.file;
    const began = startUs === undefined ? '' : `of ${new Date(startUs / 1000).toLocaleString()}`;
    const words = carrier ? [`Capture ${file.name}`, carrier, note] : [`Recording ${file.name}`, began, note];
    return () => new RecordingSource(line, words.filter(Boolean).join(', '), file, before?.signals ?? line.file.signals ?? []);
  }

  get lengthUs(): number {
    return Math.max(this.line.file.lengthUs, 1); // a single byte may be at time 0
  }

  get progress(): string {
    const { progress } = this.line;
    const what = this.line.isLooking ? 'looking' : 'decoding up to this position';
    return progress === undefined ? '' : `${what}: ${Math.floor(100 * progress)} %`;
  }

  get positionUs(): number {
    return this.us;
  }

  get atEnd(): boolean {
    return this.us >= this.endUs && this.line.us >= this.endUs;
  }

  get stands(): boolean {
    return !this.playing || this.atEnd;
  }

  nowUs(): number {
    const ms = performance.now();
    if (this.playing && !this.line.isLooking) {
      this.leave();
      this.us = Math.min(this.us + (ms - this.lastMs) * 1000 * this.speed, this.endUs);
    }
    this.lastMs = ms;
    this.line.wantedUs = this.us;
    return this.line.us;
  }

  // Goes to a position: all is as if the recording had been played up to there.
  seek(us: number): void {
    this.leave();
    this.us = Math.min(us, this.endUs);
    this.line.seek(this.us);
  }

  // Goes to a position and stops there.
  visit(us: number): void {
    this.seek(us);
    this.playing = false;
  }

  // Goes to the next fault, or the one before, and stops there. `only`: of that kind.
  seekFault(back: boolean, only?: Fault): void {
    this.line.look({ kind: 'fault', us: this.us || -1, at: this.found, only, back }, ({ us, found }) => {
      this.us = us;
      this.playing = false;
      this.found = found ?? this.found;
      this.isLast = found === null;
    });
  }

  // Goes to `afterUs` after the next moment after `us` at which the condition becomes true, and stops there. Calls `tell` with the
  // position and the moment, if there is one; not at all if the page seeks another position first.
  seekEvent(us: number, steps: Uint8Array, afterUs: number, tell: (us: number, event: number | null) => void): void {
    this.line.look({ kind: 'event', us, steps, afterUs }, ({ us: to, event = null }) => {
      this.leave();
      this.us = event === null ? this.us : to;
      this.playing = false;
      tell(to, event);
    });
  }

  close(): void {
    this.line.close();
  }

  private leave(): void {
    this.found = undefined;
    this.isLast = false;
  }

  // The last position: after the silence that shows that the last frame is whole.
  get endUs(): number {
    return this.lengthUs + EndUs;
  }
}
