// Curves of the chosen channels, on a scale that stays: the newest at the right edge, or a pause to look around in.

import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { setText } from '../dom';
import type { History } from '../history';
import type { Stretch } from '../line';
import type { Unit } from '../unit';
import { dashOf } from './dash';
import { Touch } from './touch';

const windows = [0.5, 1, 2, 5, 10, 20, 30, 60, 120, 240]; // s
const pauseS = 0.1; // without a frame: the curve breaks
const rowPauseS = 1.5; // of a slow sketch three rows
const height = 300;
const many = 8; // curves: more of them are thinner, and drawn in a quarter of the time where there is no GPU
const restMs = 500; // at most, until what has moved by less than a pixel is drawn

export class Curves {
  private plot?: uPlot;
  private shown = ''; // channels and colours that the plot was made for
  private window = 4; // of windows
  private right?: number; // the edge while it is paused, in s
  private now = 0;
  private samples = { begin: 0, end: 0 };
  private drawn = { edge: NaN, seconds: 0, atMs: 0 };
  private unit?: Unit;
  private rows = false;
  private rowS = 0;

  constructor(
    private readonly root: HTMLElement,
    private readonly history: History,
    private readonly chosen: ReadonlySet<number>,
    private readonly ui: { pause: HTMLElement; window: HTMLElement; readout: HTMLElement },
  ) {
    new ResizeObserver(() => this.plot?.setSize({ width: root.clientWidth, height })).observe(root);
    root.addEventListener('keydown', (event) => this.key(event));
    new Touch(root, (part) => this.scroll(part), (steps) => this.zoom(steps));
    root.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    this.told();
  }

  get paused(): boolean {
    return this.right !== undefined;
  }

  pause(on: boolean): void {
    this.right = on ? this.now : undefined;
    this.told();
  }

  // +1: nearer.
  zoom(steps: number): void {
    this.window = Math.min(Math.max(this.window - steps, 0), windows.length - 1);
    this.told();
  }

  // Redraws what depends on the theme.
  repaint(): void {
    this.shown = '';
  }

  // `intervalUs`: from one frame or row to the next, on average.
  draw(nowUs: number, newest: Stretch | undefined, unit: Unit, intervalUs: number): void {
    this.now = nowUs / 1e6;
    this.rowS = intervalUs / 1e6;
    this.rows = newest !== undefined && newest.bytes.length === 0;
    const channels = [...this.chosen].filter((channel) => channel < (newest?.channels.length || 16)).sort((a, b) => a - b);
    const shown = `${channels} ${unit.low} ${unit.high} ${unit.range?.low}`;
    if (shown !== this.shown || !this.plot) {
      this.shown = shown;
      this.unit = unit;
      this.make(channels);
    }
    if (this.hasMoved()) {
      this.redraw();
    }
    this.read(channels);
  }

  private get seconds(): number {
    return windows[this.window];
  }

  private get edge(): number {
    return this.right ?? this.now;
  }

  private told(): void {
    this.ui.pause.setAttribute('aria-pressed', String(this.paused));
    setText(this.ui.pause, this.paused ? 'Go on' : 'Pause');
    setText(this.ui.window, `${this.seconds} s`);
  }

  // By a pixel: of a minute and more it is drawn a few times a second.
  private hasMoved(): boolean {
    const { history, edge, seconds, drawn } = this;
    const begin = Math.max(history.find(edge - seconds) - 1, history.begin);
    const end = Math.min(history.find(edge) + 1, history.end);
    const nowMs = performance.now();
    const pixels = (Math.abs(edge - drawn.edge) / seconds) * (this.plot as uPlot).bbox.width;
    const alike = seconds === drawn.seconds && pixels < 1;
    const same = edge === drawn.edge && begin === this.samples.begin && end === this.samples.end;
    if (alike && (same || nowMs - drawn.atMs < restMs)) {
      return false;
    }
    this.drawn = { edge, seconds, atMs: nowMs };
    this.samples = { begin, end };
    return true;
  }

  private redraw(): void {
    const { edge, seconds } = this.drawn;
    const plot = this.plot as uPlot;
    const ends = [edge - seconds, edge]; // each curve reads the history itself
    plot.setData([ends, ...plot.series.slice(1).map(() => ends)] as uPlot.AlignedData, false);
    plot.setScale('x', { min: edge - seconds, max: edge });
  }

  // What stays at a pixel's height is one stroke: 16 curves of 1100 samples each are drawn sixty times a second.
  private path(plot: uPlot, channel: number, unit: Unit): uPlot.Series.Paths {
    const { history } = this;
    const { edge, seconds } = this.drawn;
    const { left, top, width, height } = plot.bbox;
    const longest = this.rows ? Math.max(rowPauseS, 3 * this.rowS) : pauseS;
    const stroke = new Path2D();
    let [x, y] = [0, 0];
    let before = -Infinity; // the time of x, y
    let owed = false; // the stroke to x, y
    const settle = (): void => {
      if (owed) {
        stroke.lineTo(x, y);
        owed = false;
      }
    };
    for (let sample = this.samples.begin; sample < this.samples.end; sample++) {
      const time = history.time(sample);
      const value = history.value(sample, channel);
      const nextX = Math.round(left + ((time - edge) / seconds + 1) * width);
      const nextY = Math.round(top + ((unit.high - value) / (unit.high - unit.low)) * height);
      if (Number.isNaN(value) || time - before > longest) {
        settle();
        stroke.moveTo(nextX, nextY); // nowhere if it is NaN
      } else if (nextY !== y) {
        settle();
        stroke.lineTo(nextX, nextY);
      } else {
        owed = true;
      }
      [x, y] = [nextX, nextY];
      before = Number.isNaN(value) ? -Infinity : time;
    }
    settle();
    return { stroke };
  }

