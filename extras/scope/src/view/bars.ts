// One bar for each channel: raw, microseconds and percent, marks at the lowest and highest value seen, ends of the calibration.

import type { Core } from '../core';
import { byId, make, setAttribute, setText } from '../dom';
import type { Stretch } from '../native';
import type { Remote } from '../source/remote';
import { Throttle } from '../throttle';
import type { Unit } from '../unit';
import { chipOf } from './palette';

const textMs = 100; // numbers that change faster cannot be read
const spokenMs = 500; // for screen readers

interface Bar {
  row: HTMLLIElement;
  track: HTMLDivElement;
  fill: HTMLElement;
  low: HTMLElement;
  high: HTMLElement;
  ends: HTMLElement[]; // of the scale: -100, 0, +100 %
  raw: HTMLElement;
  us: HTMLElement;
  percent: HTMLElement;
}

export class Bars {
  private readonly list = byId('bars');
  private readonly bars: Bar[] = [];
  private readonly text = new Throttle(textMs);
  private readonly speech = new Throttle(spokenMs);

  constructor(
    private readonly core: Core,
    private readonly curves: Set<number>, // the channels that have one
    private readonly line: () => Remote | undefined,
  ) {}

  draw(newest: Stretch | undefined, unit: Unit, trusted: boolean): void {
    const count = newest?.channels.length || 16;
    this.grow(count);
    const text = this.text.due;
    const spoken = text && this.speech.due;
    this.list.classList.toggle('doubtful', !trusted);
    this.list.classList.toggle('plain', !unit.raw); // no µs, no percent
    for (let i = 0; i < count; i++) {
      const value = newest ? newest.channels[i] : undefined;
      this.drawBar(this.bars[i], i, value, unit, text, spoken);
    }
  }

  private drawBar(bar: Bar, channel: number, value: number | undefined, unit: Unit, text: boolean, spoken: boolean): void {
    const share = (x: number): number => Math.min(Math.max((x - unit.low) / (unit.high - unit.low), 0), 1);
    const range = unit.raw ? this.core.range(channel) : unit.range;
    const zero = share(range?.centre ?? 0);
    const at = value === undefined ? zero : share(value);
    bar.fill.style.transform = `translateX(${Math.min(at, zero) * 100}%) scaleX(${Math.abs(at - zero)})`;
    if (!text) {
      return;
    }
    const travel = this.line()?.picture.travel[channel];
    bar.low.hidden = bar.high.hidden = travel === undefined;
    if (travel) {
      bar.low.style.left = `${share(travel[0]) * 100}%`;
      bar.high.style.left = `${share(travel[1]) * 100}%`;
      setAttribute(bar.track, 'title', `CH${channel + 1}: lowest ${unit.text(travel[0])}, highest ${unit.text(travel[1])}`);
    }
    bar.ends.forEach((end) => (end.hidden = range === undefined));
    if (range) {
      [range.low, range.centre, range.high].forEach((end, i) => (bar.ends[i].style.left = `${share(end) * 100}%`));
    }
    setText(bar.raw, value === undefined ? '–' : unit.text(value));
    setText(bar.us, value === undefined || !unit.raw ? '–' : String(this.core.microseconds(channel, value)));
    setText(bar.percent, value === undefined || !unit.raw ? '–' : this.core.percent(channel, value).toFixed(1));
    if (spoken) {
      setAttribute(bar.track, 'aria-valuenow', value === undefined ? '0' : unit.text(value));
      setAttribute(bar.track, 'aria-valuemin', String(unit.low));
      setAttribute(bar.track, 'aria-valuemax', String(unit.high));
    }
  }

  private grow(count: number): void {
    while (this.bars.length < count) {
      this.bars.push(this.add(this.bars.length));
    }
    this.bars.forEach((bar, i) => (bar.row.hidden = i >= count));
  }

  private add(channel: number): Bar {
    const name = `CH${channel + 1}`;
    const chip = chipOf(this.curves, channel, make('span', {}, name));
    chip.title = `Show or hide the curve of ${name}`;
    const ends = [0, 1, 2].map((i) => make('i', { class: i === 1 ? 'end middle' : 'end' }));
    const fill = make('span', { class: 'fill' });
    const low = make('b', { class: 'mark low' });
    const high = make('b', { class: 'mark high' });
    const track = make('div', { class: 'track', role: 'meter', 'aria-label': name, 'aria-valuenow': 0, 'aria-valuemin': 0, 'aria-valuemax': 2047 });
    track.append(...ends, fill, low, high);
    const raw = make('span', { class: 'raw' });
    const us = make('span', { class: 'us' });
    const percent = make('span', { class: 'percent' });
    const row = make('li', {}, chip, track, raw, us, percent);
    this.list.append(row);
    return { row, track, fill, low, high, ends, raw, us, percent };
  }
}
