// A button that shows or hides a curve, with a piece of the curve.

import { make } from '../dom';
import { colorOf, dashOf } from './dash';

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

function swatch(channel: number): SVGSVGElement {
  const namespace = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(namespace, 'svg');
  const line = svg.appendChild(document.createElementNS(namespace, 'path'));
  svg.setAttribute('class', 'swatch');
  svg.setAttribute('viewBox', '0 0 26 8');
  svg.setAttribute('aria-hidden', 'true');
  line.setAttribute('d', 'M0 4h26');
  line.setAttribute('stroke-dasharray', dashOf(channel).join(' '));
  return svg;
}
