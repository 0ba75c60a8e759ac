// Curves of the chosen channels, on a scale that stays, and of sensors, on scales that fit: the newest values are at the right edge, or
// the curves are paused; or a whole recording.

import type uPlot from 'uplot';
import { widthText } from '../clock';
import { byId, setText } from '../dom';
import type { History } from '../history';
import { type Envelope, silenceUs } from '../messages';
import type { Stretch } from '../native';
import { fit, type Sensors } from '../sensors';
import type { Unit } from '../unit';
import { Cursors, CursorTable } from './cursors';
import { doubleClick, Gestures, howTo } from './gestures';
import type { Names } from './names';
import { paletteOf, type Palette } from './palette';
import { axesOf, axisOf, drawBands, keepSize, plotIn, pointedAt, scaleOf, scalesOf, seriesOf, showTime, within } from './plot';
import { AheadStrokes, type Area, type Curve, EnvelopeStrokes, SampleStrokes, type Strokes } from './strokes';
import { Viewport } from './viewport';

const many = 8; // curves: more of them are thinner, and drawn in a quarter of the time where there is no GPU
const restMs = 500; // at most, until a movement by less than a pixel is drawn
const awayMs = 300; // at rest, where no samples are kept, until the recording goes there

// Returns the width of an axis with these texts, in pixels.
const widthOf = (_: uPlot, texts: string[] | null): number => 14 + 7 * Math.max(...(texts ?? ['']).map(({ length }) => length));

export class Curves {
  private readonly root = byId('plot');
  private readonly button = byId('pause');
  private readonly readout = byId('readout');
  private plot?: uPlot;
  private shown = ''; // channels and colours that the plot was made for
  private readonly view = new Viewport();
  private drawn = { edge: NaN, seconds: 0, begin: 0, end: 0, nowUs: 0, atMs: 0 };
  private readonly samples: SampleStrokes;
  private whole?: { envelope: Envelope; strokes: EnvelopeStrokes; ahead: AheadStrokes };
  private strokes: Strokes;
  private nowUs = 0;
  private oldestS = 0;
  private movedMs = Infinity; // when the user has looked elsewhere
  private unit?: Unit;
  private curves: Curve[] = [];
  private rows = false;
  private intervalUs = 0;
  private event?: number; // the moment that is marked, in s
  private readonly cursors: Cursors;
  private readonly table: CursorTable;

  constructor(
    private readonly history: History,
    private readonly channels: ReadonlySet<number>, // that have a curve
    private readonly names: Names,
    private readonly sensors: Sensors,
    private readonly visit: (us: number) => void, // goes to a place of a recording
  ) {
    this.strokes = this.samples = new SampleStrokes(history);
    this.cursors = new Cursors(history, this.view, byId('cursors'), (on) => this.pause(on || this.paused), () => this.told());
    this.table = new CursorTable(byId('cursor-values'), history);
    byId('zoom-in').addEventListener('click', () => this.zoom(1));
    byId('zoom-out').addEventListener('click', () => this.zoom(-1));
    this.button.addEventListener('click', () => this.pause(!this.paused));
    keepSize(this.root, () => this.plot);
    this.root.addEventListener('keydown', (event) => this.key(event));
    new Gestures(this.root, {
      place: () => (this.plot as uPlot).over.getBoundingClientRect(),
      scroll: (part) => this.move((view) => view.scroll(part)),
      zoom: (factor, part) => this.move((view) => view.zoom(factor, part)),
      step: (steps) => this.zoom(steps),
      end: () => this.pause(false),
      reset: () => this.look((view) => view.reset()),
    });
    this.told();
  }

  get paused(): boolean {
    return this.view.paused;
  }

  // The begin and end of what they show, in us.
  get shownUs(): [number, number] {
    return [1e6 * this.view.begin, 1e6 * this.view.edge];
  }

  pause(on: boolean): void {
    this.look((view) => view.pause(on));
  }

  get seconds(): number {
    return this.view.seconds;
  }

  // Marks a moment, or no moment any more.
  mark(us?: number): void {
    this.event = us === undefined ? undefined : us / 1e6;
    this.drawn.edge = NaN;
  }

  // Stops with the marked moment in the middle.
  stop(): void {
    this.look((view) => view.centre(this.event ?? 0));
  }

