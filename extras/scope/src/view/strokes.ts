// How a line becomes strokes: by its samples, or a whole recording by its envelope.

import { Flag } from '../border';
import { clock, shownSeconds } from '../clock';
import type { History } from '../history';
import type { Envelope } from '../messages';
import type { Unit } from '../unit';

// A curve to draw: a channel, or what a sensor measures.
export interface Curve {
  column: number; // of the history
  name: string;
  unit: Unit;
}

// A Path2D, for example.
export interface Pen {
  moveTo(x: number, y: number): void;
  lineTo(x: number, y: number): void;
}

// Where samples are drawn: in pixels, from `begin` to before `end`.
export interface Area {
  left: number;
  top: number;
  width: number;
  height: number;
  edge: number; // the time at the right, in s
  seconds: number;
  begin: number; // samples
  end: number;
}

type Paint = (x: number, width: number, failsafe: boolean) => void;

export interface Strokes {
  // Draws a curve. It breaks where nothing came for longer than `longest`, in s.
  trace(curve: Pick<Curve, 'column' | 'unit'>, area: Area, longest: number, pen: Pen): void;
  // Calls `paint` for each stretch in which the receiver was in failsafe, or radio frames were lost: its x and width, in pixels.
  bands(area: Area, paint: Paint): void;
  // Returns the least and greatest value of a column; Infinity and -Infinity without any.
  ends(column: number, area: Pick<Area, 'edge' | 'seconds' | 'begin' | 'end'>): [number, number];
  // Returns the time and the values at a time, in s; '' without any.
  textAt(curves: readonly Curve[], seconds: number): string;
}

const textOf = ({ unit }: Curve, value: number): string => (Number.isFinite(value) ? unit.text(value) : '–');

export class SampleStrokes implements Strokes {
  constructor(private readonly history: History) {}

  // Samples at one pixel's height are one stroke: 16 curves of 1100 samples each are drawn sixty times a second.
  trace({ column, unit }: Pick<Curve, 'column' | 'unit'>, area: Area, longest: number, pen: Pen): void {
    const { history } = this;
    const { left, top, width, height, edge, seconds } = area;
    let [x, y] = [0, 0];
    let before = -Infinity; // the time of x, y
    let owed = false; // the stroke to x, y
    const settle = (): void => {
      if (owed) {
        pen.lineTo(x, y);
        owed = false;
      }
    };
    for (let sample = area.begin; sample < area.end; sample++) {
      const time = history.time(sample);
      const value = history.value(sample, column);
      const nextX = Math.round(left + ((time - edge) / seconds + 1) * width);
      const nextY = Math.round(top + ((unit.high - value) / (unit.high - unit.low)) * height);
      if (Number.isNaN(value) || time - before > longest) {
        settle();
        if (!Number.isNaN(value)) {
          pen.moveTo(nextX, nextY);
        }
      } else if (nextY !== y) {
        settle();
        pen.lineTo(nextX, nextY);
      } else {
        owed = true;
      }
      [x, y] = [nextX, nextY];
      before = Number.isNaN(value) ? -Infinity : time;
    }
    settle();
  }

  bands(area: Area, paint: Paint): void {
    const { history } = this;
    const { begin, end } = area;
    const place = (sample: number): number => area.left + ((history.time(sample) - area.edge) / area.seconds + 1) * area.width;
    for (let sample = begin; sample < end; ) {
      const failsafe = history.failsafe(sample);
      const lost = history.lost(sample);
      let last = sample;
      while (last + 1 < end && history.failsafe(last + 1) === failsafe && history.lost(last + 1) === lost) {
        last++;
      }
      if (failsafe || lost) {
        const x = place(sample);
        paint(x, Math.max(place(Math.min(last + 1, end - 1)) - x, 2), failsafe);
      }
      sample = last + 1;
    }
  }

  ends(column: number, { begin, end }: Pick<Area, 'begin' | 'end'>): [number, number] {
    let [low, high] = [Infinity, -Infinity];
    for (let sample = begin; sample < end; sample++) {
      const value = this.history.value(sample, column);
      low = value < low ? value : low;
      high = value > high ? value : high;
    }
    return [low, high];
  }

  // Of the sample that is nearest.
  textAt(curves: readonly Curve[], seconds: number): string {
    const { history } = this;
    if (history.end === history.begin) {
      return '';
    }
    const sample = history.nearest(seconds);
    const values = curves.map((curve) => `${curve.name} ${textOf(curve, history.value(sample, curve.column))}`);
    return [`${shownSeconds(history.time(sample)).toFixed(3)} s`, ...values].join('   ');
  }
}

// A recording's samples up to its position, then its envelope.
export class AheadStrokes implements Strokes {
  nowS = 0; // the position

  constructor(
    private readonly samples: SampleStrokes,
    private readonly envelope: EnvelopeStrokes,
  ) {}

  private get both(): Strokes[] {
    this.envelope.fromS = this.nowS;
    return [this.samples, this.envelope];
  }

  trace(...those: Parameters<Strokes['trace']>): void {
    this.both.forEach((strokes) => strokes.trace(...those));
  }

