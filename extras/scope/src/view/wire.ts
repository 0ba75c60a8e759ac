// The wire of a capture: its edges, from the whole capture down to a bit, and the names of the bits below them.

import { EndUs } from '../border';
import { secondsText, tickText } from '../clock';
import type uPlot from 'uplot';
import { byId, make, setText } from '../dom';
import { Fault, type Wire } from '../messages';
import type { Stretch } from '../native';
import type { RecordingSource } from '../source/recording';
import { Throttle } from '../throttle';
import { Gestures } from './gestures';
import { paletteOf, type Palette } from './palette';
import { axisOf, keepSize, plotIn, pointedAt, scalesOf } from './plot';

const usualUs = 3300; // a frame of 3 ms
const margin = 0.05; // of a frame, at each side
const leastUs = 20; // two bits of 100000 baud
const askMs = 60;
const step = 4; // of a button or a key
const leastPx = 22; // of a bit or a character that has a name
const names = ['start', 'd0', 'd1', 'd2', 'd3', 'd4', 'd5', 'd6', 'd7', 'parity', 'stop', 'stop'];
const short: Record<string, string> = { start: 'st', parity: 'p', stop: 'sp' }; // where a bit is narrower than roomyPx
const roomyPx = 38;
const [firstData, parity, stop] = [1, 9, 10];

const hex = (value: number): string => value.toString(16).toUpperCase().padStart(2, '0');

export class WireView {
  private readonly root = byId('wire-plot');
  private plot?: uPlot;
  private palette?: Palette;
  private source?: RecordingSource;
  private fromUs = 0;
  private zoomedUs?: number; // the width that the user has chosen; without one, a frame has room
  private frame?: Stretch; // the last whole one at the recording's position
  private followed = NaN; // the end of that, or without one the position, in us
  private asked = '';
  private shown?: Wire;
  private readonly asking = new Throttle(askMs);

  constructor() {
    byId('wire-in').addEventListener('click', () => this.step(1));
    byId('wire-out').addEventListener('click', () => this.step(-1));
    keepSize(this.root, () => this.plot);
    new Gestures(this.root, {
      place: () => (this.plot as uPlot).over.getBoundingClientRect(),
      scroll: (part) => this.scroll(part),
      zoom: (factor, part) => this.zoom(factor, part),
      step: (steps) => this.step(steps),
      end: () => this.follow(),
      reset: () => this.reset(),
    });
  }

  // Shows the wire of a capture; without one, or for another recording, nothing.
  show(source: RecordingSource | undefined): void {
    this.source = source?.line.file.carrier ? source : undefined;
    byId('wire').hidden = !this.source;
    const { signals = [], line } = source ?? {};
    const select = byId<HTMLSelectElement>('wire-signal');
    (select.parentElement as HTMLElement).hidden = signals.length < 2;
    select.replaceChildren(...signals.map((signal) => make('option', { value: signal }, signal)));
    select.value = line?.file.signals?.[0] ?? '';
    this.shown = undefined;
    this.asked = '';
    this.followed = NaN;
    this.zoomedUs = this.frame = undefined;
  }

  // Redraws what depends on the theme.
  repaint(): void {
    this.plot?.destroy();
    this.plot = undefined;
  }

  // Call it for each picture, with the newest frame.
  draw(newest?: Stretch): void {
    const { source } = this;
    if (!source) {
      return;
    }
    this.plot ??= this.make();
    this.frame = newest && newest.bytes.length > 0 && source.found?.fault !== Fault.Damage ? newest : undefined;
    if ((this.frame?.endUs ?? source.positionUs) !== this.followed) {
      this.follow();
    }
    const columns = Math.max(Math.round(this.plot.bbox.width / devicePixelRatio), 1);
    const wanted = `${this.fromUs} ${this.widthUs} ${columns}`;
    if (wanted !== this.asked && this.asking.due) {
      this.asked = wanted;
      source.line.ask({ kind: 'wire', fromUs: this.fromUs, toUs: this.fromUs + this.widthUs, columns });
    }
    if (source.line.wire && source.line.wire !== this.shown) {
      this.shown = source.line.wire;
      this.plot.setData(pointsOf(this.shown), false);
      this.plot.setScale('x', { min: this.shown.fromUs / 1e6, max: this.shown.toUs / 1e6 });
    }
    setText(byId('wire-width'), widthText(this.widthUs));
    setText(byId('wire-text'), this.text());
  }

  private get lengthUs(): number {
    return (this.source?.lengthUs ?? 0) + EndUs;
  }

  private get widthUs(): number {
    const { frame } = this;
    return this.zoomedUs ?? (frame ? (1 + 2 * margin) * (frame.endUs - frame.beginUs) : usualUs);
  }

  private within(us: number): number {
    return Math.max(Math.min(us, this.lengthUs - this.widthUs), Math.min(0, this.lengthUs - this.widthUs) / 2);
  }

  private scroll(part: number): void {
    this.fromUs = this.within(this.fromUs + part * this.widthUs);
  }

  private zoom(factor: number, part: number): void {
    const widthUs = Math.min(Math.max(factor * this.widthUs, leastUs), 1.05 * this.lengthUs);
    this.fromUs += part * (this.widthUs - widthUs);
    this.zoomedUs = widthUs;
    this.fromUs = this.within(this.fromUs);
  }

  private step(steps: number): void {
    this.zoom(step ** -steps, 0.5);
  }

  private reset(): void {
    this.zoomedUs = undefined;
    this.follow();
  }

