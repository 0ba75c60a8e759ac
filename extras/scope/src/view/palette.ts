// The theme's colours as numbers, for a canvas: it knows neither variables nor light-dark(). And the curves' dashes.

import { make, svg } from '../dom';
import { History } from '../history';

const names = ['ink', 'muted', 'grid', 'alarm-band', 'warning-band', 'alarm'] as const;
const curves = 8;

export type Palette = Record<(typeof names)[number], string> & { curves: string[] };

// `probe`: an element of the page, whose colour is set and taken back.
export function paletteOf(probe: HTMLElement): Palette {
  const color = (name: string): string => {
    probe.style.color = `var(--${name})`;
    return getComputedStyle(probe).color;
  };
  const palette = Object.fromEntries(names.map((name) => [name, color(name)])) as Omit<Palette, 'curves'>;
  const all = { ...palette, curves: Array.from({ length: curves }, (_, i) => color(`c${i}`)) };
  probe.style.color = '';
  return all;
}

// The dashes of a curve: its colour alone is lost on paper, and to many eyes.

const dashes = [[], [9, 3], [2, 3], [9, 3, 2, 3], [16, 4], [5, 5], [16, 3, 2, 3, 2, 3], [2, 6]];

// A sensor's curves follow the colours and dashes of the first four channels.
const shifted = (column: number): number => (column < History.channels ? column : column + 4);

export const colorOf = (column: number): number => shifted(column) % dashes.length;

// Curves of one colour, such as CH1 and CH9, also differ in their dashes.
export function dashOf(column: number): number[] {
  return dashes[(shifted(column) + Math.floor(column / dashes.length)) % dashes.length];
}

// Returns a button that shows or hides a curve, with a piece of the curve.
export function chipOf(curves: Set<number>, column: number, name: HTMLElement): HTMLButtonElement {
  const chip = make('button', { class: 'chip', 'aria-pressed': String(curves.has(column)) }, swatch(column), name);
  chip.dataset.color = String(colorOf(column));
  chip.addEventListener('click', () => {
    const on = !curves.has(column);
    curves[on ? 'add' : 'delete'](column);
    chip.setAttribute('aria-pressed', String(on));
  });
  return chip;
}

function swatch(column: number): SVGElement {
  const line = svg('path', { d: 'M0 4h26', 'stroke-dasharray': dashOf(column).join(' ') });
  return svg('svg', { class: 'swatch', viewBox: '0 0 26 8', 'aria-hidden': true }, line);
}