  bands(...those: Parameters<Strokes['bands']>): void {
    this.both.forEach((strokes) => strokes.bands(...those));
  }

  ends(...those: Parameters<Strokes['ends']>): [number, number] {
    const [[low, high], [least, greatest]] = this.both.map((strokes) => strokes.ends(...those));
    return [Math.min(low, least), Math.max(high, greatest)];
  }

  textAt(curves: readonly Curve[], seconds: number): string {
    return this.both[Number(seconds > this.nowS)].textAt(curves, seconds);
  }
}

// Each pixel's column has a stroke from the least to the greatest value.
export class EnvelopeStrokes implements Strokes {
  fromS = 0; // it draws what comes from then on
  private readonly count: number; // parts
  private readonly partS: number;

  constructor(private readonly envelope: Envelope) {
    this.count = envelope.flags.length;
    this.partS = envelope.partUs / 1e6;
  }

  // True if a part holds hardly more than a frame: there is no more to be seen.
  get isFine(): boolean {
    return this.partS < 0.01;
  }

  // Its length, in s.
  get seconds(): number {
    return this.count * this.partS;
  }

  trace({ column, unit }: Pick<Curve, 'column' | 'unit'>, area: Area, longest: number, pen: Pen): void {
    const { left, top, width, height, edge, seconds } = area;
    const y = (value: number): number => Math.round(top + ((unit.high - value) / (unit.high - unit.low)) * height);
    const [from, to] = this.within(area);
    let [x, low, high] = [NaN, Infinity, -Infinity];
    let last = -Infinity; // the newest part with a value
    let isBroken = true;
    const settle = (): void => {
      if (low <= high) {
        pen[isBroken ? 'moveTo' : 'lineTo'](x, y(low));
        pen.lineTo(x, y(high));
        isBroken = false;
        [low, high] = [Infinity, -Infinity];
      }
    };
    for (let part = from; part < to; part++) {
      const [least, greatest] = this.endsOf(column, part);
      if (least > greatest) {
        continue;
      }
      const nextX = Math.round(left + (((part + 0.5) * this.partS - edge) / seconds + 1) * width);
      const isLate = (part - last - 1) * this.partS > longest;
      if (nextX !== x || isLate) {
        settle();
        isBroken ||= isLate;
        x = nextX;
      }
      low = Math.min(low, least);
      high = Math.max(high, greatest);
      last = part;
    }
    settle();
  }

  bands(area: Area, paint: Paint): void {
    const { flags } = this.envelope;
    const place = (part: number): number => area.left + ((part * this.partS - area.edge) / area.seconds + 1) * area.width;
    const [from, to] = this.within(area);
    let [begin, had] = [from, 0]; // parts with the same flags are one stretch
    for (let part = from; part <= to; part++) {
      const [least, greatest] = part < to ? this.endsOf(0, part) : [0, 0];
      const has = part < to ? flags[part] & (Flag.Failsafe | Flag.LostFrame) : 0;
      if (least <= greatest && has !== had) {
        if (had) {
          paint(place(begin), Math.max(place(part) - place(begin), 2), (had & Flag.Failsafe) !== 0);
        }
        [begin, had] = [part, has];
      }
    }
  }

  ends(column: number, area: Pick<Area, 'edge' | 'seconds'>): [number, number] {
    const [from, to] = this.within(area);
    let [low, high] = [Infinity, -Infinity];
    for (let part = from; part < to; part++) {
      const [least, greatest] = this.endsOf(column, part);
      low = Math.min(low, least);
      high = Math.max(high, greatest);
    }
    return [low, high];
  }

  textAt(curves: readonly Curve[], seconds: number): string {
    const part = this.nearest(Math.floor(seconds / this.partS), curves[0]?.column ?? 0);
    if (part < 0 || part >= this.count) {
      return '';
    }
    const values = curves.map((curve) => {
      const [low, high] = this.endsOf(curve.column, part);
      return `${curve.name} ${textOf(curve, low)}${low < high ? ` to ${textOf(curve, high)}` : ''}`;
    });
    const time = this.isFine ? `${shownSeconds(seconds).toFixed(3)} s` : `${clock(1e6 * part * this.partS, 1)} to ${clock(1e6 * (part + 1) * this.partS, 1)}`;
    return [time, ...values].join('   ');
  }

  // Returns the part with a value of a column that is nearest to one, less than 0.1 s away; without any that part.
  private nearest(part: number, column: number): number {
    for (let away = 0; away * this.partS < 0.1; away++) {
      const found = [part - away, part + away].find((each) => each >= 0 && each < this.count && this.endsOf(column, each)[0] < Infinity);
      if (found !== undefined) {
        return found;
      }
    }
    return part;
  }

  private within({ edge, seconds }: Pick<Area, 'edge' | 'seconds'>): [number, number] {
    return [Math.max(Math.floor((edge - seconds) / this.partS), Math.ceil(this.fromS / this.partS)), Math.min(Math.ceil(edge / this.partS), this.count)];
  }

  private endsOf(column: number, part: number): [number, number] {
    const at = column * this.count + part;
    return [this.envelope.low[at], this.envelope.high[at]];
  }
}
