// A button that shows or hides a curve, with a piece of the curve.

import { make, svg } from '../dom';
import { colorOf, dashOf } from './palette';

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
