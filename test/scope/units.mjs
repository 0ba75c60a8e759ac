// What of the page is no view: its memory of the newest, the part of the time that is shown, statistics. No browser.
//   node units.mjs [SEED]
import assert from 'node:assert/strict';
import { load } from './modules.mjs';

const { History } = await load('history');
const { Viewport } = await load('view/viewport');
const { intervals, losses } = await load('statistics');

let seed = Number(process.argv[2] ?? 20181);
const first = seed;
const random = () => (seed = (seed * 1103515245 + 12345) % 2147483648) / 2147483648;
let failed = 0;
function check(sentence, show) {
  try {
    show();
    console.log(`ok scope: ${sentence}`);
  } catch (error) {
    failed++;
    console.log(`FAILED scope: ${sentence} (seed ${first})\n${error.stack}`);
  }
}
const filled = (count, flags = () => 0, us = (i) => 9000 * i) => {
  const history = new History();
  for (let i = 0; i < count; i++) history.add({ endUs: us(i), flags: flags(i), channels: [i] });
  return history;
};
const near = (actual, expected) => assert.ok(Math.abs(actual - expected) < 1e-9, `${actual}, not ${expected}`);

check('a history that is full forgets the oldest, and finds the sample next to any time', () => {
  const extra = 1000;
  const history = filled(History.capacity + extra);
  assert.deepEqual([history.begin, history.end], [extra, History.capacity + extra]);
  for (let i = 0; i < 1000; i++) {
    const sample = extra + Math.floor(random() * History.capacity);
    assert.equal(history.nearest(0.009 * sample + 0.0089 * (random() - 0.5)), sample);
    assert.equal(history.value(sample, 0), sample);
  }
  assert.equal(history.nearest(0), extra);
  assert.equal(history.nearest(1e9), history.end - 1);
  assert.equal(new History().nearest(1), 0);
});

check('statistics of a full history are those of what it still has', () => {
  const extra = 1000;
  const history = filled(History.capacity + extra, (i) => (i < extra ? 12 : i % 10 === 0 ? 4 : 0), (i) => (i < extra ? 50000 * i : 50000 * extra + 9000 * (i - extra)));
  const { count, medianUs, longestUs, bins, shorter, longer } = intervals(history);
  assert.deepEqual([count, medianUs, longestUs, shorter, longer], [History.capacity - 1, 9000, 9000, 0, 0]);
  assert.equal(bins.reduce((sum, each) => sum + each), History.capacity - 1);
  const { parts, all } = losses(history, history.time(history.end - 1));
  assert.deepEqual(all, { frames: History.capacity, lost: Math.ceil(History.capacity / 10), failsafe: 0 });
  assert.ok(parts.length <= 60 && parts.length > 20, `${parts.length}`);
  assert.equal(parts.reduce((sum, { frames }) => sum + frames, 0), History.capacity);
});

check('of a slow board the last ten minutes are shown, and all its rows are counted', () => {
  const history = filled(5000, () => 0, (i) => 1e6 * i);
  const { parts, all, beginS, widthS } = losses(history, 4999);
  assert.deepEqual([parts.length, beginS, widthS, all.frames], [60, 4400, 10, 5000]);
  assert.ok(parts.every(({ frames }) => frames === 10));
});

check('whatever is zoomed, what is pointed at stays, unless an end of the time is reached', () => {
  const view = new Viewport();
  view.follow(300, 0);
  view.pause(true);
  let stayed = 0;
  for (let i = 0; i < 2000; i++) {
    const part = random();
    const time = view.begin + part * view.seconds;
    view.zoom(2 ** (2 * random() - 1), part);
    assert.ok(view.seconds >= 0.1 && view.seconds <= 240 && view.edge <= 300 && view.edge >= 0.1 * view.seconds - 1e-9);
    if (view.edge < 300 && view.edge > 0.1 * view.seconds + 1e-9) {
      near(view.begin + part * view.seconds, time);
      stayed++;
    }
    if (i % 10 === 0) view.scroll(random() - 0.5);
  }
  assert.ok(stayed > 1000, `${stayed}`);
});

check('round widths come one after the other, from any width', () => {
  const view = new Viewport();
  view.follow(300, 0);
  const all = [0.5, 1, 2, 5, 10, 20, 30, 60, 120, 240];
  const walk = (step, count) => Array.from({ length: count }, () => {
    view.step(step);
    return view.seconds;
  });
  assert.deepEqual(walk(-1, 6), [20, 30, 60, 120, 240, 240]);
  assert.deepEqual(walk(1, 10), [...all.slice(0, -1).reverse(), 0.5]);
  view.zoom(2.4, 1);
  assert.deepEqual([view.seconds, ...walk(-1, 1)], [1.2, 2]);
  view.zoom(0.6, 1);
  assert.deepEqual([view.seconds, ...walk(1, 1)], [1.2, 1]);
});

process.exit(failed > 0 ? 1 : 0);
