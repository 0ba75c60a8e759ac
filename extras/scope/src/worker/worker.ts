// Decodes in a thread of its own: plays one recording, of which it reads the file and goes to any place; or reads live lines.

import { EndUs } from '../border';
import { History } from '../history';
import type { Answer, Found, Live, Open, Picture, Request } from '../messages';
import { Throttle } from '../throttle';
import { Decoder } from './decoder';
import { type Out, serve } from './live';
import { findPort } from './portFeed';
import { advanceTo, Past, Search } from './searches';
import { Tape } from './tape';
import { TapeIndex } from './tapeIndex';

const sliceMs = 15; // of work, until messages are read
const pictureMs = 30; // at most, for a picture
const progressMs = 100;
const shownUs = 10000000; // before a place that was sought: what the curves show at first

const sliceEnd = (): number => performance.now() + sliceMs;

class Playing {
  private readonly channel = new MessageChannel();
  private player: Decoder;
  private index: TapeIndex;
  private past?: Past;
  private search?: Search;
  private soughtUs?: number; // the place of a seek that is not done yet
  private readonly waiting: Request[] = []; // until the place that is looked for is reached
  private wanted?: Extract<Request, { kind: 'advance' | 'seek' | 'fault' | 'event' }>;
  private waking = (): void => undefined;
  private isClosed = false;
  private readonly endUs: number;

  // `progress`: tells how much is done, 0..1.
  constructor(
    private readonly module: WebAssembly.Module,
    private readonly tape: Tape,
    private readonly out: Out,
    private readonly progress: (part: number) => void,
  ) {
    this.endUs = tape.lengthUs + EndUs;
    this.player = new Decoder(module, tape);
    this.index = this.newIndex();
  }

  hear(request: Request): void {
    const { calls, reader } = this.player;
    switch (request.kind) {
      case 'resetMarks': calls.resetMarks(); break;
      case 'sensors': this.sense(request.sensors); break;
      case 'wire': this.answer(this.tape.wire(request.fromUs, request.toUs, request.columns)); break;
      case 'watch': this.player.watchFor(request.steps); break;
      case 'report': this.answer({ kind: 'report', html: this.tape.report() }); break;
      case 'record':
        if (this.isLeaving) {
          this.waiting.push(request); // a jump would end it
        } else {
          reader.record(request.on);
          if (!request.on) {
            this.answer({ kind: 'recorded', text: reader.recorded() });
          }
        }
        break;
      case 'seek': case 'advance': case 'fault': case 'event':
        this.wanted = request;
        this.soughtUs = request.kind === 'seek' ? request.us : this.soughtUs;
        this.waking();
        break;
      case 'close':
        this.isClosed = true;
        this.waking();
        break;
    }
  }

  private answer(message: Answer, transfer: Transferable[] = []): void {
    this.out.postMessage(message, { transfer });
  }

  // Lets waiting messages in.
  private turn(): Promise<void> {
    const { port1, port2 } = this.channel;
    return new Promise((resolve) => {
      port1.onmessage = () => resolve();
      port2.postMessage(0);
    });
  }

  // Another place is looked for.
  private get isLeaving(): boolean {
    return this.wanted !== undefined && this.wanted.kind !== 'advance';
  }

  // Decodes with other sensors. A seek follows.
  private sense(sensors: Uint8Array): void {
    const { module, tape } = this;
    const { steps } = this.player;
    tape.sensors = sensors;
    this.player = new Decoder(module, tape);
    this.player.watchFor(steps);
    this.index = this.newIndex();
    this.past = this.search = undefined;
  }

  async run(): Promise<void> {
    while (!this.isClosed) {
      const { wanted } = this;
      if (!this.isLeaving) {
        this.waiting.splice(0).forEach((request) => this.hear(request));
      }
      if (wanted?.kind === 'seek' && (this.index.isComplete || this.index.us >= wanted.us)) {
        this.seek(wanted.id, wanted.us);
      } else if (wanted?.kind === 'seek') {
        this.progress(this.index.us / wanted.us);
        this.index.work(sliceEnd());
      } else if (wanted?.kind === 'fault') {
        this.toFault(wanted);
      } else if (wanted?.kind === 'event') {
        this.toEvent(wanted);
      } else if (wanted) {
        this.advance(wanted.id, wanted.us);
      } else if (this.past) {
        this.workAtPast(this.past);
      } else if (!this.index.isComplete) {
        this.index.work(sliceEnd());
      } else {
        await new Promise<void>((resolve) => (this.waking = resolve));
      }
      await this.turn();
    }
  }

  private newIndex(): TapeIndex {
    const { module, tape, endUs } = this;
    return new TapeIndex(new Decoder(module, tape), tape, endUs, (message) => this.answer(message));
  }

