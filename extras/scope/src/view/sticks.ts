// The sticks as on a radio, from the scaled values of CH1 to CH4: aileron, elevator, throttle, rudder, as most radios send them.

import { Kind } from '../border';
import type { Core } from '../core';
import { byId, make, setText } from '../dom';
import type { Stretch } from '../native';
import { keep, recall } from '../storage';
import { Throttle } from '../throttle';
import type { Unit } from '../unit';

const textMs = 100;
const key = 'stick-mode';
const names = ['aileron', 'elevator', 'throttle', 'rudder'];
const [aileron, elevator, throttle, rudder] = [0, 1, 2, 3];
// By mode: left stick across and up, right stick across and up.
const modes: Record<string, [number, number, number, number]> = {
  1: [rudder, elevator, aileron, throttle],
  2: [rudder, throttle, aileron, elevator],
  3: [aileron, elevator, rudder, throttle],
  4: [aileron, throttle, rudder, elevator],
};

interface Stick {
  place: HTMLElement;
  text: HTMLElement;
}

export class SticksView {
  private readonly select = byId<HTMLSelectElement>('stick-mode');
  private readonly card: HTMLElement;
  private readonly sticks: Stick[];
  private readonly text = new Throttle(textMs);

  constructor(private readonly core: Core) {
    const root = byId('sticks');
    this.card = root.closest('section') as HTMLElement;
    this.sticks = ['Left stick', 'Right stick'].map((name) => {
      const place = make('i', { class: 'stick-at' });
      const text = make('span');
      root.append(make('figure', {}, make('div', { class: 'stick', 'aria-hidden': true }, place), make('figcaption', {}, make('strong', {}, name), text)));
      return { place, text };
    });
    const kept = recall(key) ?? '';
    this.select.value = Object.hasOwn(modes, kept) ? kept : '2';
    this.select.addEventListener('change', () => keep(key, this.select.value));
  }

  draw(newest: Stretch | undefined, unit: Unit, trusted: boolean): void {
    const isRow = newest?.kind === Kind.Row;
    this.card.hidden = isRow && ((!unit.raw && !unit.range) || newest.channels.length < names.length);
    const text = this.text.due;
    const mode = modes[this.select.value];
    this.sticks.forEach(({ place, text: shown }, side) => {
      const axes = mode.slice(2 * side, 2 * side + 2);
      const [x, y] = axes.map((channel) => this.percent(newest, unit, channel));
      const known = x !== undefined && y !== undefined;
      place.hidden = !known;
      place.classList.toggle('doubtful', !trusted);
      if (known) {
        place.style.left = `${50 + 0.4 * limit(x)}%`;
        place.style.top = `${50 - 0.4 * limit(y)}%`;
      }
      if (text) {
        [x, y].forEach((value, i) => {
          const line = (shown.children[i] ?? shown.appendChild(make('span'))) as HTMLElement;
          setText(line, `${names[axes[i]]} ${value === undefined ? '–' : `${Math.round(value) + 0} %`}`);
        });
      }
    });
  }

  // Returns undefined for numbers whose unit is not known.
  private percent(newest: Stretch | undefined, unit: Unit, channel: number): number | undefined {
    const value = newest?.channels[channel];
    if (value === undefined) {
      return undefined;
    }
    if (unit.raw) {
      return this.core.percent(channel, value);
    }
    return unit.range && (200 * (value - unit.range.low)) / (unit.range.high - unit.range.low) - 100;
  }
}

// A stick's square has room for 125 %.
function limit(percent: number): number {
  return Math.min(Math.max(percent, -125), 125);
}
