// What the plots have in common: their axes, their curves over a history, and their pointer.

import { shownSeconds } from '../clock';
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { ticksOf, type Unit } from '../unit';
import { colorOf, dashOf, type Palette } from './palette';
import type { Area, Curve, Pen, Strokes } from './strokes';

const lowPx = 260; // a plot that has no room for the ends' texts beside those of the travel's

// Makes a plot that fills an element.
export function plotIn(root: HTMLElement, { cursor, ...options }: Omit<uPlot.Options, 'width' | 'height'>): uPlot {
  const size = { width: Math.max(root.clientWidth, 200), height: root.clientHeight };
  const pointer = { y: false, drag: { x: false, y: false }, points: { show: false }, bind: { dblclick: () => null }, ...cursor };
  return new uPlot({ ...size, legend: { show: false }, padding: [8, 24, 0, 0], ...options, cursor: pointer }, options.series.map(() => []) as unknown as uPlot.AlignedData, root);
}

// Keeps a plot as large as its element.
export function keepSize(root: HTMLElement, plot: () => uPlot | undefined): void {
  new ResizeObserver(() => plot()?.setSize({ width: root.clientWidth, height: root.clientHeight })).observe(root);
}

export function axisOf({ grid: color, muted }: Palette): uPlot.Axis {
  const grid = { stroke: color, width: 1 };
  return { stroke: muted, font: '12px system-ui, sans-serif', grid, ticks: { ...grid, size: 4 } };
}

export const scalesOf = (low: number, high: number): uPlot.Scales => ({ x: { time: false, auto: false }, y: { auto: false, range: [low, high] } });

// Returns the axes of the time and of the channels.
export function axesOf(unit: Unit, palette: Palette): uPlot.Axis[] {
  const axis = axisOf(palette);
  return [
    { ...axis, size: 28, values: (_, ticks) => ticks.map((tick) => (tick < 0 ? '' : `${+shownSeconds(tick).toFixed(2)} s`)) }, // a line begins at 0
    { ...axis, size: 46, splits: () => ticksOf(unit), values: (plot, ticks) => ticks.map((tick, i) => (plot.height < lowPx && ticks.length === 5 && i % 4 === 0 ? '' : unit.text(tick))) },
  ];
}

// Returns the time and the curves. `draw`: draws a curve.
export function seriesOf(curves: readonly Curve[], palette: Palette, width: number, draw: (plot: uPlot, curve: Curve, pen: Pen) => void): uPlot.Series[] {
  const ofCurves = curves.map((curve) => ({
    scale: scaleOf(curve.unit),
    stroke: palette.curves[colorOf(curve.column)],
    width,
    dash: dashOf(curve.column),
    points: { show: false },
    paths: (plot: uPlot): uPlot.Series.Paths => {
      const stroke = new Path2D();
      draw(plot, curve, stroke);
      return { stroke };
    },
  }));
  return [{}, ...ofCurves];
}

export const scaleOf = ({ axis }: Unit): string => (axis === undefined ? 'y' : `sensors ${axis}`);

// Shows some seconds: each curve reads the history itself.
export function showTime(plot: uPlot, edge: number, seconds: number): void {
  const ends = [edge - seconds, edge];
  plot.setData(plot.series.map(() => ends) as uPlot.AlignedData, false);
  plot.setScale('x', { min: edge - seconds, max: edge });
}

// Draws within the axes.
export function within({ ctx, bbox }: uPlot, draw: (ctx: CanvasRenderingContext2D, bbox: uPlot.BBox) => void): void {
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  draw(ctx, bbox);
  ctx.restore();
}

// Marks where the receiver was in failsafe, and where radio frames were lost.
export function drawBands(plot: uPlot, strokes: Strokes, area: Area, palette: Palette): void {
  within(plot, (ctx, bbox) => strokes.bands(area, (x, width, failsafe) => {
    ctx.fillStyle = palette[failsafe ? 'alarm-band' : 'warning-band'];
    ctx.fillRect(x, bbox.top, width, bbox.height);
  }));
}

// Returns the time at the pointer, in s.
export function pointedAt(plot: uPlot | undefined): number | undefined {
  const left = plot?.cursor.left ?? -1;
  return left < 0 ? undefined : plot?.posToVal(left, 'x');
}