  // Returns a decoder that is at that time, or a little before it.
  private decoderBefore(us: number): Decoder {
    const decoder = new Decoder(this.module, this.tape);
    decoder.restore(this.index.before(Math.max(us, 0)));
    return decoder;
  }

  private workAtPast(past: Past): void {
    const samples = past.work(sliceEnd());
    if (samples) {
      this.past = undefined;
      this.answer({ kind: 'past', id: past.id, samples }, [samples.times.buffer, samples.values.buffer, samples.flags.buffer]);
    }
  }

  private advance(id: number, us: number): void {
    this.wanted = undefined;
    const records: Uint8Array[] = [];
    this.player.advance(us, (part) => records.push(part), performance.now() + pictureMs);
    this.show(id, false, records);
  }

  private seek(id: number, us: number, found?: Found | null, event?: number | null): void {
    this.wanted = this.soughtUs = undefined;
    const { player, index } = this;
    const fromUs = Math.max(us - shownUs, 0);
    player.restore(index.before(fromUs));
    player.advance(fromUs);
    const records = [player.reader.recalled()];
    player.advance(us, (part) => records.push(part));
    if (found) {
      advanceTo(found, player, index.endUs, records);
    }
    this.show(id, true, records, found, event);
    this.past = fromUs > 0 ? new Past(id, this.decoderBefore(fromUs - 1e6 * History.seconds), fromUs) : undefined;
  }

  // Nothing was found: stays where it was looked from, even if a seek to there is not done yet.
  private stay(id: number, found?: null, event?: null): void {
    if (this.soughtUs !== undefined) {
      this.seek(id, this.soughtUs, found, event);
    } else {
      this.show(id, false, [], found, event);
    }
  }

  private toFault({ id, us, at, only, back }: Extract<Request, { kind: 'fault' }>): void {
    const { index } = this;
    const { faults, isComplete, endUs } = index;
    const place = at ?? { fromUs: us };
    const found = back ? faults.before(place, only) : faults.after(place, only);
    if (isComplete || faults.knows(back ? us : (found?.fromUs ?? Infinity))) {
      this.wanted = undefined;
      if (found) {
        this.seek(id, found.fromUs, found);
      } else {
        this.stay(id, null);
      }
    } else {
      this.progress(index.us / endUs);
      index.work(sliceEnd());
    }
  }

  private toEvent({ id, us, steps, afterUs }: Extract<Request, { kind: 'event' }>): void {
    const { index } = this;
    if (this.search?.id !== id) {
      this.search = new Search(id, steps, this.decoderBefore(us - shownUs), us, index.endUs);
    }
    const { search } = this;
    if (!search.work(sliceEnd())) {
      this.progress(search.us / index.endUs);
      return;
    }
    this.wanted = this.search = undefined;
    if (search.found === undefined) {
      this.stay(id, undefined, null);
    } else {
      this.seek(id, Math.min(search.found + afterUs, index.endUs), undefined, search.found);
    }
  }

  private show(id: number, jumped: boolean, records: Uint8Array[], found?: Found | null, event?: number | null): void {
    this.answer({ ...this.picture(id, jumped, records), found, event }, records.map(({ buffer }) => buffer));
  }

  picture(id: number, jumped: boolean, records: Uint8Array[]): Picture {
    const { us, reader } = this.player;
    return { kind: 'picture', id, jumped, ...reader.picture(us), records, faults: this.index.faults.at(us) };
  }
}

// Reads a recording and plays it until it is closed, also while it is read. Then the worker ends.
async function open({ wasm, file, signal }: Open, out: Out): Promise<void> {
  let isClosed = false;
  out.onmessage = ({ data }): void => void (isClosed = data.kind === 'close');
  const telling = new Throttle(progressMs);
  const progress = (part: number): void => {
    if (isClosed) {
      throw new Error('it is closed');
    }
    if (telling.due) {
      out.postMessage({ kind: 'progress', part });
    }
  };
  try {
    const module = new WebAssembly.Module(wasm as BufferSource);
    const tape = new Tape(module);
    const error = await tape.read(file, progress, signal);
    progress(1);
    if (error !== '') {
      out.postMessage({ kind: 'failed', error });
      return;
    }
    const { lengthUs, carrier, signals, note, damage, zeroUs, startUs, hasTimes } = tape;
    const playing = new Playing(module, tape, out, progress);
    out.onmessage = ({ data }): void => playing.hear(data);
    out.postMessage({ kind: 'opened', lengthUs, carrier, signals, note, damage, zeroUs, startUs, hasTimes, picture: playing.picture(0, false, []) });
    await playing.run();
  } catch (error) {
    out.postMessage({ kind: 'failed', error: `${file.name}: cannot be read: ${(error as Error).message}` });
  } finally {
    out.close();
    close();
  }
}

addEventListener('message', ({ data, ports: [out] }: MessageEvent<Open | Live>) => void (data.kind === 'live' ? serve(data, out, findPort) : open(data, out)));
