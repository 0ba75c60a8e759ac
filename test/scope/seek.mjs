// At any place of a recording the page shows what it would show if it had been played from the beginning.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import path from 'node:path';
import { random } from './modules.mjs';
import { Native } from './native.mjs';
import { build, check, counts, downloaded, frame, playPaused, reads, recorded, seek, toEnd, until } from './support.mjs';

const seed = Number(process.env.SEED ?? 26);
const places = 25;
const lengthMs = 400000; // longer than the history
const counters = ['frames', 'lostFrames', 'failsafeFrames', 'rejectedByEnd', 'rejectedByFlags', 'rejectedByLength', 'discardedBytes',
  'resyncs', 'characterErrors'];
// Frames of sticks that move, some damaged, lost or in failsafe, bytes of noise, and silences of up to twenty seconds.
function impaired(next) {
  const lines = [];
  let ms = 9;
  for (let i = 0; ms < lengthMs; i++) {
    const bytes = frame([1000 + Math.round(600 * Math.sin(i / 300)), i % 2048], { flags: next() < 0.05 ? 4 : next() < 0.02 ? 12 : Math.floor(4 * next()) });
    const damage = next();
    if (damage < 0.02) bytes.splice(Math.floor(25 * next()), 1);
    if (damage > 0.99) bytes[Math.floor(25 * next())] ^= 1 << Math.floor(8 * next());
    const line = recorded(1000 * ms, bytes);
    lines.push(damage > 0.98 && damage < 0.99 ? line.replace(/( \w\w)$/m, '$1!') : line);
    ms += next() < 0.0005 ? Math.floor(20000 * next()) : 9;
  }
  return lines.join('');
}

const shown = (page) => page.evaluate((names) => ({
  counters: names.map((name) => Number(document.querySelector(`[data-counter="${name}"]`).textContent.replace(/\D/g, ''))),
  gap: document.querySelector('#gap').textContent + document.querySelector('#gap-ends').textContent,
  travel: document.querySelector('#bars li:nth-child(2) .track').title,
}), counters);

