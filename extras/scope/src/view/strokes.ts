// How samples become strokes, on the screen and in a picture.

import type { History } from '../history';
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

// Draws a curve. It breaks where nothing came for longer than `longest`, in s. Samples at one pixel's height are one
// stroke: 16 curves of 1100 samples each are drawn sixty times a second.
export function trace(history: History, { column, unit }: Pick<Curve, 'column' | 'unit'>, area: Area, longest: number, pen: Pen): void {
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

// Calls `paint` for each stretch in which the receiver was in failsafe, or radio frames were lost: its x and width, in pixels.
export function bands(history: History, area: Area, paint: (x: number, width: number, failsafe: boolean) => void): void {
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