  // +1 zooms in.
  private zoom(steps: number): void {
    this.move((view) => view.step(steps));
  }

  // Another line: shows its beginning, without cursors and pause. `lengthUs`: of a recording; 0 of a live line.
  enter(lengthUs: number): void {
    this.cursors.clear();
    this.movedMs = Infinity;
    this.whole = undefined;
    this.look((view) => view.enter(lengthUs / 1e6));
  }

  // Redraws what depends on the theme.
  repaint(): void {
    this.shown = '';
  }

  // `intervalUs`: the mean interval of frames or rows. `envelope`: of a whole recording.
  draw(nowUs: number, newest: Stretch | undefined, unit: Unit, intervalUs: number, envelope: Envelope | undefined): void {
    if (envelope !== this.whole?.envelope) {
      const strokes = envelope && new EnvelopeStrokes(envelope);
      this.whole = envelope && strokes && { envelope, strokes, ahead: new AheadStrokes(this.samples, strokes) };
      this.drawn.edge = NaN;
    }
    this.nowUs = Math.min(nowUs, 1e6 * this.view.stoodS);
    this.oldestS = this.history.end > 0 ? this.history.time(this.history.begin) : 0;
    this.view.follow(nowUs / 1e6, this.oldestS, this.whole?.strokes.seconds);
    this.choose();
    this.intervalUs = intervalUs;
    this.rows = newest !== undefined && newest.bytes.length === 0;
    const count = newest?.channels.length || 16;
    const channels = [...this.channels].filter((channel) => channel < count && !this.names.isHidden(channel)).sort((a, b) => a - b);
    this.curves = [...channels.map((column) => ({ column, name: this.names.of(column), unit })), ...this.sensors.drawn()];
    const shown = `${this.curves.map((curve) => `${curve.column} ${curve.unit.axis}`)} ${unit.low} ${unit.high} ${unit.range?.low}`;
    if (shown !== this.shown || !this.plot) {
      this.shown = shown;
      this.unit = unit;
      this.make(this.curves);
    }
    if (this.hasMoved()) {
      const { edge, seconds } = this.drawn;
      fit(this.strokes, this.curves, this.drawn);
      showTime(this.plot as uPlot, edge, seconds);
    }
    this.read();
    this.cursors.draw();
    this.table.draw(this.cursors.samples, this.curves);
  }

  // Chooses what is drawn. Where no samples are kept, the recording goes there as soon as the user rests.
  private choose(): void {
    const { view, whole } = this;
    const strokes = !whole ? this.samples : view.isWide || view.edge < this.oldestS ? whole.strokes : view.isAhead ? whole.ahead : this.samples;
    if (whole) {
      whole.strokes.fromS = 0;
      whole.ahead.nowS = this.nowUs / 1e6;
    }
    if (strokes !== this.strokes) {
      this.strokes = strokes;
      this.drawn.edge = NaN;
    }
    if (performance.now() - this.movedMs > awayMs) {
      this.movedMs = Infinity;
      if (view.isAway && !view.isWide && !whole?.strokes.isFine) {
        this.visit(1e6 * view.edge);
      }
    }
  }

  // The user looks elsewhere.
  private move(act: (view: Viewport) => void): void {
    this.movedMs = performance.now();
    this.look(act);
  }

  private look(act: (view: Viewport) => void): void {
    act(this.view);
    this.told();
  }

  private told(): void {
    this.button.setAttribute('aria-pressed', String(this.paused));
    setText(this.button, this.paused ? 'Continue' : 'Pause');
    setText(byId('window'), widthText(this.view.seconds)); // only look() changes it
  }

  // Returns true if the curves have moved by a pixel: a minute and more is drawn a few times a second.
  private hasMoved(): boolean {
    const { history, drawn } = this;
    const { edge, seconds } = this.view;
    const { begin, end } = history.around(edge - seconds, Math.min(edge, this.view.stoodS));
    const nowMs = performance.now();
    const pixels = (Math.abs(edge - drawn.edge) / seconds) * (this.plot as uPlot).bbox.width;
    const marks = this.hasPosition ? Math.abs(this.nowUs - drawn.nowUs) / seconds / 1e6 : 0;
    const alike = seconds === drawn.seconds && pixels < 1 && marks * (this.plot as uPlot).bbox.width < 1;
    const same = edge === drawn.edge && begin === drawn.begin && end === drawn.end;
    if (alike && (same || nowMs - drawn.atMs < restMs)) {
      return false;
    }
    this.drawn = { edge, seconds, begin, end, nowUs: this.nowUs, atMs: nowMs };
    return true;
  }

