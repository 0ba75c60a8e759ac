// A recording, rows of CSV or a capture of the wire, with a time line.

import type { Core } from '../core';
import type { Line } from '../line';
import { Player } from './player';
import type { Source } from './Source';

const largest = 5e8; // bytes: 16 hours, which take 1.2 GB of memory

export class RecordingSource implements Source {
  readonly state = 'open';
  readonly settings = [];
  speed = 1;
  loop = false;
  playing = true;
  private us = 0; // where it is to be
  private lastMs = performance.now();

  private constructor(
    private readonly player: Player,
    readonly title: string,
  ) {}

  // Reads the file; what it returns plays it. Throws an Error that says what is wrong with the recording, or a Problem.
  static async read(core: Core, file: File, signal: AbortSignal, progress: (part: number) => void): Promise<() => RecordingSource> {
    if (file.size > largest) {
      throw new Error(`${file.name}: is larger than ${largest / 1e6} MB: sbus plot and sbus csv read it`);
    }
    const player = await Player.read(core, file, signal, progress);
    if (signal.aborted) {
      player.close();
      signal.throwIfAborted();
    }
    return () => new RecordingSource(player, player.carrier ? `Capture ${file.name}, ${player.carrier}` : `Recording ${file.name}`);
  }

  get line(): Line {
    return this.player;
  }

  get lengthUs(): number {
    return this.player.lengthUs;
  }

  get progress(): string {
    const { progress } = this.player;
    return progress === undefined ? '' : `decoding up to there: ${Math.floor(100 * progress)} %`;
  }

  get positionUs(): number {
    return this.us;
  }

  get atEnd(): boolean {
    return this.us >= this.endUs && this.player.us >= this.endUs;
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
    this.player.wantedUs = this.us;
    return this.player.us;
  }

  // All is as if it had been played up to there.
  seek(us: number): void {
    this.us = Math.min(us, this.endUs);
    this.player.seek(this.us);
  }

  async use(): Promise<void> {}

  close(): void {
    this.player.close();
  }

  // A moment after the last character: then it is known to be the last.
  private get endUs(): number {
    return this.lengthUs + 1000;
  }
}
