// The parts of the page that are no view: the history, the viewport, the losses and the faults. No browser.
//   node units.mjs [SEED]
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { load, random as generator, sources } from './modules.mjs';
import { Native } from './native.mjs';

const { History } = await load('history');
const { Viewport } = await load('view/viewport');
const { EnvelopeIndex } = await load('worker/envelope');
const { EnvelopeStrokes, SampleStrokes } = await load('view/strokes');
const { losses } = await load('view/losses');
const { Fault } = await load('messages');
const { FaultIndex } = await load('worker/faultIndex');
const { gapOf } = (await new Native().load()).wasm;

const seed = Number(process.argv[2] ?? 20181);
const random = generator(seed);
let failed = 0;
function check(sentence, show) {
  try {
    show();
    console.log(`ok scope: ${sentence}`);
  } catch (error) {
    failed++;
    console.log(`FAILED scope: ${sentence} (seed ${seed})\n${error.stack}`);
  }
}
const filled = (count, flags = () => 0, us = (i) => 9000 * i) => {
  const history = new History();
  for (let i = 0; i < count; i++) history.add({ endUs: us(i), flags: flags(i), channels: [i], readings: [] });
  return history;
};
const near = (actual, expected) => assert.ok(Math.abs(actual - expected) < 1e-9, `${actual}, not ${expected}`);

