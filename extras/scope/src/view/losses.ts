// The share of lost frames over time, as bars, with the numbers below.

import { byId, setAttribute, setText, svg } from '../dom';
import type { History } from '../history';
import { Throttle } from '../throttle';

const drawMs = 500;

const percent = (part: number, all: number): string => `${all > 0 ? ((100 * part) / all).toFixed(1) : '0.0'} %`;

export class LossesView {
  private readonly drawing = new Throttle(drawMs);
  private readonly chart = byId('losses-chart');

  constructor(private readonly history: History) {}

  // `what`: "frames" or "rows".
  draw(nowUs: number, what: string): void {
    if (!this.drawing.due) {
      return;
    }
    const { beginS, widthS, parts, all } = losses(this.history, nowUs / 1e6);
    const recent = { frames: 0, lost: 0 };
    for (const { frames, lost } of parts.slice(-Math.max(Math.round(10 / widthS), 1))) {
      recent.frames += frames;
      recent.lost += lost;
    }
    const text =
      `${percent(all.lost, all.frames)} of ${all.frames} ${what} were lost by radio, ${percent(recent.lost, recent.frames)} in ` +
      `the last ten seconds; ${percent(all.failsafe, all.frames)} came in failsafe.`;
    setText(byId('losses-text'), all.frames > 0 ? text : `No ${what} yet.`);
    const worst = Math.max(0, ...parts.map(({ lost, frames }) => lost / Math.max(frames, 1)));
    const top = [0.1, 0.25, 0.5, 1].find((each) => each >= worst) ?? 1;
    this.grow(parts.length);
    parts.forEach(({ frames, lost, failsafe }, i) => {
      const from = beginS + i * widthS;
      const share = (count: number): number => count / frames / top;
      const pieces: [number, string][] = frames > 0 ? [[share(failsafe), 'failsafe'], [share(lost - failsafe), 'lost']] : [[1, 'silence'], [0, '']];
      this.drawBar(i, `${from} to ${from + widthS} s: ${frames > 0 ? percent(lost, frames) : 'silence'}`, pieces);
    });
    setText(byId('losses-top'), `${100 * top} %`);
    setText(byId('losses-from'), parts.length > 0 ? `${beginS} s` : '');
    setText(byId('losses-to'), parts.length > 0 ? `${beginS + parts.length * widthS} s` : '');
  }

  private grow(bars: number): void {
    setAttribute(this.chart, 'viewBox', `0 0 ${Math.max(bars, 1)} 1`);
    while (this.chart.children.length < bars) {
      this.chart.append(svg('g', {}, svg('title'), svg('rect'), svg('rect')));
    }
    while (this.chart.children.length > bars) {
      this.chart.lastElementChild?.remove();
    }
  }

  // `pieces`: from the bottom up the height, 1 for all of it, and the class.
  private drawBar(bar: number, title: string, pieces: [number, string][]): void {
    const [text, ...rects] = Array.from(this.chart.children[bar].children);
    setText(text as HTMLElement, title);
    let y = 1;
    rects.forEach((rect, i) => {
      const [height, name] = pieces[i];
      y -= height;
      const attributes = { x: bar + 0.08, y: y.toFixed(4), width: 0.84, height: height.toFixed(4), class: name };
      Object.entries(attributes).forEach(([key, value]) => setAttribute(rect, key, String(value)));
    });
  }
}

// What came within one bar of the chart.
interface Part {
  frames: number;
  lost: number; // with one of the flags
  failsafe: number;
}

interface Losses {
  beginS: number;
  widthS: number; // of a part
  parts: Part[];
  all: Part;
}

const mostParts = 60;

// Parts begin at whole multiples of their width, so that time going on does not change them.
export function losses(history: History, nowS: number): Losses {
  const oldestS = history.end > 0 ? history.time(history.begin) : nowS;
  const widthS = [1, 2, 5].find((width) => (nowS - oldestS) / width < mostParts - 1) ?? 10;
  const end = Math.floor(nowS / widthS) + 1;
  const begin = history.end > 0 ? Math.max(Math.floor(oldestS / widthS), end - mostParts) : end;
  const parts = Array.from({ length: end - begin }, () => ({ frames: 0, lost: 0, failsafe: 0 }));
  const all = { frames: 0, lost: 0, failsafe: 0 };
  for (let sample = history.begin; sample < history.end; sample++) {
    const part = parts[Math.floor(history.time(sample) / widthS) - begin];
    const failsafe = history.failsafe(sample);
    const lost = failsafe || history.lost(sample);
    for (const into of part ? [part, all] : [all]) {
      into.frames++;
      into.lost += Number(lost);
      into.failsafe += Number(failsafe);
    }
  }
  return { beginS: begin * widthS, widthS, parts, all };
}
