// The curves as they are shown, as an SVG file: it stays sharp at any size, also on paper, and its texts can be edited.

import { shownSeconds, widthText } from '../clock';
import { ticksOf, type Unit } from '../unit';
import { colorOf, dashOf, type Palette } from './palette';
import type { Area, Curve, Strokes } from './strokes';

const width = 1200;
const left = 70;
const right = 20;
const top = 64;
const plotHeight = 420;
const legendHeight = 24;
const legendWidth = 150; // of a name
const sensorWidth = 380; // of a name with a scale

interface Shown {
  title: string;
  curves: Curve[];
  unit: Unit; // of the channels
  times: Pick<Area, 'edge' | 'seconds' | 'begin' | 'end'>;
  longest: number; // s without a frame: the curve breaks
  thickness: number;
}

export function picture(strokes: Strokes, shown: Shown, palette: Palette): string {
  const { title, curves, unit, times, longest, thickness } = shown;
  const area: Area = { ...times, left, top, width: width - left - right, height: plotHeight };
  const bottom = top + plotHeight;
  const each = curves.some((curve) => curve.unit.axis !== undefined) ? sensorWidth : legendWidth;
  const perRow = Math.floor(area.width / each);
  const height = bottom + 40 + legendHeight * Math.ceil(curves.length / perRow);
  const parts: string[] = [];
  const text = (x: number, y: number, words: string, more = ''): void => void parts.push(`<text x="${x}" y="${y}"${more}>${escaped(words)}</text>`);
  const line = (x1: number, y1: number, x2: number, y2: number, stroke: string, more = ''): void =>
    void parts.push(`<line x1="${x1}" y1="${y1}" x2="${x2}" y2="${y2}" ${paint('stroke', stroke)}${more}/>`);

  text(left, 28, title, ` font-size="18" font-weight="600" ${paint('fill', palette.ink)}`);
  text(left, 50, `${widthText(area.seconds)} up to ${shownSeconds(area.edge).toFixed(3)} s`);
  parts.push(`<clipPath id="plot"><rect x="${left}" y="${top}" width="${area.width}" height="${plotHeight}"/></clipPath>`);
  parts.push('<g clip-path="url(#plot)">');
  strokes.bands(area, (x, wide, failsafe) => {
    const fill = paint('fill', palette[failsafe ? 'alarm-band' : 'warning-band']);
    parts.push(`<rect x="${x.toFixed(1)}" y="${top}" width="${wide.toFixed(1)}" height="${plotHeight}" ${fill}/>`);
  });
  parts.push('</g>');
  for (const tick of ticksOf(unit)) {
    const y = top + ((unit.high - tick) / (unit.high - unit.low)) * plotHeight;
    line(left, y, width - right, y, palette.grid);
    text(left - 8, y + 4, unit.text(tick), ' text-anchor="end"');
  }
  const step = stepOf(area.seconds);
  for (let tick = Math.ceil(Math.max(area.edge - area.seconds, 0) / step); tick * step <= area.edge; tick++) {
    const x = +(left + ((tick * step - area.edge) / area.seconds + 1) * area.width).toFixed(1);
    line(x, top, x, bottom, palette.grid);
    text(x, bottom + 18, `${+shownSeconds(tick * step).toFixed(2)} s`, ' text-anchor="middle"');
  }
  curves.forEach((curve, i) => {
    const { column, name, unit: own } = curve;
    const dash = dashOf(column).join(' ') || 'none';
    const stroke = `${paint('stroke', palette.curves[colorOf(column)])} stroke-width="${thickness}" stroke-dasharray="${dash}"`;
    const pen = new Path();
    strokes.trace(curve, area, longest, pen);
    parts.push(
      `<path clip-path="url(#plot)" fill="none" stroke-linejoin="round" ${stroke} d="${pen.text}"><title>${escaped(name)}</title></path>`,
    );
    const [x, y] = [left + (i % perRow) * each, bottom + 44 + legendHeight * Math.floor(i / perRow)];
    parts.push(`<line x1="${x}" y1="${y - 4}" x2="${x + 36}" y2="${y - 4}" ${stroke}/>`);
    text(x + 44, y, own.axis === undefined ? name : `${name}, ${own.text(own.low)} to ${own.text(own.high)}`);
  });
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}"`,
    ` font-family="system-ui, sans-serif" font-size="12" ${paint('fill', palette.muted)}>`,
    `<title>${escaped(title)}</title>`,
    `<rect width="${width}" height="${height}" ${paint('fill', palette.card)}/>`,
    ...parts,
    '</svg>\n',
  ].join('\n');
}

class Path {
  text = '';
  moveTo(x: number, y: number): void {
    this.text += `M${x} ${y}`;
  }
  lineTo(x: number, y: number): void {
    this.text += `L${x} ${y}`;
  }
}

// Returns the step from tick to tick: at most twelve.
function stepOf(seconds: number): number {
  return [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1800].find((step) => seconds / step <= 12) ?? 7200;
}

// SVG 1.1 knows no alpha in a colour, nor do some programs that read it.
function paint(what: 'fill' | 'stroke', color: string): string {
  const [, rgb, alpha] = /^rgba\((.*), ([\d.]+)\)$/.exec(color) ?? [];
  return rgb ? `${what}="rgb(${rgb})" ${what}-opacity="${alpha}"` : `${what}="${color}"`;
}

function escaped(text: string): string {
  // XML 1.0 has no control characters.
  return text.replace(/[\p{Cc}\uFFFE\uFFFF]/gu, ' ').replaceAll('&', '&amp;').replaceAll('<', '&lt;');
}
