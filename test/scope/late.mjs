// A busy PC: what it reads late is no silence of the line.
import assert from 'node:assert/strict';
import { Native } from './native.mjs';
import { check, connect, counter, counts, downloaded, frame, inWorkers, play, playToEnd, reads, recorded, toEnd, until } from './support.mjs';

const good = frame([1000]);

// Keeps the page's main thread busy.
const busy = (page, ms) => page.evaluate((until) => {
  for (const end = fake.realNow() + until; fake.realNow() < end; );
}, ms);

// Notes all that the link and the verdict say from now on.
const listen = (page) => page.evaluate(() => {
  fake.said = new Set();
  new MutationObserver(() => fake.said.add(['#state', '#verdict-text'].map((at) => document.querySelector(at).textContent).join(': ')))
    .observe(document.body, { subtree: true, childList: true, characterData: true });
});

export default async function () {
  await check('after a stall of 3 s, reads that follow each other at once bring nothing of the future: silence after them is noticed', async () => {
    const page = await new Native().load();
    page.wasm.openPort(0, 100000, 1);
    page.advance(1000000);
    for (let read = 0; read < 4; read++) {
      page.give(Array.from({ length: 80 }, () => good).flat(), (count) => page.wasm.received(count, 4000000));
    }
    for (let us = 4000000; us <= 4200000; us += 10000) page.advance(us);
    assert.equal(page.status(4200000, 'frames'), 320);
    assert.equal(page.status(4200000, 'state'), 4); // stale
  });

  await check('while the page is busy for 100 to 900 ms on a clean line, the link stays fine, and no frame is lost', async (page) => {
    await page.evaluate((bytes) => {
      fake.restMs = 0;
      fake.port.onOpen = () => (fake.timer = fake.every(9, bytes));
    }, good);
    await connect(page);
    await reads(page, '#verdict-text', 'All well.');
    await listen(page);
    for (let ms = 100; ms <= 900; ms += 100) {
      await busy(page, ms);
      await page.waitForTimeout(150);
    }
    assert.deepEqual(await page.evaluate(() => [...fake.said].filter((said) => said !== 'Fine: All well.')), []);
    await page.evaluate(() => clearInterval(fake.timer));
    const sent = Math.floor((await page.evaluate(() => fake.sent)) / 25);
    await until(async () => `${await counter(page, 'frames')} frames of ${sent}`, async () => (await counter(page, 'frames')) >= sent - 1);
    await counts(page, 'discardedBytes', 0);
  });

  await check('a worker reads the port where it can: a page that is busy reads nothing late, and records the times of the line', async (page) => {
    await inWorkers(page, (bytes) => (fake.port.onOpen = () => (fake.timer = fake.every(9, bytes))), good);
    await page.click('#source-adapter');
    await reads(page, '#title', /^Serial adapter, 100000 baud, 8E2, FTDI/);
    await reads(page, '#verdict-text', 'All well.');
    assert.equal((await page.evaluate(() => fake.port.opened)).length, 0);
    await listen(page);
    await page.click('#record');
    for (let ms = 100; ms <= 900; ms += 200) {
      await busy(page, ms);
      await page.waitForTimeout(50);
    }
    assert.deepEqual(await page.evaluate(() => [...fake.said].filter((said) => said !== 'Fine: All well.')), []);
    const { text } = await downloaded(page, '#record');
    const late = text.split('\n').filter((each) => /^\d/.test(each)).map((each) => Number(each.match(/~(\d+)/)[1]));
    // A PC with too much to do may hold up a worker as well; the page was busy for nine tenths of the time.
    const held = late.filter((us) => us >= 100000).length;
    assert.ok(late.length > 200 && held < late.length / 10, `${held} of ${late.length} reads 0.1 s late`);
    const [worker] = page.workers();
    await worker.evaluate(() => clearInterval(fake.timer));
    const sent = Math.floor((await worker.evaluate(() => fake.sent)) / 25);
    await until(async () => `${await counter(page, 'frames')} frames of ${sent}`, async () => (await counter(page, 'frames')) >= sent - 1);
    await page.click('#source-simulated');
    await until('the port stays open', async () => !(await worker.evaluate(() => fake.port.isOpen)));
  });

  await check('a recording of a clean line has no silence, though the page was busy twelve times for 300 ms', async (page) => {
    await page.evaluate((bytes) => (fake.port.onOpen = () => (fake.timer = fake.every(9, bytes))), good);
    await connect(page);
    await reads(page, '#state', 'Fine');
    await page.click('#record');
    for (let i = 0; i < 12; i++) {
      await busy(page, 300);
      await page.waitForTimeout(50);
    }
    const { path: file } = await downloaded(page, '#record');
    await playToEnd(page, file);
    await until('it is not decoded', async () => !/decoded/.test(await page.textContent('#fault-counts')));
    // Record may be pressed within a frame: half a frame is damage, not silence.
    assert.match(await page.textContent('#fault-counts'), /no frames: 0 ×/);
  });

  await check('an adapter that stalled for 0.2 to 1 s and then hands all over at once: its time is the PC\'s, and quality, intervals and rate are as before; a silence is none of that', async () => {
    for (const stallMs of [200, 300, 500, 1000]) {
      for (const isSilent of [false, true]) {
        const page = await new Native().load();
        page.wasm.openPort(0, 100000, 0);
        const status = (name, ms) => page.status(1000 * ms, name);
        let held = [];
        let lowest = 100;
        const endMs = 3000 + stallMs;
        for (let ms = 1; ms <= 8000; ms++) {
          const isHeld = ms >= 3000 && ms < endMs;
          if (ms % 9 === 0 && !(isSilent && isHeld)) held.push(...good);
          if (!isHeld && held.length > 0) {
            page.give(held, (count) => page.wasm.received(count, 1000 * ms));
            held = [];
          }
          if (ms % 10 === 0) page.advance(1000 * ms);
          if (ms % 10 === 0 && ms > endMs + 10) lowest = Math.min(lowest, status('linkQuality', ms));
        }
        const longest = status('gapMaxUs', 8000);
        assert.deepEqual([status('lateReads', 8000), lowest >= 99, longest < 20000], isSilent ? [0, false, false] : [1, true, true], `${stallMs} ms: ${lowest} %, ${longest} us`);
        assert.equal(status('discardedBytes', 8000), 0);
        assert.equal(status('frames', 8000), Math.floor(8000 / 9) - (isSilent ? Math.floor((endMs - 1) / 9) - Math.floor(2999 / 9) : 0));
      }
    }
  });

  await check('a recording of a clean line has no silence, though the adapter stalled for 300 ms and its bytes came at once then', async (page) => {
    await page.evaluate((bytes) => {
      const feed = fake.port.feed.bind(fake.port);
      let held;
      fake.port.feed = (packet) => (held ? held.push(...packet) > 0 : feed(packet));
      fake.stall = () => {
        held = [];
        setTimeout(() => {
          const all = held;
          held = undefined;
          feed(all);
        }, 300);
      };
      fake.port.onOpen = () => (fake.timer = fake.every(9, bytes));
    }, good);
    await connect(page);
    await reads(page, '#state', 'Fine');
    await page.click('#record');
    await page.waitForTimeout(1500); // the pace of a line is known after half a second
    await page.evaluate(() => fake.stall());
    await page.waitForTimeout(1500);
    const { path: file } = await downloaded(page, '#record');
    await playToEnd(page, file);
    await reads(page, '#fault-counts', /no frames: 0 ×.*PC late: [1-9]\d* ×/);
    await reads(page, '#whole-text', /^All well/);
  });

  await check('in a recording of a PC that was late 0.3 s, this is a fault of its own; the link stays fine, and a cut wire is still a silence', async (page) => {
    const line = (ms, lateUs) => recorded(`${1000 * ms}~${lateUs}`, good);
    const lines = Array.from({ length: 400 }, (_, i) => {
      const end = 9 * (i + 1) + (i >= 300 ? 500 : 0);
      const late = i >= 100 && i < 133;
      return line(late ? 9 * 133 - 3 * (132 - i) : end, late ? 318000 : 35000);
    });
    await play(page, 'stalls.txt', lines.join(''));
    await reads(page, '#fault-counts', /no frames: 1 ×.*PC late: 1 ×/);
    await page.focus('#position');
    await page.keyboard.press('n');
    await reads(page, '#fault-text', /^Fault 1 of 2: PC late, 0:00\.9\d\d to 0:01\.1\d\d\.$/);
    await reads(page, '#state', 'Fine');
    await page.keyboard.press('n');
    await reads(page, '#fault-text', /^Fault 2 of 2: no frames/);
    await reads(page, '#state', 'Stale');
    await toEnd(page);
    await counts(page, 'lateReads', 1);
  });
}