check('a full history forgets the oldest samples, and finds the sample nearest to any time', () => {
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

check('the losses of a full history are those of the samples that it still has', () => {
  const extra = 1000;
  const history = filled(History.capacity + extra, (i) => (i < extra ? 12 : i % 10 === 0 ? 4 : 0), (i) => (i < extra ? 50000 * i : 50000 * extra + 9000 * (i - extra)));
  const { parts, all } = losses(history, history.time(history.end - 1));
  assert.deepEqual(all, { frames: History.capacity, lost: Math.ceil(History.capacity / 10), failsafe: 0 });
  assert.ok(parts.length <= 60 && parts.length > 20, `${parts.length}`);
  assert.equal(parts.reduce((sum, { frames }) => sum + frames, 0), History.capacity);
});

check('for a slow board the last ten minutes are shown, and all rows are counted', () => {
  const history = filled(5000, () => 0, (i) => 1e6 * i);
  const { parts, all, beginS, widthS } = losses(history, 4999);
  assert.deepEqual([parts.length, beginS, widthS, all.frames], [60, 4400, 10, 5000]);
  assert.ok(parts.every(({ frames }) => frames === 10));
});

check('zooming keeps what is pointed at in its place, unless an end of the time is reached', () => {
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

check('a step zooms to the next round width, from any width', () => {
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

check('a recording can be shown from end to end, and its edge stays within it', () => {
  const view = new Viewport();
  view.follow(100, 0, 3600);
  const walk = (step, count) => Array.from({ length: count }, () => {
    view.step(step);
    return [view.seconds, view.edge];
  });
  assert.deepEqual(walk(-1, 10).slice(4), [[240, 240], [480, 480], [960, 960], [1920, 1920], [3600, 3600], [3600, 3600]]);
  for (let i = 0; i < 1000; i++) {
    [() => view.zoom(2 ** (2 * random() - 1), random()), () => view.scroll(random() - 0.5), () => view.centre(4000 * random())][i % 3]();
    assert.ok(view.edge <= 3600 && view.seconds <= 3600 && (!view.isWide || view.begin >= -1e-9), `${view.begin} to ${view.edge}`);
    assert.equal(view.isAway, view.paused && view.edge > 100.001);
  }
  view.enter(0);
  view.follow(3, 0);
  assert.deepEqual([view.seconds, view.edge, view.isAhead], [10, 10, true]); // another line: its beginning
  view.enter(2.5);
  assert.deepEqual([view.seconds, view.begin], [2.5, 0.5]);
  view.follow(1, 0);
  assert.deepEqual([view.seconds, view.begin], [2.5, 0]);
});

check('a curve has each value in its place, and breaks at a silence and where a sensor measures nothing; failsafe and losses are bands', () => {
  const history = new History();
  const values = Array.from({ length: 400 }, (_, i) => (37 * i) % 1000);
  const timeOf = (i) => i * 10000 + (i >= 200 ? 500000 : 0);
  values.forEach((value, i) => history.add({ endUs: timeOf(i), flags: i >= 40 && i < 50 ? 8 : i >= 50 && i < 60 ? 4 : 0, channels: [7, i === 300 ? NaN : value], readings: [] }));
  const area = { left: 100, top: 20, width: 450, height: 1000, edge: 4.5, seconds: 4.5, begin: 0, end: 400 };
  const strokes = new SampleStrokes(history);
  const trace = (column) => {
    const [moves, points] = [[], []];
    strokes.trace({ column, unit: { low: 0, high: 1000 } }, area, 0.1, { moveTo: (x, y) => moves.push(x) && points.push([x, y]), lineTo: (x, y) => points.push([x, y]) });
    return { moves, points };
  };
  const xOf = (i) => Math.round(100 + timeOf(i) / 10000);
  const { moves, points } = trace(1);
  assert.deepEqual(moves, [xOf(0), xOf(200), xOf(301)]);
  assert.deepEqual(points, values.map((value, i) => [xOf(i), 1020 - value]).filter((_, i) => i !== 300));
  assert.deepEqual(trace(0).points, [0, 199, 200, 399].map((i) => [xOf(i), 1013])); // a stroke for all of one height
  const bands = [];
  strokes.bands(area, (x, width, failsafe) => bands.push([Math.round(x), Math.round(width), failsafe]));
  assert.deepEqual(bands, [[xOf(40), 10, true], [xOf(50), 10, false]]);
});

check('the envelope of a recording has the least and the greatest value of each column of pixels, and its silences', () => {
  const [endUs, width, height] = [1000e6, 700, 1000];
  const index = new EnvelopeIndex(endUs);
  const columns = new Map();
  const unit = { low: 0, high: height };
  const add = (us, value) => index.take({ kind: 0, endUs: us, flags: us > 5e8 && us < 5.1e8 ? 8 : 0, channels: [5, value], channelCount: 2, readings: [], readingCount: 0 });
  const partUs = endUs / index.envelope.flags.length;
  for (let us = 20000; us < endUs; us += 20000) {
    if (us > 7e8 && us < 7.1e8) continue;
    const value = random() < 0.001 ? height : Math.floor(300 * random());
    add(us, value);
    const x = Math.round(((Math.floor(us / partUs) + 0.5) * partUs * width) / endUs);
    const [low, high] = columns.get(x) ?? [Infinity, -Infinity];
    columns.set(x, [Math.min(low, value), Math.max(high, value)]);
  }
  const strokes = new EnvelopeStrokes(index.envelope);
  const area = { left: 0, top: 0, width, height, edge: endUs / 1e6, seconds: endUs / 1e6 };
  const drawn = new Map();
  const moves = [];
  const to = (x, y) => drawn.set(x, [...(drawn.get(x) ?? []), height - y]);
  strokes.trace({ column: 1, unit }, area, 0.1, { moveTo: (x, y) => moves.push(x) && to(x, y), lineTo: to });
  assert.deepEqual([...drawn], [...columns]);
  assert.deepEqual(moves, [0, 497]); // the silence ends at 710 s
  const painted = [];
  strokes.bands(area, (x, wide) => painted.push(x, x + wide));
  near(Math.round(Math.min(...painted)), 350);
  assert.ok(Math.abs(Math.max(...painted) - 357) < 2);
  assert.deepEqual(strokes.ends(1, area), [0, height]);
  const slow = new EnvelopeIndex(endUs);
  for (let us = 1e6; us < endUs; us += 1e6) slow.take({ kind: 4, endUs: us, flags: 0, channels: [us], channelCount: 1, readings: [], readingCount: 0 });
  let breaks = 0;
  new EnvelopeStrokes(slow.envelope).trace({ column: 0, unit }, area, 3, { moveTo: () => breaks++, lineTo: () => undefined });
  assert.equal(breaks, 1);
});

// Returns a line whose frames come every 10 ms, or after a silence, and the spans that it should have.
function faulty(count, faults) {
  const spans = [];
  const span = (fault, fromUs, toUs, joins = false) => {
    const last = spans.findLast((each) => each.fault === fault);
    if (last && (joins || fromUs - last.toUs <= (fault === Fault.Damage ? 1e6 : -1))) last.toUs = toUs;
    else spans.push({ fault, fromUs, toUs });
  };
  let us = 0;
  let before = { flags: 0 };
  for (let i = 0; i < count; i++) {
    const silent = i > 0 && random() < 0.002;
    const fromUs = us;
    us += silent ? 150000 + Math.floor(random() * 3e6) : 10000;
    const flags = random() < 0.002 ? 12 : random() < 0.002 ? 4 : random() < 0.002 ? 32 : random() < 0.5 ? before.flags : 0;
    const damagedUs = i > 0 && random() < 0.003 ? fromUs + 3000 : 0;
    if (damagedUs) span(Fault.Damage, damagedUs, us);
    if (silent) span(Fault.NoFrames, fromUs, us);
    for (const [fault, on, was] of [[Fault.Failsafe, flags & 8, before.flags & 8], [Fault.NoPulses, flags & 32, before.flags & 32], [Fault.LostFrame, flags === 4, before.flags === 4]]) {
      if (was && !silent) span(fault, fromUs, us, true);
      else if (on) span(fault, us, us);
    }
    before = { flags };
    faults.take({ endUs: us, kind: 0, flags, lateUs: 0, damagedUs });
  }
  faults.finish(us);
  return spans.sort((a, b) => a.fromUs - b.fromUs || a.fault - b.fault);
}

check('the next fault after any time, and the one before, are those in a list of all faults', () => {
  const faults = new FaultIndex(2e9, gapOf);
  const spans = faulty(100000, faults);
  assert.ok(spans.length > 300, `${spans.length}`);
  assert.deepEqual(faults.counts(), [0, 1, 2, 3, 4, 5].map((fault) => spans.filter((span) => span.fault === fault).length));
  for (let i = 0; i < 3000; i++) {
    const fromUs = Math.floor(random() * 1.3e9);
    const next = spans.findIndex((span) => span.fromUs > fromUs);
    assert.deepEqual(faults.after({ fromUs }), next < 0 ? undefined : { ...spans[next], number: next + 1 });
    const last = spans.findLastIndex((span) => span.fromUs <= fromUs);
    assert.deepEqual(faults.before({ fromUs }), last < 0 ? undefined : { ...spans[last], number: last + 1 });
    assert.equal(faults.at(fromUs), spans.reduce((mask, span) => mask | (span.fromUs <= fromUs && span.toUs >= fromUs ? 1 << span.fault : 0), 0));
  }
  spans.forEach((span, i) => {
    assert.deepEqual(faults.after(span), spans[i + 1] && { ...spans[i + 1], number: i + 2 });
    assert.deepEqual(faults.before(span), spans[i - 1] && { ...spans[i - 1], number: i });
  });
});

check('a sketch that prints once a second is not silent; three missing rows are the fault "no frames"', () => {
  const faults = new FaultIndex(1e8, gapOf);
  for (let i = 0; i < 100; i++) {
    faults.take({ endUs: 1e6 * i - 500, kind: 3, flags: 0, lateUs: 0, damagedUs: 0 }); // its bytes
    if (i < 50 || i > 53) faults.take({ endUs: 1e6 * i, kind: 4, flags: 0, lateUs: 0, damagedUs: 0 });
  }
  faults.finish(99e6);
  assert.deepEqual(faults.after({ fromUs: 0 }), { fault: Fault.NoFrames, fromUs: 49e6, toUs: 54e6, number: 1 });
  assert.deepEqual(faults.counts(), [0, 0, 0, 0, 1, 0]);
});

check('bytes without any frame are the fault "no frames", from the first to the last', () => {
  const faults = new FaultIndex(1e7, gapOf);
  for (let us = 1e6; us < 9e6; us += 10000) faults.take({ endUs: us, kind: 3, flags: 0, lateUs: 0, damagedUs: 0 });
  faults.finish(9e6);
  assert.deepEqual(faults.after({ fromUs: 0 }), { fault: Fault.NoFrames, fromUs: 1e6, toUs: 9e6, number: 1 });
});

check('no module of the page needs itself, also not for a type; what page and worker tell each other needs only the border', () => {
  const modules = readdirSync(sources, { recursive: true }).filter((name) => /(?<!\.d)\.ts$/.test(name)).map((name) => name.slice(0, -3));
  const needs = new Map(modules.map((name) => {
    const text = readFileSync(path.join(sources, `${name}.ts`), 'utf8');
    return [name, [...text.matchAll(/ from '(\.[^']+)';/g)].map(([, other]) => path.join(path.dirname(name), other))];
  }));
  assert.deepEqual(needs.get('messages'), ['border']);
  while (needs.size > 0) {
    const free = [...needs.keys()].filter((name) => !needs.get(name).some((other) => needs.has(other)));
    assert.ok(free.length > 0, `in a circle, or before one: ${[...needs.keys()]}`);
    free.forEach((name) => needs.delete(name));
  }
});

process.exit(failed > 0 ? 1 : 0);