  // True if the line's position is within the picture: it is marked.
  private get hasPosition(): boolean {
    return this.view.isAhead || this.strokes === this.whole?.strokes;
  }

  private area(plot: uPlot): Area {
    return { ...plot.bbox, ...this.drawn };
  }

  // The longest time without a frame, in s: after that the curve breaks.
  private get longest(): number {
    return silenceUs(this.rows, this.intervalUs) / 1e6;
  }

  private get thickness(): number {
    return this.curves.length > many || this.strokes === this.whole?.strokes ? 1 : 2;
  }

  // Shows the values at the pointer.
  private read(): void {
    const seconds = pointedAt(this.plot);
    const hint = this.strokes === this.whole?.strokes
      ? 'Each column reaches from the lowest to the highest value. Zoom into a part to go there.'
      : `${this.paused ? `Paused. ${doubleClick} to return to the newest data. ` : ''}${howTo}`;
    setText(this.readout, (seconds !== undefined && this.strokes.textAt(this.curves, seconds)) || hint);
  }

  // Gestures has the other keys.
  private key(event: KeyboardEvent): void {
    if (event.key === ' ') {
      this.pause(!this.paused);
    } else if (event.key.toLowerCase() === 'c' && !event.ctrlKey && !event.metaKey) {
      this.cursors.toggle();
    } else if (event.key === 'Escape' && this.cursors.on) {
      this.cursors.clear();
    } else {
      return;
    }
    event.preventDefault();
  }

  private make(curves: Curve[]): void {
    this.plot?.destroy();
    const palette = paletteOf(this.root);
    const unit = this.unit as Unit;
    const others = [...new Set(curves.map((curve) => curve.unit))].filter(({ axis }) => axis !== undefined);
    this.root.replaceChildren();
    this.drawn.edge = NaN;
    this.plot = plotIn(this.root, {
      scales: {
        ...scalesOf(unit.low, unit.high),
        ...Object.fromEntries(others.map((each) => [scaleOf(each), { auto: false, range: (): [number, number] => [each.low, each.high] }])),
      },
      axes: [
        ...axesOf(unit, palette),
        ...others.map((each) => ({
          ...axisOf(palette), grid: { show: false }, scale: scaleOf(each), side: 1 as const, size: widthOf, values: (_: uPlot, ticks: number[]): string[] => ticks.map(each.text),
        })),
      ],
      series: seriesOf(curves, palette, this.thickness, (plot, curve, pen) => this.strokes.trace(curve, this.area(plot), this.longest, pen)),
      cursor: {
        drag: { x: true, y: false, setScale: false },
        bind: { mousedown: (_, __, select) => (event): null => (event.shiftKey ? select(event) : null), dblclick: () => null },
      },
      hooks: {
        drawClear: [(plot): void => this.bands(plot, palette)],
        setSelect: [
          (plot): void => {
            const { left, width } = plot.select;
            if (width > 4) {
              this.move((view) => view.show(plot.posToVal(left, 'x'), plot.posToVal(left + width, 'x')));
              plot.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
            }
          },
        ],
      },
    });
    this.cursors.enter(this.plot.over);
  }

  // Below the curves: losses, the position on a whole recording, and the moment that is marked.
  private bands(plot: uPlot, palette: Palette): void {
    drawBands(plot, this.strokes, this.area(plot), palette);
    const mark = (seconds: number, color: string): void =>
      within(plot, (ctx, bbox) => {
        ctx.fillStyle = color;
        ctx.fillRect(Math.round(plot.valToPos(seconds, 'x', true)) - 1, bbox.top, 2, bbox.height);
      });
    if (this.hasPosition) {
      mark(this.nowUs / 1e6, palette.muted);
    }
    if (this.event !== undefined) {
      mark(this.event, palette.ink);
    }
  }
}
