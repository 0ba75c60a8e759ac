// What a channel's numbers are: raw ones of a frame, or whatever a sketch prints.

import { Kind, type Range, type Stretch } from './core';

export interface Unit {
  raw: boolean; // 0..2047: they can be scaled
  low: number; // the ends of a bar
  high: number;
  range: Range; // -100, 0, +100 %
  text(value: number): string;
}

const whole = (value: number): string => String(Math.round(value));

const raw: Unit = { raw: true, low: 0, high: 2047, range: { low: 172, centre: 992, high: 1811 }, text: whole };
const thousandths: Unit = { raw: false, low: -1250, high: 1250, range: { low: -1000, centre: 0, high: 1000 }, text: whole };
const parts: Unit = { raw: false, low: -1.25, high: 1.25, range: { low: -1, centre: 0, high: 1 }, text: (value) => value.toFixed(3) };

let rows = raw; // until a row says more

export function unitOf(stretch: Stretch | undefined): Unit {
  if (stretch?.kind !== Kind.Row) {
    return raw;
  }
  const values = Array.from(stretch.channels);
  if (values.some((value) => !Number.isInteger(value))) {
    rows = parts;
  } else if (rows === raw && values.some((value) => value < 0)) {
    rows = thousandths;
  }
  return rows;
}

export function forgetUnit(): void {
  rows = raw;
}