  // The values at the cursor; without one, nothing.
  private read(channels: number[]): void {
    const plot = this.plot;
    const left = plot?.cursor.left ?? -1;
    if (!plot || left < 0 || this.history.end === 0) {
      setText(this.ui.readout, this.paused ? 'Paused. Drag zooms, arrows scroll, End goes on.' : '');
      return;
    }
    const { begin, end } = this.samples;
    const sample = Math.min(Math.max(this.history.find(plot.posToVal(left, 'x')), begin), end - 1);
    const values = channels.map((channel) => `CH${channel + 1} ${this.unit?.text(this.history.value(sample, channel))}`);
    setText(this.ui.readout, [`${this.history.time(sample).toFixed(3)} s`, ...values].join('   '));
  }

  private key(event: KeyboardEvent): void {
    const scroll = { ArrowLeft: -0.1, ArrowRight: 0.1, PageUp: -1, PageDown: 1 }[event.key];
    if (event.key === ' ') {
      this.pause(!this.paused);
    } else if (event.key === '+' || event.key === '=') {
      this.zoom(1);
    } else if (event.key === '-') {
      this.zoom(-1);
    } else if (event.key === 'End') {
      this.pause(false);
    } else if (scroll !== undefined) {
      this.scroll(scroll);
    } else {
      return;
    }
    event.preventDefault();
  }

  private scroll(part: number): void {
    const right = this.edge + part * this.seconds;
    const oldest = this.history.end > 0 ? this.history.time(this.history.begin) : 0;
    this.right = Math.min(Math.max(right, oldest + 0.1 * this.seconds), this.now);
    this.told();
  }

  // Only with Ctrl (two fingers on a touchpad): else the page scrolls.
  private wheel(event: WheelEvent): void {
    if (event.ctrlKey) {
      event.preventDefault();
      this.zoom(event.deltaY < 0 ? 1 : -1);
    }
  }

  // A part was chosen by dragging: the window that fits it best.
  private zoomTo(from: number, to: number): void {
    const fits = windows.findIndex((seconds) => seconds >= to - from);
    this.window = fits < 0 ? windows.length - 1 : fits;
    this.right = Math.min(to + (this.seconds - (to - from)) / 2, this.now);
    this.told();
  }

  private make(channels: number[]): void {
    this.plot?.destroy();
    const color = (name: string): string => {
      this.root.style.color = `var(${name})`; // a canvas knows neither variables nor light-dark()
      return getComputedStyle(this.root).color;
    };
    const alarm = color('--alarm-band');
    const warning = color('--warning-band');
    const unit = this.unit as Unit;
    const grid = { stroke: color('--grid'), width: 1 };
    const axis = { stroke: color('--muted'), font: '12px system-ui, sans-serif', grid, ticks: { ...grid, size: 4 } };
    const colors = Array.from({ length: 8 }, (_, i) => color(`--c${i}`));
    const { low, high, range } = unit;
    const middle = range ? [range.low, range.centre, range.high] : low < -high / 8 && high > -low / 8 ? [0] : [];
    const ends = [low, ...middle, high];
    this.root.replaceChildren();
    this.root.style.color = '';
    this.drawn.edge = NaN;
    this.plot = new uPlot(
      {
        width: Math.max(this.root.clientWidth, 200),
        height,
        legend: { show: false },
        padding: [8, 4, 0, 0],
        scales: { x: { time: false, auto: false }, y: { auto: false, range: [unit.low, unit.high] } },
        axes: [
          { ...axis, size: 28, values: (_, ticks) => ticks.map((tick) => `${+tick.toFixed(2)} s`) },
          { ...axis, size: 46, splits: () => ends, values: (_, ticks) => ticks.map((tick) => unit.text(tick)) },
        ],
        series: [
          {},
          ...channels.map((channel) => ({
            label: `CH${channel + 1}`,
            stroke: colors[channel % 8],
            width: channels.length > many ? 1 : 2,
            dash: dashOf(channel),
            points: { show: false },
            paths: (plot: uPlot): uPlot.Series.Paths => this.path(plot, channel, unit),
          })),
        ],
        cursor: { y: false, drag: { x: true, y: false, setScale: false }, points: { show: false } },
        hooks: {
          drawClear: [(plot): void => this.bands(plot, alarm, warning)],
          setSelect: [
            (plot): void => {
              const { left, width } = plot.select;
              if (width > 4) {
                this.zoomTo(plot.posToVal(left, 'x'), plot.posToVal(left + width, 'x'));
                plot.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
              }
            },
          ],
        },
      },
      [[], ...channels.map(() => [])],
      this.root,
    );
  }

  // Where the receiver was in failsafe, where radio frames were lost, and where nothing came.
  private bands(plot: uPlot, alarm: string, warning: string): void {
    const { ctx, bbox } = plot;
    const { begin, end } = this.samples;
    const paint = (from: number, to: number, fill: string): void => {
      const left = plot.valToPos(from, 'x', true);
      ctx.fillStyle = fill;
      ctx.fillRect(left, bbox.top, Math.max(plot.valToPos(to, 'x', true) - left, 2), bbox.height);
    };
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    for (let sample = begin; sample < end; ) {
      const failsafe = this.history.failsafe(sample);
      const lost = this.history.lost(sample);
      let last = sample;
      while (last + 1 < end && this.history.failsafe(last + 1) === failsafe && this.history.lost(last + 1) === lost) {
        last++;
      }
      if (failsafe || lost) {
        const next = last + 1 < end ? this.history.time(last + 1) : this.history.time(last);
        paint(this.history.time(sample), next, failsafe ? alarm : warning);
      }
      sample = last + 1;
    }
    ctx.restore();
  }
}
