// Frame intervals as a histogram, and lost frames over time; with the numbers beside them.

import { byId, make, setAttribute, setText, svg } from '../dom';
import type { History } from '../history';
import { intervals, losses, type Intervals, type Losses } from '../statistics';
import { Throttle } from '../throttle';

const drawMs = 500;

interface Bar {
  title: string;
  // From the bottom up: the height, 1 for all of it, and the class.
  pieces: [number, string][];
}

const ms = (us: number): string => (us / 1000).toFixed(us < 1e5 ? 1 : 0);
const percent = (part: number, all: number): string => `${all > 0 ? ((100 * part) / all).toFixed(1) : '0.0'} %`;

export class StatisticsView {
  private readonly drawing = new Throttle(drawMs);

  constructor(private readonly history: History) {}

  // `what`: "frames" or "rows".
  draw(nowUs: number, what: string): void {
    if (!this.drawing.due) {
      return;
    }
    this.drawIntervals(intervals(this.history), what);
    this.drawLosses(losses(this.history, nowUs / 1e6), what);
  }

  private drawIntervals(found: Intervals | undefined, what: string): void {
    const text = found
      ? `${found.count} intervals: median ${ms(found.medianUs)} ms, 98 % from ${ms(found.lowUs)} to ${ms(found.highUs)} ms, ` +
        `longest ${ms(found.longestUs)} ms.`
      : `Waiting for two ${what}.`;
    setText(byId('intervals-text'), text);
    const { bins = [], shorter = 0, longer = 0, firstUs = 0, widthUs = 0 } = found ?? {};
    const most = Math.max(...bins, shorter, longer, 1);
    const height = (count: number): number => Math.log1p(count) / Math.log1p(most); // one of a thousand can be seen
    const middle = (bin: number): number => firstUs + bin * widthUs;
    chart(byId('intervals-chart'), [
      { title: `shorter: ${shorter}`, pieces: [[height(shorter), 'outside']] },
      ...bins.map((count, bin): Bar => ({ title: `${ms(middle(bin))} ms: ${count}`, pieces: [[height(count), '']] })),
      { title: `longer: ${longer}`, pieces: [[height(longer), 'outside']] },
    ]);
    axis('intervals-axis', found ? [`${ms(middle(0))} ms`, `${ms(middle(bins.length >> 1))} ms`, `${ms(middle(bins.length - 1))} ms`] : []);
  }

  private drawLosses({ beginS, widthS, parts, all }: Losses, what: string): void {
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
    chart(byId('losses-chart'), parts.map(({ frames, lost, failsafe }, i): Bar => {
      const from = beginS + i * widthS;
      const share = (count: number): number => count / frames / top;
      return {
        title: `${from} to ${from + widthS} s: ${frames > 0 ? percent(lost, frames) : 'silence'}`,
        pieces: frames > 0 ? [[share(failsafe), 'failsafe'], [share(lost - failsafe), 'lost']] : [[1, 'silence']],
      };
    }));
    setText(byId('losses-top'), `${100 * top} %`);
    axis('losses-axis', parts.length > 0 ? [`${beginS} s`, `${beginS + parts.length * widthS} s`] : []);
  }
}

function axis(id: string, labels: string[]): void {
  const root = byId(id);
  if (root.children.length !== labels.length) {
    root.replaceChildren(...labels.map(() => make('span')));
  }
  labels.forEach((label, i) => setText(root.children[i] as HTMLElement, label));
}

// Draws bars side by side, over the whole width.
function chart(root: HTMLElement, bars: Bar[]): void {
  setAttribute(root, 'viewBox', `0 0 ${Math.max(bars.length, 1)} 1`);
  while (root.children.length < bars.length) {
    root.append(svg('g', {}, svg('title'), svg('rect'), svg('rect')));
  }
  while (root.children.length > bars.length) {
    root.lastElementChild?.remove();
  }
  bars.forEach(({ title, pieces }, x) => {
    const [text, ...rects] = Array.from(root.children[x].children);
    setText(text as HTMLElement, title);
    let y = 1;
    rects.forEach((rect, i) => {
      const [height, name] = pieces[i] ?? [0, ''];
      y -= height;
      const attributes = { x: x + 0.08, y: y.toFixed(4), width: 0.84, height: height.toFixed(4), class: name };
      Object.entries(attributes).forEach(([key, value]) => setAttribute(rect, key, String(value)));
    });
  });
}
