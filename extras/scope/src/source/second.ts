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

// Returns B's time at a time of A, in us.
const otherUs = ({ atZeroUs, driftPpm, laterUs }: Comparison, us: number): number => us + atZeroUs + (driftPpm * us) / 1e6 - laterUs;

export abstract class Second implements Sink {
  readonly history = new History();

  protected constructor(
    readonly line: Remote,
    readonly name: string,
  ) {}

  // The text to show until the delay is known.
  abstract readonly waiting: string;

  // Goes to the moment at which A is. Call it for each picture.
  abstract follow(): void;

  // Returns undefined until the delay is known.
  get comparison(): Comparison | undefined {
    const { compared } = this.line;
    return compared?.delays ? compared : undefined;
  }

  // Why frames differ: rates, and ends of channels; or ''.
  get ends(): string {
    return this.line.compared?.ends ?? '';
  }

  // What is wrong with its port or its decoder, or ''.
  get problem(): string {
    const problem = this.line.failure ?? this.line.picture.live?.problem;
    return problem ? `${problem.text} ${problem.remedy}` : '';
  }

  // Returns B's time at a time of A, in us; NaN before it is known.
  at(us: number): number {
    const { compared } = this.line;
    return compared ? otherUs(compared, us) : NaN;
  }

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
  private askedUs = NaN;

  private constructor(
    private readonly first: RecordingSource,
    line: Remote,
    file: File,
  ) {
    super(line, file.name);
  }

  // Reads the file. Throws an Error that says what is wrong with the recording, a Problem, or the reason of `signal`.
  static async read(core: Core, file: File, first: RecordingSource, signal: AbortSignal): Promise<Second> {
    return new SecondRecording(first, await Remote.read(core, { file, beside: first.line }, signal), file);
  }

  get waiting(): string {
    return this.line.compared ? 'The recordings have no frame in common.' : 'Both are decoded and compared.';
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

  follow(): void {
    this.source.nowUs();
    this.line.advance(this);
  }
}