export default async function () {
  const next = random(seed);
  const text = impaired(next);
  const file = path.join(build, 'seek.txt');
  writeFileSync(file, text);

  await check(`at ${places} places of a recording, seed ${seed}, counters, gaps, travel and history are as if it had been played to there`, async (page) => {
    const straight = await new Native().load();
    straight.open(text);
    await playPaused(page, file);
    for (let i = 0; i < places; i++) {
      const ms = Math.floor(next() * lengthMs);
      await seek(page, ms);
      straight.rewind();
      const history = straight.advance(1000 * ms).filter(({ kind }) => kind === 0);
      const status = (name) => straight.status(1000 * ms, name);
      const low = (us) => (us / 1000).toFixed(1);
      const travel = straight.travel(1);
      const expected = {
        counters: counters.map(status),
        gap: `${low(status('gapMeanUs'))} ms${low(status('gapMinUs'))} to ${low(status('gapMaxUs'))}`,
        travel: `CH2: lowest ${travel[0]}, highest ${travel[1]}`,
      };
      const same = async () => JSON.stringify(await shown(page)) === JSON.stringify(expected);
      await until(async () => `at ${ms} ms ${JSON.stringify(await shown(page))}, not ${JSON.stringify(expected)}`, same);
      if (i % 5 === 0) {
        const times = history.map(({ endUs }) => (endUs / 1e6).toFixed(6));
        let kept = [];
        await until(() => `at ${ms} ms the history has ${kept.length} frames, from ${kept[0]} to ${kept.at(-1)}, not ${times.length}`, async () => {
          const { name: savedAs, text: csv } = await downloaded(page, '#csv');
          const [, minute, second] = /-(\d+)m(\d\d)s\.csv$/.exec(savedAs) ?? [];
          assert.ok(minute === undefined || Math.abs(60 * minute + Number(second) - ms / 1000) < 21, `${savedAs} at ${ms} ms`); // a silence
          kept = csv.trim().split('\n').slice(1).map((row) => row.split(',')[0]);
          return kept.length >= times.filter((time) => time > ms / 1000 - 300).length;
        });
        assert.deepEqual(kept, times.slice(-kept.length));
      }
    }
  }, { patience: 200000 });

  // Drops a file of this many frames, then `end`.
  const drop = (page, name, count, end = '') => page.evaluate(([called, frames, line, last]) => {
    const parts = Array.from({ length: frames }, (_, i) => `${9000 * (i + 1)} ${line}`);
    dispatchEvent(Object.assign(new Event('drop', { cancelable: true }), { dataTransfer: { files: [new File([...parts, last], called)] } }));
  }, [name, count, recorded(9000, frame([1000])).slice(5), end]);

  await check('the running source continues while a file is read, and choosing another source ends the reading', async (page) => {
    await page.evaluate(() => { // the simulation is chosen as soon as the page says that it reads
      const title = document.querySelector('#title');
      new MutationObserver((_, watching) => {
        if (/^Simulated .*\((until the next one is ready|reading long\.txt: \d+ %)\)$/.test(title.textContent)) {
          watching.disconnect();
          fake.chosenAt = title.textContent;
          document.querySelector('#source-simulated').click();
        }
      }).observe(title, { childList: true });
    });
    await drop(page, 'long.txt', 700000);
    await until('it is not read', () => page.evaluate(() => fake.chosenAt));
    await until('the worker goes on', () => page.workers().length === 1);
    await reads(page, '#title', /^Simulated FrSky R-XSR[^(]*$/);
    await drop(page, 'long.txt', 400000);
    await reads(page, '#title', /^Recording long.txt/);
    await page.click('#source-simulated');
    await until('the worker goes on', () => page.workers().length === 1);
  });

  await check('a file that is chosen while a large one is read has its own title, and the worker of the large one ends', async (page) => {
    await drop(page, 'large.txt', 700000);
    await reads(page, '#title', /\(reading large\.txt: \d+ %\)$/);
    await drop(page, 'small.txt', 100);
    await reads(page, '#title', 'Recording small.txt');
    await until('the worker goes on', () => page.workers().length === 2); // the simulation's, and that of the recording
    await page.waitForTimeout(300);
    assert.equal(await page.textContent('#title'), 'Recording small.txt');
  });

  await check('a dialog of ports that is never answered leaves the title of the next source alone', async (page) => {
    await page.evaluate(() => (navigator.serial.requestPort = () => new Promise(() => undefined)));
    await page.click('#source-adapter');
    await reads(page, '#title', /^Simulated .*\(until the next one is ready\)$/);
    await drop(page, 'small.txt', 100);
    await reads(page, '#title', 'Recording small.txt');
  });

  await check('a file that cannot be read leaves the playing recording, its position and its curves as they are', async (page) => {
    await playPaused(page, file);
    await seek(page, 350000);
    await until('no history', async () => (await downloaded(page, '#csv')).text.length > 1e6);
    const { text: before } = await downloaded(page, '#csv');
    await drop(page, 'bad.txt', 10000, '!\n');
    await reads(page, '#notice-text', /^In line \d+ of bad\.txt, .* is not a time/);
    await reads(page, '#title', 'Recording seek.txt');
    assert.match(await page.textContent('#position-text'), /^5:50\.0 /);
    assert.equal((await downloaded(page, '#csv')).text, before);
    assert.equal(page.workers().length, 2);
  });

  await check('a place that is not decoded yet is shown once it is; until then the title has the progress', async (page) => {
    await page.evaluate(() => {
      fake.titles = new Set();
      const title = document.querySelector('#title');
      new MutationObserver(() => fake.titles.add(title.textContent.replace(/\d+ %/, 'N %'))).observe(title, { childList: true });
    });
    await drop(page, 'long.txt', 700000);
    await reads(page, '#title', /^Recording long\.txt/);
    await toEnd(page);
    await counts(page, 'frames', '700\u202f000');
    await reads(page, '#title', 'Recording long.txt');
    await reads(page, '#lines .time', '6300.003');
    assert.ok(await page.evaluate(() => fake.titles.has('Recording long.txt (decoding up to this position: N %)')));
  });

  const long = async (page) => {
    await drop(page, 'long.txt', 700000);
    await reads(page, '#title', /^Recording long\.txt/);
    await page.click('#play');
  };

  for (const [what, look, said] of [
    ['fault', '#fault-next', ['#fault-text', 'There is no other fault in this direction.']],
    ['event', '#trigger-next', ['#trigger-text', 'No event after 6000.000 s.']],
  ]) {
    await check(`a place that is not decoded yet, from which no ${what} follows, is the one that is shown then`, async (page) => {
      await long(page);
      await page.click('#trigger-open');
      await page.fill('#trigger-condition', 'ch1 > 1500');
      await seek(page, 6e6);
      await page.click(look);
      await reads(page, ...said);
      await page.waitForTimeout(200);
      assert.equal(await page.textContent('#lines .time'), '5999.997');
      assert.match(await page.textContent('#position-text'), /^100:00\.0 /);
      await counts(page, 'frames', '666\u202f666');
    });
  }

  await check('a recording that begins while its place is decoded has all that follows', async (page) => {
    await long(page);
    await seek(page, 6e6);
    await page.click('#record');
    await counts(page, 'frames', '666\u202f666');
    await page.click('#play');
    await reads(page, '#position-text', /^100:02/);
    const { text } = await downloaded(page, '#record');
    const rows = text.split('\n').filter((row) => /^\d/.test(row));
    assert.ok(rows.length > 150 && parseInt(rows[0], 10) < 20000, `${rows.length} rows: ${rows[0]}`);
  });

  await check('the bits that have the focus are those of the place that is shown, and so is the value', async (page) => {
    await playPaused(page, file);
    await seek(page, 100000);
    await reads(page, '#position-text', /^1:40\.0 /);
    await until('no bits', async () => (await page.locator('#bits i').count()) === 200);
    await page.focus('#bits');
    await page.keyboard.press('ArrowRight');
    for (const ms of [300000, 200000]) {
      await seek(page, ms);
      await until('they are those of another place', async () => {
        const [time, value, said] = await Promise.all(['#lines .time', '#bars .raw', '#bit-text'].map((where) => page.textContent(where)));
        return Math.abs(time - ms / 1000) < 25 && said.startsWith('CH1, bit 1 ') && said.includes(` CH1 = ${value} `);
      });
    }
  });

  await check('a browser that starts no worker: a notice says so', async (page) => {
    await page.evaluate(() => (globalThis.Worker = class { constructor() { throw new DOMException('no', 'SecurityError'); } }));
    await drop(page, 'paper.txt', 1);
    await reads(page, '#notice-text', 'This browser cannot start a worker, which the page needs for recordings.');
    await reads(page, '#state', 'Fine');
  });
}
