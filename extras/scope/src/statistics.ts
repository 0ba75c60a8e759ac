// Statistics of the history: the frame intervals, and the lost radio frames over time. They need no memory but a buffer to sort.

import { History } from './history';
import { roundUp } from './numbers';

const scratch = new Float64Array(History.capacity);

export interface Intervals {
  count: number;
  medianUs: number;
  lowUs: number; // 1 % are shorter
  highUs: number; // 1 % are longer
  longestUs: number;
  firstUs: number; // the middle of the first bin
  widthUs: number; // of a bin
  bins: number[];
  shorter: number; // than the first bin
  longer: number;
}

export const binCount = 31;
const leastWidthUs = 100;

// Returns undefined before the second frame.
export function intervals(history: History): Intervals | undefined {
  const count = history.end - history.begin - 1;
  if (count < 1) {
    return undefined;
  }
  const sorted = scratch.subarray(0, count);
  for (let i = 0; i < count; i++) {
    sorted[i] = Math.round(1e6 * (history.time(history.begin + i + 1) - history.time(history.begin + i)));
  }
  sorted.sort();
  const at = (part: number): number => sorted[Math.round(part * (count - 1))];
  const [lowUs, highUs] = [at(0.01), at(0.99)];
  const widthUs = roundUp(Math.max((highUs - lowUs) / (binCount - 11), leastWidthUs));
  const first = Math.max(Math.round((lowUs + highUs) / 2 / widthUs) - (binCount >> 1), 0);
  const bins = new Array<number>(binCount).fill(0);
  const outside = [0, 0];
  for (const us of sorted) {
    const bin = Math.round(us / widthUs) - first;
    if (bin >= 0 && bin < binCount) {
      bins[bin]++;
    } else {
      outside[bin < 0 ? 0 : 1]++;
    }
  }
  const [shorter, longer] = outside;
  return { count, medianUs: at(0.5), lowUs, highUs, longestUs: sorted[count - 1], firstUs: first * widthUs, widthUs, bins, shorter, longer };
}

// What came within one bar of the chart.
interface Part {
  frames: number;
  lost: number; // with one of the flags
  failsafe: number;
}

export interface Losses {
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
