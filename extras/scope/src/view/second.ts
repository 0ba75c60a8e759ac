// The comparison with a second line: who lost what, the delay, and B's curves under those of A, at the same moments.

import uPlot from 'uplot';
import { byId, setAttribute, setText } from '../dom';
import { LinkState } from '../line';
import type { Second } from '../source/second';
import { ticksOf } from '../unit';
import { type Lane, together } from './curves';
import { stateNames } from './link';
import { colorOf, dashOf } from './dash';
import { listOf } from './report';
import { type Area, bands, type Curve, trace } from './strokes';

const names = ['A', 'B'];
const ms = (us: number): string => `${(us / 1000).toFixed(2)} ms`;
const counted = (count: number, what: string): string => `${count} ${what}${count === 1 ? '' : 's'}`;

export class SecondView {
  private readonly card = byId('second');
  private readonly root = byId('second-plot');
  private readonly lists = byId('second-lists');
  private plot?: uPlot;
  private lane?: Lane;
  private second?: Second;
  private shown = ''; // what the plot was made for
  private drawn = ''; // what it was drawn with
  private told = '';

  // `visit`: goes to a time of A, in us.
  constructor(
    private readonly visit: (us: number) => void,
    close: () => void,
  ) {
    byId('second-close').addEventListener('click', close);
    new ResizeObserver(() => this.plot?.setSize({ width: this.root.clientWidth, height: this.root.clientHeight })).observe(this.root);
  }

  // Shows a second line, or none.
  show(second: Second | undefined): void {
    this.second = second;
    this.card.hidden = !second;
    this.told = '';
    this.drawn = '';
    this.lists.replaceChildren();
    setText(byId('second-title'), second ? `B, ${second.name}` : '');
    setText(byId('second-text'), '');
    setAttribute(byId('second-text'), 'aria-live', second?.line.live ? 'off' : 'polite'); // it changes all the time
  }

  // Redraws what depends on the theme.
  repaint(): void {
    this.shown = '';
  }

  // Call it for each picture, after the curves. `lane`: as A is shown.
  draw(lane: Lane | undefined): void {
    const { second } = this;
    if (!second || !lane) {
      return;
    }
    const { history } = second;
    this.tell(second);
    this.lane = lane;
    const { curves, unit, edge, seconds } = lane;
    const shown = `${curves.map(({ column }) => column)} ${unit.low} ${unit.high}`;
    if (shown !== this.shown || !this.plot) {
      this.shown = shown;
      this.make(lane);
    }
    const drawn = `${shown} ${edge} ${seconds} ${history.begin} ${history.end}`;
    if (drawn !== this.drawn) {
      this.drawn = drawn;
      const plot = this.plot as uPlot;
      const ends = [edge - seconds, edge]; // each curve reads the history itself
      plot.setData(plot.series.map(() => ends) as uPlot.AlignedData, false);
      plot.setScale('x', { min: edge - seconds, max: edge });
    }
    setText(byId('second-readout'), this.read(lane));
  }

  private tell({ comparison, waiting, problem, line }: Second): void {
    const { state, linkQuality } = line.status();
    const quality = state === LinkState.NeverSeen || line.isPreview ? '' : `, quality ${linkQuality} %`;
    setText(byId('second-link'), problem || `Link: ${stateNames[state as LinkState]}${quality}. ${line.live?.note ?? ''}`.trim());
    if (!comparison) {
      setText(byId('second-text'), comparison === null ? 'The recordings have no frame in common.' : waiting);
      return;
    }
    const { medianUs, leastUs, mostUs, driftPpm, isByContents, areDelaysLate, same, different, alone, late, lost, spans, longest } = comparison;
    const later = medianUs < 0 ? 'earlier' : 'later';
    setText(
      byId('second-text'),
      `B is ${ms(Math.abs(medianUs))} ${later} than A (${ms(leastUs)} to ${ms(mostUs)}, drift ${driftPpm.toFixed(1)} µs/s), by ${isByContents ? 'the contents' : 'the times alone'}${areDelaysLate ? '; inaccurate, since the PC was late' : ''}. ` +
        `${counted(same, 'frame')} alike, ${different} different; ${alone[0]} only in A and ${alone[1]} only in B before or after the other.` +
        (late[0] + late[1] > 0 ? ` Not compared: ${late[0]} of A and ${late[1]} of B; the PC was late, or the delay not known yet.` : ''),
    );
    const lists = JSON.stringify([lost, longest]);
    if (lists === this.told) {
      return; // rebuilding a list loses the focus
    }
    this.told = lists;
    this.lists.replaceChildren(
      ...names.map((name, side) => {
        const rows = longest[side].map(([fromUs, toUs, frames]): [number, number, string] => [fromUs, toUs, counted(frames, 'frame')]);
        return listOf(`Lost by ${name}: ${counted(lost[side], 'frame')} in ${counted(spans[side], 'span')}`, rows.sort(([a], [b]) => a - b), this.visit);
      }),
    );
  }

