// An hour of frames, a hundred a second, as fast as the page takes them: its memory does not grow.
import assert from 'node:assert/strict';
import { closeSync, openSync, writeSync } from 'node:fs';
import path from 'node:path';
import { random } from './modules.mjs';
import { build, check, connect, counts, frame, opensWith, raw, toEnd, until } from './support.mjs';

const perRead = 10; // frames
const all = 360000;

// Feeds frames `from` to `to`: CH1 counts them. The page draws meanwhile.
const feed = (page, bytes, from, to) =>
  page.evaluate(async ([template, begin, end, count]) => {
    for (let number = begin; number < end; number += count) {
      const part = [];
      for (let i = 0; i < count; i++) {
        template[1] = (number + i) & 0xff;
        part.push(...template);
      }
      fake.port.feed(part);
      fake.skip(10 * count);
      await (number % 2000 === 0 ? new Promise(requestAnimationFrame) : Promise.resolve());
      while (!fake.port.isEmpty) await new Promise((resolve) => setTimeout(resolve));
    }
  }, [bytes, from, to, perRead]);

const wasmBytes = (page) => page.evaluate(() => fake.memory.buffer.byteLength);

async function heap(page, session) {
  await session.send('HeapProfiler.collectGarbage');
  const { usedSize } = await session.send('Runtime.getHeapUsage');
  return { script: usedSize, wasm: await wasmBytes(page) };
}

export default async function () {
  await check(`of ${all} frames, an hour, every one is counted, and the memory is as before`, async (page) => {
    const session = await page.context().newCDPSession(page);
    const bytes = frame([1000, 992, 172]);
    await opensWith(page, [bytes]);
    await connect(page);
    await feed(page, bytes, 0, 40000); // the history is full
    const before = await heap(page, session);
    await feed(page, bytes, 40000, all);
    await counts(page, 'frames', '360\u202f001');
    await counts(page, 'discardedBytes', 0);
    const after = await heap(page, session);
    console.log(`   heap ${before.script} before, ${after.script} after; WebAssembly ${before.wasm}, ${after.wasm} bytes`);
    // Compiled code comes and goes; three bytes for each frame would be more than this.
    assert.ok(after.script - before.script < 900000, `${before.script} bytes became ${after.script}`);
    assert.equal(after.wasm, before.wasm);
  }, { patience: 300000 });
  // MB=450 node run.mjs hour: the largest recording that the page takes. SEEKS=100: more places.
  const mb = Number(process.env.MB ?? 30.8);
  const seeks = Number(process.env.SEEKS ?? 10);
  await check(`a recording of ${mb} MB takes about eight bytes of memory a character, every frame is played, and no picture waits`, async (page) => {
    const file = path.join(build, 'hour.txt');
    const count = Math.round((mb / 30.8) * all);
    write(file, count);
    await page.evaluate(() => {
      fake.longestMs = 0;
      fake.busyMs = 0;
      new PerformanceObserver((list) => list.getEntries().forEach(({ duration }) => (fake.busyMs = Math.max(fake.busyMs, duration)))).observe({ entryTypes: ['longtask'] });
      fake.restMs = 0;
      let before = fake.realNow();
      const draw = () => {
        fake.longestMs = Math.max(fake.longestMs, fake.realNow() - before);
        before = fake.realNow();
        requestAnimationFrame(draw);
      };
      requestAnimationFrame(draw);
    });
    const begin = performance.now();
    await page.setInputFiles('#file', file);
    await until('it is not read', async () => (await page.textContent('#title')).startsWith('Recording'), mb * 2000);
    const openMs = performance.now() - begin;
    await raw(page, 3, '172');
    const opening = await page.evaluate(() => fake.longestMs);
    await page.click('#play');
    const seekMs = (us) => page.evaluate(async (to) => {
      const position = document.querySelector('#position');
      const before = fake.realNow();
      position.value = to;
      position.dispatchEvent(new Event('input'));
      const clock = `${Math.floor(to / 60000)}:${(Math.floor(to / 100) % 600 / 10).toFixed(1).padStart(4, '0')} /`;
      // The newest piece of the line is the one at the position.
      const isThere = () => document.querySelector('#position-text').textContent.startsWith(clock) &&
        Math.abs(Number(document.querySelector('#lines .time').textContent) - to / 1000) < 0.03;
      while (!isThere()) await new Promise((resolve) => setTimeout(resolve, 1));
      return fake.realNow() - before;
    }, us);
    const first = await seekMs(Math.round(0.999 * 10 * count));
    const times = [];
    const next = random(20181);
    for (let i = 0; i < seeks; i++) {
      times.push(await seekMs(Math.round(next() * 10 * count)));
      await page.waitForTimeout(500);
    }
    times.sort((a, b) => a - b);
    const part = (share) => times[Math.ceil(share * seeks) - 1].toFixed(0);
    await seekMs(5 * count);
    await page.click('#play');
    const pictures = await page.evaluate(async (seconds) => {
      let drawn = 0;
      const begin = fake.realNow();
      while (fake.realNow() < begin + 1000 * seconds) await new Promise(requestAnimationFrame).then(() => drawn++);
      return (1000 * drawn) / (fake.realNow() - begin);
    }, 3);
    await page.click('#play');
    const bytes = await page.workers().at(-1).evaluate(() => memories.reduce((sum, memory) => sum + (memory.deref()?.buffer.byteLength ?? 0), 0));
    const [longest, busy] = await page.evaluate(() => [fake.longestMs, fake.busyMs]);
    console.log(`   ${mb} MB, ${count} frames: open after ${openMs.toFixed(0)} ms, at its end ${first.toFixed(0)} ms later; ` +
      `${seeks} seeks: ${part(0.5)} ms, 95 % within ${part(0.95)} ms, at most ${part(1)} ms; ${pictures.toFixed(1)} pictures a second while it plays; ` +
      `from one picture to the next at most ${opening.toFixed(0)} ms while it opened, ${longest.toFixed(0)} ms in all, the longest script ${busy} ms; WebAssembly ${bytes} bytes`);
    assert.ok(bytes < 1.1 * 8 * 25 * count + 4e6, `${bytes} bytes`);
    await toEnd(page);
    await counts(page, 'frames', count.toLocaleString('en').replaceAll(',', '\u202f'));
  }, { patience: 300000 + mb * 4000 });
}

// CH1 is 1000, a frame each 10 ms.
function write(file, count) {
  const hex = frame([1000, 992, 172]).map((byte) => byte.toString(16).padStart(2, '0')).join(' ');
  const at = openSync(file, 'w');
  for (let from = 0; from < count; from += all) {
    writeSync(at, Array.from({ length: Math.min(all, count - from) }, (_, i) => `${10000 * (from + i + 1)} ${hex}\n`).join(''));
  }
  closeSync(at);
}
