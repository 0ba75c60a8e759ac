// Collects a recording's faults while it is decoded.

import { type Exports, Flag, Gap, Kind, type Record } from '../border';
import { binCount, Fault, faults, type Found, silenceUs, type Span } from '../messages';
import { firstFrom } from '../numbers';

const apartUs = 1000000; // nearer damage is one fault; the others are spans as sbus summary counts them

// The spans of one fault, in the order of time.
class Spans {
  readonly from: number[] = []; // us
  readonly to: number[] = [];

  get count(): number {
    return this.from.length;
  }

  // Spans up to this far apart are one: 0 joins those that meet, -1 none.
  constructor(private readonly apartUs: number) {}

  // Adds a span, which begins later than all before; or goes on with the last one.
  add(fromUs: number, toUs: number): void {
    const last = this.count - 1;
    if (last >= 0 && fromUs - this.to[last] <= this.apartUs) {
      this.to[last] = Math.max(this.to[last], toUs);
    } else {
      this.from.push(fromUs);
      this.to.push(toUs);
    }
  }

  // Returns how many begin by then.
  by(us: number): number {
    return firstFrom(0, this.count, (span) => this.from[span] <= us);
  }
}

export class FaultIndex {
  readonly bins = new Uint8Array(binCount);
  readonly damaged = new Float32Array(binCount); // us in each bin
  private readonly spans = faults.map((fault) => new Spans(fault === Fault.Damage ? apartUs : fault >= Fault.NoFrames ? -1 : 0));
  private readonly on = faults.map(() => false); // at the newest frame or row
  private readonly perUs: number;
  private count = 0; // frames or rows
  private firstUs = 0; // of the first of them
  private isRow = false; // the newest of them is a row

  // `gapOf`: WebAssembly's. `newestUs`: of the newest frame or row; before the first, when the line begins, or undefined before its first
  // bytes.
  constructor(
    endUs: number,
    private readonly gapOf: Exports['gapOf'],
    private newestUs?: number,
  ) {
    this.perUs = binCount / Math.max(endUs, 1);
  }

  // Takes the next stretch of the line.
  take({ endUs, kind, flags, lateUs, damagedUs }: Pick<Record, 'endUs' | 'kind' | 'flags' | 'lateUs' | 'damagedUs'>): void {
    if (damagedUs > 0) {
      this.mark(Fault.Damage, damagedUs, endUs);
    }
    if (kind === Kind.NoFrame || kind === Kind.Extra) {
      this.newestUs ??= endUs;
      return;
    }
    this.isRow = kind === Kind.Row;
    const silent = this.silence(endUs, lateUs);
    const failsafe = (flags & Flag.Failsafe) !== 0;
    this.flag(Fault.Failsafe, failsafe, silent, endUs);
    this.flag(Fault.NoPulses, !this.isRow && (flags & Flag.NoPulses) !== 0, silent, endUs);
    this.flag(Fault.LostFrame, !failsafe && (flags & Flag.LostFrame) !== 0, silent, endUs);
    this.firstUs = this.count++ === 0 ? endUs : this.firstUs;
    this.newestUs = endUs;
  }

  // Ends the recording: nothing more comes up to there.
  finish(us: number): void {
    this.silence(us, 0);
    this.newestUs = Infinity;
  }

  counts(): number[] {
    return this.spans.map(({ count }) => count);
  }

  // Returns true if all faults that begin by then are known.
  knows(us: number): boolean {
    return us < (this.newestUs ?? 0);
  }

  // Returns the faults there: 1 << Fault.
  at(us: number): number {
    return faults.reduce((mask, fault) => {
      const last = this.spans[fault].by(us) - 1;
      return mask | (last >= 0 && this.spans[fault].to[last] >= us ? 1 << fault : 0);
    }, 0);
  }

  // Returns the first that begins after a time, or that follows a fault.
  // `only`: of this kind.
  after(place: Place, only?: Fault): Found | undefined {
    return this.first(only, (fault) => this.passed(fault, place), 1);
  }

  // Returns the last that begins by a time, or that precedes a fault.
  before(place: Place, only?: Fault): Found | undefined {
    return this.first(only, (fault) => {
      const last = this.passed(fault, place) - 1;
      return last >= 0 && order(this.span(fault, last), place) === 0 ? last - 1 : last;
    }, -1);
  }

  private first(only: Fault | undefined, candidate: (fault: Fault) => number, sign: number): Found | undefined {
    const kinds = only === undefined ? faults : [only];
    const all = kinds.map((fault) => [fault, candidate(fault)]).filter(([fault, at]) => at >= 0 && at < this.spans[fault].count);
    const [span] = all.map(([fault, at]) => this.span(fault, at)).sort((one, other) => sign * order(one, other));
    return span && { ...span, number: kinds.reduce((sum, fault) => sum + this.passed(fault, span), 0) };
  }

  // Returns how many spans of a fault begin by that place.
  private passed(fault: Fault, place: Place): number {
    const count = this.spans[fault].by(place.fromUs);
    return count > 0 && order(this.span(fault, count - 1), place) > 0 ? count - 1 : count;
  }

  private span(fault: Fault, at: number): Span {
    return { fault, fromUs: this.spans[fault].from[at], toUs: this.spans[fault].to[at] };
  }

  // Marks a silence since the newest frame or row, or that the PC was late. Returns false if there was neither.
  private silence(us: number, lateUs: number): boolean {
    const fromUs = this.newestUs ?? us;
    const meanUs = (fromUs - this.firstUs) / (this.count - 1); // not known before the second row
    const gap: Gap = this.gapOf(fromUs, us, lateUs, silenceUs(this.isRow, this.count > 1 ? meanUs : Infinity));
    if (gap !== Gap.Ordinary) {
      this.mark(gap === Gap.Late ? Fault.Late : Fault.NoFrames, fromUs, us);
    }
    return gap !== Gap.Ordinary;
  }

  // Marks a flag: it lasts from the first frame that has it to the first that does not, or to a silence.
  private flag(fault: Fault, on: boolean, silent: boolean, us: number): void {
    if (this.on[fault] && !silent) {
      this.mark(fault, this.newestUs as number, us);
    } else if (on) {
      this.mark(fault, us, us);
    }
    this.on[fault] = on;
  }

  private mark(fault: Fault, fromUs: number, toUs: number): void {
    this.spans[fault].add(fromUs, toUs);
    const last = Math.min(Math.floor(toUs * this.perUs), binCount - 1);
    for (let bin = Math.floor(fromUs * this.perUs); bin <= last; bin++) {
      this.bins[bin] |= 1 << fault;
      if (fault === Fault.Damage) {
        this.damaged[bin] += Math.min(toUs, (bin + 1) / this.perUs) - Math.max(fromUs, bin / this.perUs);
      }
    }
  }
}

// A fault, or a time, which comes after all faults that begin then.
type Place = Pick<Span, 'fromUs'> & Partial<Span>;
const order = (one: Place, other: Place): number => one.fromUs - other.fromUs || (one.fault ?? Infinity) - (other.fault ?? Infinity);