  // Returns B's time at a time of A, in s.
  private other(seconds: number): number {
    return (this.second as Second).at(1e6 * seconds) / 1e6;
  }

  private area(plot: uPlot): Area {
    const { edge, seconds } = this.lane as Lane;
    const { history } = this.second as Second;
    const right = this.other(edge);
    const begin = Math.max(history.find(right - seconds) - 1, history.begin);
    return { ...plot.bbox, edge: right, seconds, begin, end: Math.min(history.find(right) + 1, history.end) };
  }

  // Returns B's values at the pointer.
  private read({ curves }: Lane): string {
    const { history } = this.second as Second;
    const left = this.plot?.cursor.left ?? -1;
    if (!this.plot || left < 0 || history.end === history.begin) {
      return '';
    }
    const sample = history.nearest(this.other(this.plot.posToVal(left, 'x')));
    const values = curves.map(({ column, name, unit }) => `${name} ${unit.text(history.value(sample, column))}`);
    return [`B ${history.time(sample).toFixed(3)} s`, ...values].join('   ');
  }

  private make({ curves, unit, palette, thickness }: Lane): void {
    this.plot?.destroy();
    const grid = { stroke: palette.grid, width: 1 };
    const axis = { stroke: palette.muted, font: '12px system-ui, sans-serif', grid, ticks: { ...grid, size: 4 } };
    this.drawn = '';
    this.plot = new uPlot(
      {
        width: Math.max(this.root.clientWidth, 200),
        height: this.root.clientHeight,
        legend: { show: false },
        padding: [8, 24, 0, 0],
        scales: { x: { time: false, auto: false }, y: { auto: false, range: [unit.low, unit.high] } },
        axes: [
          { ...axis, size: 28, values: (_, ticks) => ticks.map((tick) => (tick < 0 ? '' : `${+tick.toFixed(2)} s`)) },
          { ...axis, size: 46, splits: () => ticksOf(unit), values: (_, ticks) => ticks.map((tick) => unit.text(tick)) },
        ],
        series: [
          {},
          ...curves.map((curve) => ({
            stroke: palette.curves[colorOf(curve.column)],
            width: thickness,
            dash: dashOf(curve.column),
            points: { show: false },
            paths: (plot: uPlot): uPlot.Series.Paths => this.path(plot, curve),
          })),
        ],
        cursor: { y: false, drag: { x: false, y: false }, points: { show: false }, sync: together, bind: { dblclick: () => null } },
        hooks: { drawClear: [(plot): void => this.bands(plot)] },
      },
      [[], ...curves.map(() => [])],
      this.root,
    );
  }

  private path(plot: uPlot, curve: Curve): uPlot.Series.Paths {
    const stroke = new Path2D();
    trace((this.second as Second).history, curve, this.area(plot), (this.lane as Lane).longest, stroke);
    return { stroke };
  }

  private bands(plot: uPlot): void {
    const { ctx, bbox } = plot;
    const { palette } = this.lane as Lane;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    bands((this.second as Second).history, this.area(plot), (x, width, failsafe) => {
      ctx.fillStyle = palette[failsafe ? 'alarm-band' : 'warning-band'];
      ctx.fillRect(x, bbox.top, width, bbox.height);
    });
    ctx.restore();
  }
}
