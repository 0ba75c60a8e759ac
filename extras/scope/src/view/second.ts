// The comparison with a second line: who lost what, the delay, and B's curves under those of A, at the same moments.

import type uPlot from 'uplot';
import { byId, setAttribute, setText } from '../dom';
import type { History } from '../history';
import { LinkState } from '../line';
import type { Second } from '../source/second';
import { type Lane, together } from './curves';
import { stateName } from './link';
import { axesOf, drawBands, keepSize, plotIn, pointedAt, scalesOf, seriesOf, showTime } from './plot';
import { listOf } from './report';
import { type Area, EnvelopeStrokes, SampleStrokes, type Strokes } from './strokes';

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
    keepSize(this.root, () => this.plot);
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
    setAttribute(byId('second-text'), 'aria-live', second?.line.picture.live ? 'off' : 'polite'); // it changes all the time
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
      showTime(this.plot as uPlot, edge, seconds);
    }
    setText(byId('second-readout'), this.read(lane));
  }

  private tell({ comparison, ends, waiting, problem, line }: Second): void {
    const { status: { state, linkQuality }, isPreview, live } = line.picture;
    const quality = state === LinkState.NeverSeen || isPreview ? '' : `, quality ${linkQuality} %`;
    setText(byId('second-link'), problem || `Link: ${stateName(state)}${quality}. ${live?.note ?? ''}`.trim());
    if (!comparison) {
      setText(byId('second-text'), `${waiting} ${ends}`.trim());
      return;
    }
    const { medianUs, leastUs, mostUs, driftPpm, evidence, areDelaysLate, same, different, alone, late, lost, spans, longest } = comparison;
    const later = medianUs < 0 ? 'earlier' : 'later';
    setText(
      byId('second-text'),
      `B is ${ms(Math.abs(medianUs))} ${later} than A (${ms(leastUs)} to ${ms(mostUs)}, drift ${driftPpm.toFixed(1)} µs/s), by ${evidence}${areDelaysLate ? '; inaccurate, since the PC was late' : ''}. ` +
        (ends && `${ends} `) +
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

  private get strokes(): Strokes {
    const { envelope } = (this.second as Second).line;
    return this.lane?.isWhole && envelope ? new EnvelopeStrokes(envelope) : new SampleStrokes(this.history);
  }

  private get history(): History {
    return (this.second as Second).history;
  }

  // Returns B's time at a time of A, in s.
  private other(seconds: number): number {
    return (this.second as Second).at(1e6 * seconds) / 1e6;
  }

  private area(plot: uPlot): Area {
    const { edge, seconds } = this.lane as Lane;
    const { history } = this;
    const right = this.other(edge);
    return { ...plot.bbox, edge: right, seconds, ...history.around(right - seconds, right) };
  }

  // Returns B's values at the pointer.
  private read({ curves }: Lane): string {
    const { history } = this;
    const seconds = pointedAt(this.plot);
    return seconds === undefined || history.end === history.begin ? '' : `B ${this.strokes.textAt(curves, this.other(seconds))}`;
  }

  private make({ curves, unit, palette, thickness }: Lane): void {
    this.plot?.destroy();
    this.drawn = '';
    this.plot = plotIn(this.root, {
      scales: scalesOf(unit.low, unit.high),
      axes: axesOf(unit, palette),
      series: seriesOf(curves, palette, thickness, (plot, curve, pen) => this.strokes.trace(curve, this.area(plot), (this.lane as Lane).longest, pen)),
      cursor: { sync: together },
      hooks: { drawClear: [(plot): void => drawBands(plot, this.strokes, this.area(plot), (this.lane as Lane).palette)] },
    });
  }
}
