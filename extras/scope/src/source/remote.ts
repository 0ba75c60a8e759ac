// A line that is read and decoded elsewhere, mostly in a worker: the page never waits for it.

import type { Core } from '../core';
import type { Answer, Envelope, FaultMap, Flight, Live, Open, Opening, Picture, Problem, Request, Samples, Wire } from '../messages';
import type { Stretch } from '../native';
import { type Out, serve } from '../worker/live';
import { findPort } from '../worker/portFeed';

const noWorker: Problem = {
  text: 'This browser cannot start a worker, which the page needs for recordings.',
  remedy: 'Use a browser released this year or last year. If you opened the page from disk, serve it with make scope.',
};

const failed: Problem = {
  text: 'The decoder has failed.',
  remedy: 'The page shows old data. Save the recording, then choose a source again or reload the page.',
};

const largest = 2e9; // bytes; a recording has a bound of its own, in hours

type Opened = Extract<Answer, { kind: 'opened' }>;
type Looked = Omit<Extract<Request, { kind: 'fault' }>, 'id'> | Omit<Extract<Request, { kind: 'event' }>, 'id'>;

// Receives the stretches of a line.
export interface Sink {
  take(stretch: Stretch): void;
  // The line has jumped: all that was taken belongs to another place. `recalled`: the newest stretches before this one.
  jump(recalled: readonly Stretch[]): void;
  // Brings the history before the place that the line has jumped to.
  precede(samples: Samples): void;
}

// A port to a worker, or to what does its work in the page.
interface Channel {
  postMessage(message: Request): void;
  onmessage: ((event: MessageEvent<Answer>) => void) | null;
}

type Progress = (part: number) => void; // 0..1

export class Remote {
  picture: Picture; // the newest one that was taken
  wantedUs = 0; // the position to play to
  progress?: number; // 0..1, while a position is being reached
  faults?: FaultMap;
  flight?: Flight; // of a recording that is decoded
  envelope?: Envelope; // likewise
  wire?: Wire; // the part that was asked for last
  failure?: Problem;
  leaving = (): void => undefined; // called before another place of a recording is sought
  private id = 0; // of the newest request
  private answered = 0;
  private sought = 0; // the newest request that was a seek
  private looking?: { id: number; tell: (picture: Picture) => void }; // for a fault or an event
  private readonly came: Answer[] = []; // since the last picture
  private text = '';
  private reported?: (html: string) => void;
  private ended?: (text: string) => void;

  private constructor(
    private readonly core: Core,
    private readonly channel: Channel,
    readonly file: Opened,
    thread?: Thread, // none: it is decoded in the page
  ) {
    this.picture = file.picture;
    channel.onmessage = ({ data }): void => this.hear(data);
    void thread?.broken.then(() => this.fail());
  }

  // Reads the file; of a capture, the signal `wire`. Throws an Error that says what is wrong with it, a Problem if there is no worker, or
  // the reason of `signal`.
  static async read(core: Core, file: File, wire: string | undefined, signal: AbortSignal, progress: Progress): Promise<Remote> {
    if (file.size > largest) {
      throw new Error(`${file.name}: is larger than ${largest / 1e9} GB: sbus summary and sbus csv can read it`);
    }
    const thread = new Thread();
    const channel = thread.ask({ kind: 'open', wasm: core.wasm, file, signal: wire });
    try {
      const aborted = new Promise<never>((_, reject) => signal.addEventListener('abort', () => reject(signal.reason)));
      const remote = await Promise.race([aborted, Remote.opened(core, channel, progress, thread)]);
      if (!remote) {
        throw noWorker;
      }
      return remote;
    } catch (error) {
      channel.postMessage({ kind: 'close' });
      throw error;
    }
  }

  // Opens a live line: in a worker, if one can read it, otherwise in the page. `port`: the one at that place. Throws the reason of
  // `signal`, or an Error.
  static async live(core: Core, opening: Opening, signal: AbortSignal, port?: SerialPort): Promise<Remote> {
    const request: Live = { kind: 'live', wasm: core.wasm, opening };
    const thread = Thread.ofLiveLines;
    let remote = thread && (await Remote.opened(core, thread.ask(request), undefined, thread));
    if (!remote) {
      const [channel, out] = channelInPage();
      void serve(request, out, async (place) => (await findPort(place)) ?? port);
      remote = (await Remote.opened(core, channel)) as Remote; // the page has the port
    }
    if (signal.aborted) {
      remote.close();
      signal.throwIfAborted();
    }
    return remote;
  }

  // Returns undefined if the line cannot be opened there.
  private static async opened(core: Core, channel: Channel, progress?: Progress, thread?: Thread): Promise<Remote | undefined> {
    const opened = await Promise.race([firstAnswer(channel, progress), ...(thread ? [thread.broken] : [])]);
    return opened && new Remote(core, channel, opened, thread);
  }

  // What decodes the line has failed: nothing comes any more.
  private fail(): void {
    this.failure = failed;
    this.ended?.(this.takeRecorded());
    this.ended = undefined;
  }

