// The verdict runs on the line's time: a recording that is paused, has jumped or has ended has the verdict of the line before its
// position, which never contradicts the link beside it.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import path from 'node:path';
import { build, check, connect, frame, opensWith, playPaused, playToEnd, reads, recorded, seek, until } from './support.mjs';

const periodMs = 9;
const good = frame([1000]);
const damaged = [...good.slice(0, 11), ...good.slice(12)];
const lost = frame([1000], { flags: 4 });
const failsafe = frame([1000], { flags: 12 });

// What is on the line at a time in ms.
function at(ms) {
  return ms < 4000 ? good // well
    : ms < 7000 ? (ms % (4 * periodMs) < periodMs ? damaged : good) // noise
    : ms < 10000 ? (ms === 9000 ? lost : good) // a single lost frame
    : ms < 12000 ? failsafe
    : good;
}

// Ten seconds of silence after 15 s: the wire was cut; then frames again.
const events = [
  ...Array.from({ length: 15000 / periodMs }, (_, i) => (i + 1) * periodMs),
  ...Array.from({ length: 300 }, (_, i) => 25002 + i * periodMs),
];
const text = events.map((ms) => recorded(1000 * ms, at(ms))).join('');

async function pausedAt(page, ms) {
  await seek(page, ms);
  await reads(page, '#position-text', new RegExp(`^0:${String(Math.floor(ms / 1000)).padStart(2, '0')}\\.${Math.floor(ms / 100) % 10} `));
}

export default async function () {
  const file = path.join(build, 'watch.txt');
  writeFileSync(file, text);

  await check('a recording that is paused at any place has the verdict of the line before it, and keeps it', async (page) => {
    await playPaused(page, file);
    for (const [ms, state, said] of [
      [5500, 'Frames come', /^Noise/],
      [500, 'Fine', /^All well/], // before a second is over
      [3500, 'Fine', /^All well/],
      [9004, 'Fine', /^All well/], // a single lost frame, which only the indicator shows
      [9500, 'Fine', /^All well/],
      [11500, 'Failsafe', /^Failsafe/],
      [12200, 'Frames come', /^Frames come again/], // a second ago it was failsafe
      [14200, 'Fine', /^All well/],
      [15050, 'Fine', /^All well/],
      [15120, 'Stale', /^Signal lost/], // the second has not been over
      [24000, 'Stale', /^Signal lost/],
      [25020, 'Frames come', /^Frames come again/],
      [27000, 'Fine', /^All well/],
      [6200, 'Frames come', /^Noise/],
    ]) {
      await pausedAt(page, ms);
      await reads(page, '#state', state);
      await reads(page, '#verdict-text', said);
    }
    await page.waitForTimeout(1500);
    assert.match(await page.textContent('#verdict-text'), /^Noise/);
  });

  await check('a recording that ends within two seconds after a failsafe or a silence says so, and after a failsafe never that all is well', async (page) => {
    for (const [what, during] of [['Failsafe 1 time, longest 0.7 s', failsafe], ['No frames 1 time, longest 0.7 s', []]]) {
      for (const endMs of [950, 1200, 1500, 1900]) {
        const part = path.join(build, `after-${endMs}.txt`);
        const times = Array.from({ length: Math.floor(endMs / periodMs) }, (_, i) => periodMs * (i + 1));
        writeFileSync(part, times.map((ms) => (ms < 210 || ms > 910 ? recorded(1000 * ms, good) : during.length > 0 ? recorded(1000 * ms, during) : '')).join(''));
        await playToEnd(page, part);
        await reads(page, '#whole-text', new RegExp(`^${what}`));
        if (during.length > 0) {
          await reads(page, '#verdict-remedy', endMs < 1000 ? /^Switch the radio on/ : 'A moment ago the receiver was in failsafe.');
          assert.equal(await page.getAttribute('#verdict', 'data-severity'), endMs < 1000 ? 'alarm' : 'warning', `${what} at ${endMs} ms`);
        }
      }
    }
  });

  await check('the verdict line has two halves: of the whole recording, in the words of its report, and of the place; a live line has one', async (page) => {
    await playPaused(page, file);
    const [, words] = /class="verdict bad">([^<]*)/.exec(execFileSync(process.env.SCOPE_SBUS, ['summary', '-o', '-', file], { encoding: 'utf8' }));
    assert.match(words, /^Failsafe 1 time, longest 2\.0 s; no frames 1 time, longest 10\.0 s; /);
    await pausedAt(page, 14200);
    await reads(page, '#whole-text', words);
    assert.ok(await page.locator('#whole').isVisible());
    await reads(page, '#here', 'Here (0:14.2): ');
    await reads(page, '#verdict-text', 'All well.');
    assert.deepEqual(await page.$$eval('#whole, #verdict', (halves) => halves.map(({ dataset }) => dataset.severity)), ['alarm', 'good']);
    await page.click('#source-simulated');
    await reads(page, '#verdict-text', 'Simulation.');
    await reads(page, '#here', '');
    assert.ok(await page.locator('#whole').isHidden());
  });

  await check("a recording's end keeps its verdict, also that of one shorter than a second", async (page) => {
    for (const [name, ms, said] of [['short.txt', 500, /^All well/], ['noisy.txt', 6500, /^Noise/]]) {
      const part = path.join(build, name);
      writeFileSync(part, events.filter((each) => each < ms).map((each) => recorded(1000 * each, at(each))).join(''));
      await playToEnd(page, part);
      await reads(page, '#verdict-text', said);
      await page.waitForTimeout(1500);
      assert.match(await page.textContent('#verdict-text'), said);
    }
  });

  await check('a cut wire is named as soon as the link is stale, and never called bytes without frames', async (page) => {
    await opensWith(page, [good]);
    await connect(page);
    await page.evaluate(([bytes]) => {
      fake.said = new Set();
      const watch = () => {
        if (document.querySelector('#state').textContent === 'Stale') fake.said.add(document.querySelector('#verdict-text').textContent);
        requestAnimationFrame(watch);
      };
      watch();
      for (let i = 0; i < 40; i++) setTimeout(() => fake.port.feed(bytes), 9 * i);
    }, [good]);
    await reads(page, '#state', 'Fine');
    await reads(page, '#state', 'Stale');
    await until('no verdict', () => page.evaluate(() => fake.said.size > 0));
    await page.waitForTimeout(1500);
    assert.deepEqual(await page.evaluate(() => [...fake.said]), ['Signal lost: frames came before, but no bytes come now.']);
  });
}
