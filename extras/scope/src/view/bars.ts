// One bar for each channel: raw, microseconds and percent, marks at the lowest and highest value seen, ends of the calibration.

import type { Core } from '../core';
import { byId, make, setAttribute, setText } from '../dom';
import type { Stretch } from '../native';
import type { Remote } from '../source/remote';
import { Throttle } from '../throttle';
import type { Unit } from '../unit';
import type { Names } from './names';
import { chipOf } from './palette';

const textMs = 100; // numbers that change faster cannot be read
const spokenMs = 500; // for screen readers

interface Bar {
  row: HTMLLIElement;
  chip: HTMLButtonElement;
  name: HTMLElement;
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
    private readonly names: Names,
    private readonly line: () => Remote | undefined,
  ) {
    this.list.addEventListener('keydown', (event) => this.key(event));
  }

  draw(newest: Stretch | undefined, unit: Unit, trusted: boolean): void {
    const count = newest?.channels.length || 16;
    this.names.draw(count);
    this.grow(count);
    const text = this.text.due;
    const spoken = text && this.speech.due;
    this.list.classList.toggle('doubtful', !trusted);
    this.list.classList.toggle('plain', !unit.raw); // no µs, no percent
    this.list.classList.toggle('named', this.names.any);
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
    const full = this.names.inFull(channel);
    setText(bar.name, this.names.of(channel));
    setAttribute(bar.chip, 'title', `Show or hide the curve of ${full}`);
    setAttribute(bar.track, 'aria-label', full);
    const travel = this.line()?.picture.travel[channel];
    bar.low.hidden = bar.high.hidden = travel === undefined;
    if (travel) {
      bar.low.style.left = `${share(travel[0]) * 100}%`;
      bar.high.style.left = `${share(travel[1]) * 100}%`;
      setAttribute(bar.track, 'title', `${full}: lowest ${unit.text(travel[0])}, highest ${unit.text(travel[1])}`);
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
    this.bars.forEach((bar, i) => (bar.row.hidden = i >= count || this.names.isHidden(i)));
    const shown = this.shown;
    if (!shown.some(({ chip }) => chip.tabIndex === 0)) {
      shown[0]?.chip.setAttribute('tabindex', '0');
    }
  }

  private get shown(): Bar[] {
    return this.bars.filter(({ row }) => !row.hidden);
  }

  // The channels are one stop of the Tab key: arrows go from one to the next.
  private key(event: KeyboardEvent): void {
    const { shown } = this;
    const at = shown.findIndex(({ chip }) => chip === document.activeElement);
    const to = { ArrowDown: at + 1, ArrowRight: at + 1, ArrowUp: at - 1, ArrowLeft: at - 1, Home: 0, End: shown.length - 1 }[event.key];
    if (at >= 0 && to !== undefined) {
      event.preventDefault();
      const { chip } = shown[Math.min(Math.max(to, 0), shown.length - 1)];
      shown[at].chip.tabIndex = -1;
      chip.tabIndex = 0;
      chip.focus();
    }
  }

  private add(channel: number): Bar {
    const name = make('span', { class: 'name' });
    const chip = chipOf(this.curves, channel, name);
    chip.tabIndex = -1;
    const ends = [0, 1, 2].map((i) => make('i', { class: i === 1 ? 'end middle' : 'end' }));
    const fill = make('span', { class: 'fill' });
    const low = make('b', { class: 'mark low' });
    const high = make('b', { class: 'mark high' });
    const track = make('div', { class: 'track', role: 'meter', 'aria-valuenow': 0, 'aria-valuemin': 0, 'aria-valuemax': 2047 });
    track.append(...ends, fill, low, high);
    const raw = make('span', { class: 'raw' });
    const us = make('span', { class: 'us' });
    const percent = make('span', { class: 'percent' });
    const row = make('li', {}, chip, track, raw, us, percent);
    this.list.append(row);
    return { row, chip, name, track, fill, low, high, ends, raw, us, percent };
  }
}
