// The unit of the channels' numbers: raw values of a frame, or what a sketch prints, whose unit only the user knows.

import { Kind } from './border';
import type { Envelope } from './messages';
import type { Stretch } from './native';
import { roundUp } from './numbers';

export interface Range {
  low: number;
  centre: number;
  high: number;
}

export interface Unit {
  raw: boolean; // 0..2047: they can be scaled
  low: number; // the ends of a bar
  high: number;
  range?: Range; // -100, 0, +100 %
  axis?: string; // of a sensor: it has an axis of its own, at the right
  text(value: number): string;
}

const whole = (value: number): string => String(Math.round(value));
const asPrinted = (value: number): string => String(+value.toFixed(3));

const raw: Unit = { raw: true, low: 0, high: 2047, range: { low: 172, centre: 992, high: 1811 }, text: whole };

// The units by the value of their option in index.html. Without one of these, numbers are shown as they were printed.
const units: Record<string, Unit> = {
  raw,
  us: { raw: false, low: 860, high: 2140, range: { low: 988, centre: 1500, high: 2012 }, text: whole },
  percent: { raw: false, low: -125, high: 125, range: { low: -100, centre: 0, high: 100 }, text: asPrinted },
  thousandths: { raw: false, low: -1250, high: 1250, range: { low: -1000, centre: 0, high: 1000 }, text: whole },
  parts: { raw: false, low: -1.25, high: 1.25, range: { low: -1, centre: 0, high: 1 }, text: (value) => (Math.round(1000 * value) / 1000 + 0).toFixed(3) },
};

// Returns where an axis has numbers: its ends, and the ends and centre of the range, or 0.
export function ticksOf({ low, high, range }: Unit): number[] {
  const middle = range ? [range.low, range.centre, range.high] : low < -high / 8 && high > -low / 8 ? [0] : [];
  return [low, ...middle, high];
}

export class Units {
  private printed: Unit = { raw: false, low: 0, high: 0, text: asPrinted };

  constructor(private readonly select: HTMLSelectElement) {}

  // `envelope`: of the whole recording, if that is known.
  of(newest: Stretch | undefined, envelope?: Envelope): Unit {
    if (newest?.kind !== Kind.Row) {
      return raw;
    }
    const [least, greatest] = envelope?.ends ?? [0, 0];
    const low = roundUp(Math.min(this.printed.low, least, ...newest.channels));
    const high = roundUp(Math.max(this.printed.high, greatest, ...newest.channels));
    if (low !== this.printed.low || high !== this.printed.high) {
      this.printed = { ...this.printed, low, high };
    }
    return units[this.select.value] ?? this.printed;
  }

  forget(): void {
    this.printed = { ...this.printed, low: 0, high: 0 };
  }
}
