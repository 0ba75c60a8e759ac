// A live line: a simulated receiver or a port, read and decoded apart from the page's pictures. It runs in a worker; in the page
// where a worker has no ports.

import { Flag, RecordReader } from '../border';
import type { Answer, Live, LiveState, Opening, Picture, Request, Setting } from '../messages';
import { imports, Native } from '../native';
import { type FindPort, PortFeed } from './portFeed';
import { Trials, type Tried } from './trials';

const turnMs = 10; // from one look at a port to the next
const mostRecords = 1 << 15; // that wait for the page: it asks for none while it is in the background

// Where a live line hears requests and answers them: a MessagePort, or what does its work in the page.
export interface Out {
  postMessage(message: Answer, options?: { transfer: Transferable[] }): void;
  onmessage: ((event: MessageEvent<Request>) => void) | null;
  close(): void;
}

// A line's source, as the server has it.
interface Feed extends Tried, Partial<Pick<PortFeed, 'title' | 'events' | 'isUnplugged' | 'replugged'>> {
  // Returns the line's time: all characters complete by then have come. `us`: the page's.
  nowUs(us: number): number;
  close(): void;
}

class SimulatedFeed implements Feed {
  readonly state = 'open';
  readonly settings: readonly Setting[];
  private us = 0;

  constructor(
    private readonly native: Native,
    { simulation: { calibration, channels, noise, line }, port }: Extract<Opening, { kind: 'simulated' }>,
  ) {
    native.calls.openSimulated(Number(calibration), channels, noise, line.baud, Number(line.inverted));
    void this.use(port);
    const bauds = [port.baud, port.baud === 100000 ? 200000 : 100000];
    const ways = [port.inverted, !port.inverted];
    this.settings = ways.flatMap((inverted) => bauds.map((baud) => ({ baud, inverted })));
  }

  nowUs(us: number): number {
    return (this.us = us);
  }

  async use(setting: Setting): Promise<void> {
    this.native.calls.setPort(this.us, setting.baud, Number(setting.inverted));
  }

  close(): void {}
}

class LiveLine {
  private readonly trials: Trials;
  private records: Uint8Array[] = [];
  private count = 0;
  private missedUs?: number; // see Picture
  private us = 0; // the line's time
  private readonly timer?: ReturnType<typeof setInterval>;

  constructor(
    private readonly native: Native,
    private readonly feed: Feed,
    private readonly find: FindPort,
    private readonly out: Out,
  ) {
    this.trials = new Trials(native, feed);
    out.onmessage = ({ data }: MessageEvent<Request>): void => this.hear(data);
    if (feed instanceof PortFeed) {
      this.timer = setInterval(() => this.turn(0), turnMs);
    }
    this.answer({ kind: 'opened', lengthUs: 0, carrier: '', hasTimes: true, picture: this.picture(0, 0) });
  }

  private hear(request: Request): void {
    const { native } = this;
    switch (request.kind) {
      case 'advance': {
        if (!this.timer) {
          this.turn(request.us);
        }
        const picture = this.picture(request.id, this.us);
        this.answer(picture, picture.records.map(({ buffer }) => buffer));
        break;
      }
      case 'use': void this.feed.use(request.setting); break;
      case 'cutWire': native.calls.cutWire(Number(request.cut)); break;
      case 'replugged': void this.find(request.place).then((port) => port && this.feed.replugged?.(port)); break;
      case 'watch': native.watchFor(request.steps); break;
      case 'resetMarks': native.calls.resetMarks(); break;
      case 'sensors': native.transfer(request.sensors, (count) => native.calls.setSensors(count)); break;
      case 'record':
        native.record(request.on);
        if (!request.on) {
          this.answer({ kind: 'recorded', text: native.recorded() });
        }
        break;
      case 'close':
        clearInterval(this.timer);
        this.feed.close();
        this.out.close();
        break;
    }
  }

  // Takes all that has come. At a port only a timer calls it: from one call to the next, the browser hands over what has come
  // meanwhile, also after it was busy; a picture may be drawn before that.
  private turn(us: number): void {
    const { native } = this;
    const nowUs = (this.us = this.feed.nowUs(us));
    native.records(nowUs, (records) => {
      this.records.push(records);
      this.count += records.length / RecordReader.size;
    });
    while (this.count > mostRecords) {
      const oldest = this.records.shift() as Uint8Array;
      this.count -= oldest.length / RecordReader.size;
      native.each(oldest, ({ flags, endUs }) => (this.missedUs ??= flags & Flag.Event ? endUs : undefined));
    }
    void this.trials.tick(native.status(nowUs));
  }

  private picture(id: number, us: number): Picture {
    const { title, state, problem, isUnplugged, events } = this.feed;
    const { note, round } = this.trials;
    const { records, missedUs } = this;
    this.missedUs = undefined;
    this.records = [];
    this.count = 0;
    const live: LiveState = { title, state, problem, isUnplugged, events: events && new Map(events), note, round };
    return { kind: 'picture', id, jumped: false, ...this.native.picture(us), records, faults: 0, live, missedUs };
  }

  private answer(message: Answer, transfer: Transferable[] = []): void {
    this.out.postMessage(message, { transfer });
  }
}

// Opens a live line, which answers at `out`.
export async function serve({ wasm, opening }: Live, out: Out, find: FindPort): Promise<void> {
  try {
    const port = opening.kind === 'port' ? await find(opening.place) : undefined;
    if (opening.kind === 'port' && !port) {
      out.postMessage({ kind: 'refused' } satisfies Answer);
      return;
    }
    const native = Native.of((await WebAssembly.instantiate(wasm as BufferSource, imports)).instance);
    const feed = opening.kind === 'port' ? new PortFeed(native, port as SerialPort, opening.isBoard, opening.baud) : new SimulatedFeed(native, opening);
    new LiveLine(native, feed, find, out);
  } catch (error) {
    out.postMessage({ kind: 'failed', error: (error as Error).message } satisfies Answer);
  }
}