  // The line's time.
  get us(): number {
    return this.picture.us;
  }

  seek(us: number): void {
    this.leaving();
    this.wantedUs = us;
    this.sought = ++this.id;
    this.ask({ kind: 'seek', id: this.id, us });
  }

  // Goes to a fault or an event. Calls `tell` with the picture there; not at all if the page seeks another position first.
  look(request: Looked, tell: (picture: Picture) => void): void {
    this.leaving();
    this.looking = { id: ++this.id, tell };
    this.ask({ ...request, id: this.id });
  }

  get isLooking(): boolean {
    return this.looking?.id === this.id;
  }

  // Returns the report of a flight that is known, as a page of its own.
  report(): Promise<string> {
    return new Promise((resolve) => {
      this.reported = resolve;
      this.ask({ kind: 'report' });
    });
  }

  // Hands over all that has come, and asks for what is wanted: that comes with one of the next pictures.
  advance(sink: Sink): void {
    for (const answer of this.came.splice(0)) {
      this.show(answer, sink);
    }
    if (this.answered === this.id && this.us < this.wantedUs) {
      this.ask({ kind: 'advance', id: ++this.id, us: this.wantedUs });
    }
  }

  // Returns what was recorded since the last call.
  takeRecorded(): string {
    const { text } = this;
    this.text = '';
    return text;
  }

  // Ends the recording. Returns the rest of it.
  endRecorded(): Promise<string> {
    if (this.failure) {
      return Promise.resolve(this.takeRecorded());
    }
    return new Promise((resolve) => {
      this.ended = resolve;
      this.ask({ kind: 'record', on: false });
    });
  }

  // Ends what decodes the line; if the end of a recording is awaited, once that was handed over.
  close(): void {
    if (this.ended) {
      const { ended } = this;
      this.ended = (text): void => {
        ended(text);
        this.ask({ kind: 'close' });
      };
    } else {
      this.ask({ kind: 'close' });
    }
  }

  ask(request: Request): void {
    this.channel.postMessage(request);
  }

  private hear(answer: Answer): void {
    switch (answer.kind) {
      case 'progress': this.progress = answer.part; break;
      case 'failed': this.fail(); break;
      case 'recorded':
        this.ended?.(this.takeRecorded() + answer.text);
        this.ended = undefined;
        break;
      case 'faults': this.faults = answer.map; break;
      case 'envelope': this.envelope = answer.envelope; break;
      case 'flight': this.flight = answer.flight; break;
      case 'report': this.reported?.(answer.html); break;
      case 'wire': this.wire = answer; break;
      case 'past': this.came.push(answer); break;
      case 'picture':
        this.came.push(answer);
        this.text += answer.recorded;
        if ((answer.found !== undefined || answer.event !== undefined) && this.isLooking) {
          this.sought = answer.jumped ? answer.id : this.sought;
          this.looking?.tell(answer);
          this.looking = undefined;
        }
        break;
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

// Returns what a line opens with, or undefined if it is refused there. Throws an Error that says why it cannot be opened.
function firstAnswer(channel: Channel, progress?: Progress): Promise<Opened | undefined> {
  return new Promise((resolve, reject) => {
    channel.onmessage = ({ data }): void => {
      if (data.kind === 'progress') {
        progress?.(data.part);
      } else if (data.kind === 'failed') {
        reject(new Error(data.error));
      } else {
        resolve(data.kind === 'opened' ? data : undefined);
      }
    };
  });
}

// Returns both ends of a channel within the page, which delivers at once.
function channelInPage(): [Channel, Out] {
  const channel: Channel = { onmessage: null, postMessage: (data) => out.onmessage?.({ data } as MessageEvent<Request>) };
  const out: Out = { onmessage: null, postMessage: (data) => channel.onmessage?.({ data } as MessageEvent<Answer>), close: () => undefined };
  return [channel, out];
}

function makeWorker(): Worker {
  const url = URL.createObjectURL(new Blob([WORKER], { type: 'text/javascript' }));
  try {
    return new Worker(url);
  } catch {
    throw noWorker;
  } finally {
    setTimeout(() => URL.revokeObjectURL(url), 60000);
  }
}

// A worker: of all live lines, since within one a port is closed before it is opened again; or of a recording.
class Thread {
  private static live?: Thread;
  readonly broken: Promise<undefined>;
  private readonly worker = makeWorker();

  constructor() {
    const { worker } = this;
    this.broken = new Promise((resolve) => {
      worker.onerror = (event): void => {
        event.preventDefault(); // the page says it
        Thread.live = Thread.live === this ? undefined : Thread.live;
        worker.terminate();
        resolve(undefined);
      };
    });
  }

  // None if none starts here.
  static get ofLiveLines(): Thread | undefined {
    try {
      return (Thread.live ??= new Thread());
    } catch {
      return undefined;
    }
  }

  // Asks for a line, which answers at the channel.
  ask(request: Open | Live): Channel {
    const { port1, port2 } = new MessageChannel();
    this.worker.postMessage(request, [port2]);
    return port1;
  }
}
