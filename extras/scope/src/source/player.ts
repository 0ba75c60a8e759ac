// A recording that a worker reads and decodes: the page never waits for it.

import type { Core } from '../core';
import type { FaultMap, Found, Span } from '../faults';
import type { Line, Sink, Status } from '../line';
import type { Answer, Picture, Request } from '../worker/messages';
import PlayingWorker from '../worker/worker?worker&inline';
import type { Problem } from './Source';

const noWorker: Problem = {
  text: 'This browser starts no worker, which the page needs for recordings.',
  remedy: 'Open this page in a browser released this year or last year; or let make scope serve it, if it was opened from disk.',
};

type Opened = Extract<Answer, { kind: 'opened' }>;

export class Player implements Line {
  wantedUs = 0; // the position to play to
  progress?: number; // 0..1, while a position is being reached
  faults?: FaultMap;
  private id = 0; // of the newest request
  private answered = 0;
  private sought = 0; // the newest request that was a seek
  private looking?: { id: number; tell: (us: number, found: Found | null) => void }; // for a fault
  private readonly came: Answer[] = []; // since the last picture
  private text = '';
  private ended?: (text: string) => void;

  private constructor(
    private readonly core: Core,
    private readonly worker: Worker,
    readonly lengthUs: number,
    readonly carrier: string, // of a capture: the signal that carries the line
    private picture: Picture,
  ) {}

  // Reads the file. Throws an Error that says what is wrong with it, a Problem if there is no worker, or the reason of `signal`.
  static async read(core: Core, file: File, signal: AbortSignal, progress: (part: number) => void): Promise<Player> {
    const worker = makeWorker();
    try {
      const { lengthUs, carrier, picture } = await new Promise<Opened>((resolve, reject) => {
        signal.addEventListener('abort', () => reject(signal.reason));
        worker.onerror = (): void => reject(noWorker);
        worker.onmessage = ({ data }: MessageEvent<Answer>): void => {
          if (data.kind === 'progress') {
            progress(data.part);
          } else if (data.kind === 'opened') {
            resolve(data);
          } else if (data.kind === 'failed') {
            reject(new Error(data.error));
          }
        };
        worker.postMessage({ kind: 'open', wasm: core.wasm, file } satisfies Request);
      });
      const player = new Player(core, worker, lengthUs, carrier, picture);
      worker.onmessage = ({ data }: MessageEvent<Answer>): void => player.hear(data);
      worker.onerror = null;
      return player;
    } catch (error) {
      worker.terminate();
      throw error;
    }
  }

  // The line's time.
  get us(): number {
    return this.picture.us;
  }

  seek(us: number): void {
    this.wantedUs = us;
    this.sought = ++this.id;
    this.ask({ kind: 'seek', id: this.id, us });
  }

  // Goes to the next fault after `us`, or after the fault `at`; with `back`, to the one before. `tell` gets the position and the
  // fault, or null if there is no further one. It is not called if another position is sought meanwhile.
  seekFault(us: number, at: Span | undefined, back: boolean, tell: (us: number, found: Found | null) => void): void {
    this.looking = { id: ++this.id, tell };
    this.ask({ kind: 'fault', id: this.id, us, at, back });
  }

  get isLooking(): boolean {
    return this.looking?.id === this.id;
  }

  // The faults at the position: bits 1 << Fault.
  get faultsHere(): number {
    return this.picture.faults;
  }

  // Ignores the time: what was asked for comes with one of the next pictures.
  advance(_nowUs: number, sink: Sink): void {
    for (const answer of this.came.splice(0)) {
      this.show(answer, sink);
    }
    if (this.answered === this.id && this.us < this.wantedUs) {
      this.ask({ kind: 'advance', id: ++this.id, us: this.wantedUs });
    }
  }

  status(): Status {
    return this.picture.status;
  }

  telemetry(): readonly string[] {
    return this.picture.telemetry;
  }

  travel(channel: number): [number, number] | undefined {
    return this.picture.travel[channel];
  }

  resetMarks(): void {
    this.ask({ kind: 'resetMarks' });
  }

  record(): void {
    this.ask({ kind: 'record', on: true });
  }

  takeRecorded(): string {
    const { text } = this;
    this.text = '';
    return text;
  }

  endRecorded(): Promise<string> {
    this.ask({ kind: 'record', on: false });
    return new Promise((resolve) => (this.ended = resolve));
  }

  // Ends the worker; if the end of a recording is awaited, once that was handed over.
  close(): void {
    if (this.ended) {
      const { ended } = this;
      this.ended = (text): void => {
        ended(text);
        this.worker.terminate();
      };
    } else {
      this.worker.terminate();
    }
  }

  private ask(request: Request): void {
    this.worker.postMessage(request);
  }

  private hear(answer: Answer): void {
    if (answer.kind === 'progress') {
      this.progress = answer.part;
    } else if (answer.kind === 'failed') {
      throw new Error(answer.error); // the page shows it
    } else if (answer.kind === 'recorded') {
      this.ended?.(this.takeRecorded() + answer.text);
      this.ended = undefined;
    } else if (answer.kind === 'faults') {
      this.faults = answer.map;
    } else {
      this.came.push(answer);
      if (answer.kind === 'picture' && answer.found !== undefined && this.isLooking) {
        this.sought = answer.found ? answer.id : this.sought;
        this.looking?.tell(answer.us, answer.found);
        this.looking = undefined;
      }
      this.text += answer.kind === 'picture' ? answer.recorded : '';
    }
  }

  private show(answer: Answer, sink: Sink): void {
    if (answer.kind === 'past' && answer.id === this.sought) {
      sink.precede(answer.samples);
    } else if (answer.kind === 'picture' && answer.id >= this.sought) {
      this.picture = answer;
      this.answered = answer.id;
      this.progress = undefined;
      const pieces = answer.records.map((records) => this.core.stretchesIn(records));
      if (answer.jumped) {
        sink.jump(pieces.shift() ?? []);
      }
      pieces.flat().forEach((stretch) => sink.take(stretch));
    }
  }
}

function makeWorker(): Worker {
  try {
    return new PlayingWorker();
  } catch {
    throw noWorker;
  }
}
