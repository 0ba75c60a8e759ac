// An hour of frames, a hundred a second, as fast as the page takes them: what it keeps does not grow.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import path from 'node:path';
import { build, check, connect, counts, frame, opensWith, play, raw, reads, toEnd } from './support.mjs';

const perRead = 10; // frames
const all = 360000;

// `from` to `to`: CH1 counts them. The page draws all the while.
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
  await check(`${all} frames, an hour of them: every one counted, the memory as before`, async (page) => {
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
    // Compiled code comes and goes; three bytes kept of each frame would be more than this.
    assert.ok(after.script - before.script < 900000, `${before.script} bytes became ${after.script}`);
    assert.equal(after.wasm, before.wasm);
  }, { patience: 300000 });
  await check("an hour's recording: some eight bytes of memory for each of its characters, and every frame is played", async (page) => {
    const file = path.join(build, 'hour.txt');
    const hex = frame([1000, 992, 172]).map((byte) => byte.toString(16).padStart(2, '0')).join(' ');
    writeFileSync(file, Array.from({ length: all }, (_, i) => `${10000 * (i + 1)} ${hex}\n`).join(''));
    await play(page, file);
    await raw(page, 3, '172');
    const wasm = await wasmBytes(page);
    console.log(`   WebAssembly ${wasm} bytes`);
    assert.ok(wasm < 1.1 * 8 * 25 * all, `${wasm} bytes`);
    await toEnd(page);
    await reads(page, '#position-text', '60:00.0 / 60:00.0');
    await counts(page, 'frames', '360\u202f000');
  }, { patience: 300000 });
}
