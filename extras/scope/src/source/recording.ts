// A recording, or rows of CSV, with a time line.

import type { Core } from '../core';
import type { Source } from './Source';

const largest = 5e8; // bytes: 16 hours, which take 1.2 GB of memory

export class RecordingSource implements Source {
  readonly state = 'open';
  readonly settings = [];
  speed = 1;
  loop = false;
  playing = true;
  private us = 0;
  private lastMs = performance.now();

  private constructor(
    private readonly core: Core,
    readonly title: string,
    readonly lengthUs: number,
  ) {}

  // Reads the file; what it returns plays it. Throws an Error that says what is wrong with the recording.
  static async read(core: Core, file: File, signal: AbortSignal): Promise<() => RecordingSource> {
    if (file.size > largest) {
      throw new Error(`${file.name}: is larger than ${largest / 1e6} MB: sbus plot and sbus csv read it`);
    }
    const beginning = await file.slice(0, core.recordingBeginning).arrayBuffer();
    signal.throwIfAborted(); // the core reads one file at a time
    if (/^(?!time,|seconds,)"?time\b/im.test(new TextDecoder().decode(beginning))) {
      throw new Error(`${file.name}: is a capture of the wire`);
    }
    core.openRecording(new Uint8Array(beginning));
    const reader = file.stream().getReader();
    for (let part = await reader.read(); !part.done; part = await reader.read()) {
      signal.throwIfAborted();
      core.recordingText(part.value);
    }
    signal.throwIfAborted();
    const error = core.endRecording();
    if (error !== '') {
      throw new Error(`${file.name}: ${error}`);
    }
    return () => {
      core.playRecording();
      return new RecordingSource(core, `Recording ${file.name}`, core.recordingLengthUs);
    };
  }

  get positionUs(): number {
    return this.us;
  }

  get atEnd(): boolean {
    return this.us >= this.endUs;
  }

  get stands(): boolean {
    return !this.playing || this.atEnd;
  }

  nowUs(): number {
    const ms = performance.now();
    if (this.playing) {
      this.us = Math.min(this.us + (ms - this.lastMs) * 1000 * this.speed, this.endUs);
    }
    this.lastMs = ms;
    return this.us;
  }

  // All is as if it had been played up to there. True if that is from its beginning once more.
  seek(us: number): boolean {
    const back = us < this.us;
    if (back) {
      this.core.rewindRecording();
    }
    this.us = Math.min(us, this.endUs);
    return back;
  }

  async use(): Promise<void> {}
  close(): void {}

  // A moment after the last character: then it is known to be the last.
  private get endUs(): number {
    return this.lengthUs + 1000;
  }
}
