// A second line, B, beside the one that is shown, A: a recording beside a recording, or a port beside a port. B is at the same
// moment, by the delay that was measured.

import type { Core } from '../core';
import { History, isSample } from '../history';
import type { Sink, Stretch } from '../line';
import type { Comparison, Samples } from '../messages';
import { PortSource } from './port';
import type { RecordingSource } from './recording';
import { Remote } from './remote';

const jumpUs = 2000000; // what is further away is sought
let ids = 0;

// Returns B's time at a time of A, in us.
export const otherUs = ({ atZeroUs, driftPpm, laterUs }: Comparison, us: number): number => us + atZeroUs + (driftPpm * us) / 1e6 - laterUs;

export abstract class Second implements Sink {
  readonly history = new History();

  protected constructor(
    readonly line: Remote,
    readonly name: string,
  ) {}

  // Returns undefined before it is made, null if both have no frame in common.
  abstract get comparison(): Comparison | null | undefined;

  // Why frames differ: rates, and ends of channels; or ''.
  abstract get ends(): string;

  // The text to show until then.
  abstract readonly waiting: string;

  // What is wrong with its port or its decoder, or ''.
  get problem(): string {
    const problem = this.line.failure ?? this.line.live?.problem;
    return problem ? `${problem.text} ${problem.remedy}` : '';
  }

  // Goes to the moment at which A is. Call it for each picture.
  abstract follow(): void;

  // Returns B's time at a time of A, in us; NaN before it is known.
  abstract at(us: number): number;

  take(stretch: Stretch): void {
    if (isSample(stretch)) {
      this.history.add(stretch);
    }
  }

  jump(): void {
    this.history.clear();
  }

  precede(samples: Samples): void {
    this.history.precede(samples);
  }

  close(): void {
    this.line.close();
  }
}

export class SecondRecording extends Second {
  readonly waiting = 'Both are decoded and compared.';
  private readonly id = ++ids;
  private askedUs = NaN;

  private constructor(
    private readonly first: RecordingSource,
    line: Remote,
    file: File,
  ) {
    super(line, file.name);
    first.line.ask({ kind: 'compare', id: this.id, file });
  }

  // Reads the file. Throws an Error that says what is wrong with the recording, a Problem, or the reason of `signal`.
  static async read(core: Core, file: File, first: RecordingSource, signal: AbortSignal): Promise<Second> {
    return new SecondRecording(first, await Remote.read(core, file, signal, () => undefined), file);
  }

  get comparison(): Comparison | null | undefined {
    const { compared } = this.first.line;
    return compared?.id !== this.id ? undefined : compared.comparison.delays > 0 ? compared.comparison : null;
  }

  get ends(): string {
    const { compared } = this.first.line;
    return compared?.id === this.id ? compared.comparison.ends : '';
  }

  follow(): void {
    const { line, askedUs } = this;
    if (this.comparison) {
      const us = Math.min(Math.max(this.at(this.first.line.us), 0), line.file.lengthUs + 1000);
      this.askedUs = us;
      if (us >= askedUs && us < askedUs + jumpUs) {
        line.wantedUs = us;
      } else {
        line.seek(us);
      }
      line.advance(this);
    }
  }

  at(us: number): number {
    return this.comparison ? otherUs(this.comparison, us) : NaN;
  }
}

export class SecondPort extends Second {
  readonly waiting = 'Move a stick: the delay shows once both have brought the same frames.';

  private constructor(private readonly source: PortSource) {
    super(source.line, source.device);
  }

  // Opens the port of an adapter. Throws a Problem, also if A has it, or the reason of `signal`.
  static async open(core: Core, port: SerialPort, first: PortSource, signal: AbortSignal): Promise<Second> {
    const make = await PortSource.open(core, port, 'adapter', 0, signal, first.line);
    return new SecondPort(make());
  }

  get comparison(): Comparison | undefined {
    const { comparedSoFar } = this.line;
    return comparedSoFar?.delays ? comparedSoFar : undefined;
  }

  get ends(): string {
    return this.line.comparedSoFar?.ends ?? '';
  }

  follow(): void {
    this.source.nowUs();
    this.line.advance(this);
  }

  at(us: number): number {
    const { comparedSoFar } = this.line;
    return comparedSoFar ? otherUs(comparedSoFar, us) : NaN;
  }
}
