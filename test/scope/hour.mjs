// An hour of frames, a hundred a second, as fast as the page takes them: its memory does not grow.
import assert from 'node:assert/strict';
import { check, connect, counts, frame, opensWith, playToEnd } from './support.mjs';

const perRead = 10; // frames
const all = 360000;
const bytes = frame([1000, 992, 172]); // CH1 is 1000

// Feeds frames `from` to `to`: CH1 counts them. The page draws meanwhile.
const feed = (page, from, to) =>
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
    await opensWith(page, [bytes]);
    await connect(page);
    await feed(page, 0, 40000); // the history is full
    const before = await heap(page, session);
    await feed(page, 40000, all);
    await counts(page, 'frames', '360\u202f001');
    await counts(page, 'discardedBytes', 0);
    const after = await heap(page, session);
    console.log(`   heap ${before.script} before, ${after.script} after; WebAssembly ${before.wasm}, ${after.wasm} bytes`);
    // Compiled code comes and goes; three bytes for each frame would be more than this.
    assert.ok(after.script - before.script < 900000, `${before.script} bytes became ${after.script}`);
    assert.equal(after.wasm, before.wasm);
  }, { patience: 300000 });

  await check('a recording of an hour takes about eight bytes of memory a character, and every frame is played', async (page) => {
    const hex = bytes.map((byte) => byte.toString(16).padStart(2, '0')).join(' ');
    await playToEnd(page, 'hour.txt', Array.from({ length: all }, (_, i) => `${10000 * (i + 1)} ${hex}\n`).join(''));
    await counts(page, 'frames', all.toLocaleString('en').replaceAll(',', '\u202f'));
    const size = await page.workers().at(-1).evaluate(() => memories.reduce((sum, memory) => sum + (memory.deref()?.buffer.byteLength ?? 0), 0));
    assert.ok(size < 1.1 * 8 * 25 * all + 4e6, `${size} bytes`);
  }, { patience: 300000 });
}