  // Goes to the last whole frame, with its end at the right, or with its beginning at the left if there is no room for all of it.
  private follow(): void {
    const { frame, widthUs } = this;
    this.followed = frame?.endUs ?? this.source?.positionUs ?? 0;
    if (!frame) {
      this.fromUs = this.within(this.followed - widthUs);
      return;
    }
    const { beginUs, endUs } = frame;
    const marginUs = margin * (endUs - beginUs);
    const fits = widthUs >= endUs - beginUs;
    this.fromUs = fits ? this.within(Math.max(beginUs - marginUs, endUs + marginUs - widthUs)) : beginUs - marginUs;
  }

  // Returns what is at the pointer, or in the middle.
  private text(): string {
    const { plot, shown } = this;
    if (!plot || !shown) {
      return '';
    }
    if (shown.keptUs > 0 && shown.toUs > shown.keptUs) {
      return `Edges are kept up to ${secondsText(shown.keptUs)}: there was no room for more.`;
    }
    const us = 1e6 * (pointedAt(plot) ?? (shown.fromUs + shown.toUs) / 2e6);
    const at = shown.characters.filter((character) => character.us <= us).at(-1);
    if (!at || us > at.us + names.length * shown.bitUs) {
      return shown.characters.length > 0 ? `${secondsText(us, 6)}: the line is idle.` : secondsText(us, 6);
    }
    const bit = Math.min(Math.floor((us - at.us) / shown.bitUs), names.length - 1);
    const wrong = [at.parityWrong && 'wrong parity', at.stopWrong && 'wrong stop bit'].filter(Boolean).join(', ');
    const value = bit >= firstData && bit < parity ? ` = ${(at.value >> (bit - firstData)) & 1}` : '';
    return `${hex(at.value)} at ${secondsText(at.us, 6)}${wrong && `, ${wrong}`}; here ${names[bit]}${value}.`;
  }

  private make(): uPlot {
    const palette = (this.palette = paletteOf(this.root));
    this.shown = undefined;
    return plotIn(this.root, {
      padding: [8, 36, 0, 36],
      scales: scalesOf(-0.9, 1.15),
      axes: [
        {
          ...axisOf(palette), size: 28, space: 110,
          values: (_, ticks, __, ___, apart) => ticks.map((tick) => tickText(tick, Math.max(0, -Math.floor(Math.log10(apart) + 1e-9)))),
        },
        { show: false },
      ],
      series: [{}, { stroke: palette.curves[0], width: 1.5, points: { show: false } }],
      hooks: { draw: [(plot): void => this.names(plot)] },
    });
  }

  // Writes the characters and the names of their bits below the edges, as far as there is room.
  private names(plot: uPlot): void {
    const { shown, palette } = this;
    if (!shown || !palette) {
      return;
    }
    const { ctx } = plot;
    const pixel = devicePixelRatio;
    const x = (us: number): number => plot.valToPos(us / 1e6, 'x', true);
    const bitPx = x(shown.fromUs + shown.bitUs) - x(shown.fromUs);
    const [named, detailed] = [10 * bitPx > leastPx * pixel, bitPx > leastPx * pixel];
    ctx.save();
    ctx.textAlign = 'center';
    ctx.textBaseline = 'middle';
    ctx.font = `${12 * pixel}px system-ui, sans-serif`;
    const write = (text: string, us: number, y: number, wrong: boolean): void => {
      ctx.fillStyle = wrong ? palette.alarm : palette.ink;
      ctx.fillText(text, x(us), plot.valToPos(y, 'y', true));
    };
    for (const { us, value, parityWrong, stopWrong } of named ? shown.characters : []) {
      const isWrong = parityWrong || stopWrong;
      ctx.strokeStyle = isWrong ? palette.alarm : palette.muted;
      ctx.lineWidth = pixel;
      ctx.strokeRect(x(us), plot.valToPos(-0.45, 'y', true), 11 * bitPx, plot.valToPos(-0.85, 'y', true) - plot.valToPos(-0.45, 'y', true));
      write(hex(value) + (isWrong ? ' !' : ''), us + 5.5 * shown.bitUs, -0.65, isWrong);
      names.forEach((name, bit) => {
        const wrong = (bit === parity && parityWrong) || (bit === stop && stopWrong);
        if (detailed) {
          write(bitPx < roomyPx * pixel ? (short[name] ?? name) : name, us + (bit + 0.5) * shown.bitUs, -0.3, wrong);
        }
      });
    }
    ctx.restore();
  }
}

// Returns the edges as points of a line: two at each edge, and those of a column in which both levels were.
function pointsOf({ fromUs, toUs, edges, isHigh, levels }: Wire): uPlot.AlignedData {
  const [xs, ys]: [number[], (number | null)[]] = [[], []];
  const put = (us: number, level: number | null): void => {
    xs.push(us / 1e6);
    ys.push(level);
  };
  if (edges) {
    let level = Number(isHigh);
    edges.forEach((us, i) => {
      put(Math.max(us, fromUs), i > 0 && us > fromUs ? 1 - level : level);
      put(Math.max(us, fromUs), level);
      level = 1 - level;
    });
    if (edges.length > 0) {
      put(toUs, 1 - level);
    }
  } else if (levels) {
    levels.forEach((mask, i) => {
      const us = fromUs + ((i + 0.5) / levels.length) * (toUs - fromUs);
      put(us, mask === 0 ? null : mask & 1 ? 0 : 1);
      put(us, mask === 0 ? null : mask & 2 ? 1 : 0);
    });
  }
  return [xs, ys];
}

function widthText(us: number): string {
  const [value, unit] = us < 1000 ? [us, 'µs'] : us < 1e6 ? [us / 1000, 'ms'] : [us / 1e6, 's'];
  return `${+value.toPrecision(3)} ${unit}`;
}
