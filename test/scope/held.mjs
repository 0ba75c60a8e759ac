// One state of the link for all: it does not flicker, and a fault of the page or of a port stays said.
import assert from 'node:assert/strict';
import { check, connect, counter, counts, downloaded, frame, opensWith, play, playToEnd, raw, reads, recorded, until } from './support.mjs';

const good = frame([1000]);
const lost = frame([1000], { flags: 4 });

// Counts how often an attribute of an element changes.
const countChanges = (page, selector, name) => page.evaluate(([where, attribute]) => {
  fake.changes = 0;
  let before = document.querySelector(where).getAttribute(attribute);
  const watch = () => {
    const now = document.querySelector(where).getAttribute(attribute);
    fake.changes += Number(now !== before);
    before = now;
    requestAnimationFrame(watch);
  };
  fake.restMs = 0;
  watch();
}, [selector, name]);
const changes = (page) => page.evaluate(() => fake.changes);

export default async function () {
  await check('the simulation loses 2 frames of 100 for 9 s: the verdict stays, the indicator of lost frames lights', async (page) => {
    await reads(page, '#verdict-text', 'Simulation.');
    await countChanges(page, '#verdict', 'data-severity');
    await page.waitForSelector('#indicator-lost-frame[data-on="true"]');
    await page.waitForTimeout(6000);
    assert.ok((await counter(page, 'lostFrames')) > 2);
    assert.equal(await changes(page), 0);
  });

  await check('a line that loses each tenth frame changes the verdict at most once in 4 s', async (page) => {
    await page.evaluate(([bytes]) => (fake.port.onOpen = () => (fake.timer = fake.every(90, bytes))),
      [[...Array.from({ length: 9 }, () => [...good]).flat(), ...lost]]);
    await connect(page);
    await until('no frames come', async () => (await counter(page, 'frames')) > 60);
    await countChanges(page, '#verdict', 'data-severity');
    await page.waitForTimeout(4000);
    assert.ok((await changes(page)) <= 1, `${await changes(page)}`);
  });

  await check('a lost frame in the middle of a read lights its indicator for 0.2 s', async (page) => {
    await opensWith(page, [good, good]);
    await connect(page);
    await counts(page, 'frames', 2);
    await page.evaluate((bytes) => {
      fake.restMs = 0;
      fake.port.feed(bytes);
    }, [good, lost, good, good, good].flat());
    await page.waitForSelector('#indicator-lost-frame[data-on="true"]');
    await page.waitForSelector('#indicator-lost-frame[data-on="false"]');
  });

  await check('too many lost frames in a row are failsafe everywhere: link, indicator, strip and CSV, as for `sbus csv`', async (page) => {
    await playToEnd(page, 'losses.txt', Array.from({ length: 160 }, (_, i) => recorded(9000 * (i + 1), i < 10 ? good : lost)).join(''));
    await reads(page, '#state', 'Failsafe');
    await reads(page, '#indicator-failsafe .value', 'by losses');
    await reads(page, '#verdict-text', /^No radio/);
    await reads(page, '#fault-counts', /failsafe: 1 ×/);
    const rows = (await downloaded(page, '#csv')).text.trim().split('\n').slice(1).map((row) => row.split(',').slice(-2).join());
    assert.deepEqual([rows.length, rows.filter((row) => row === '1,1').length, rows.indexOf('1,1')], [160, 51, 109]); // test/tool/summary.sh
  });

  await check('at a fault the verdict never says that all is well', async (page) => {
    await play(page, 'single.txt', Array.from({ length: 400 }, (_, i) => recorded(9000 * (i + 1), i === 200 ? lost : good)).join(''));
    await reads(page, '#fault-counts', /^whole recording: 1 fault/);
    await page.focus('#position');
    await page.keyboard.press('n');
    await reads(page, '#verdict-text', 'A fault here: lost frames.');
    await reads(page, '#verdict-remedy', 'The line around it: All well.');
    await page.click('#play');
    await reads(page, '#verdict-text', 'All well.');
  });

  for (const [view, breaks, said] of [
    ['of the bytes', () => (String.prototype.padStart = () => { throw new Error('no pad'); }), 'The view of the bytes has failed: no pad.'],
    ['of the curves, which uPlot draws later', () => (globalThis.Path2D = class { constructor() { throw new Error('no path'); } }), 'The page has failed: no path.'],
  ]) {
    await check(`a view that throws, that ${view}, is said until the notice is closed, and the others go on`, async (page) => {
      await page.evaluate(breaks);
      await reads(page, '#notice-text', said);
      const before = await counter(page, 'frames');
      await until('the counters stand', async () => (await counter(page, 'frames')) > before + 50);
      await page.click('#notice-close');
      await page.waitForTimeout(300);
      assert.ok(!(await page.isVisible('#notice')));
      page.complaints.length = 0;
    });
  }

  for (const [what, begin] of [
    ['the simulation', () => undefined],
    ['a recording', async (page) => {
      await play(page, 'worker.txt', Array.from({ length: 2000 }, (_, i) => recorded(9000 * (i + 1), good)).join(''));
    }],
  ]) {
    await check(`a worker that fails while it decodes ${what} stays said, and what was recorded is saved; another source goes on`, async (page) => {
      await begin(page);
      await until('no frames come', async () => (await counter(page, 'frames')) > 10);
      await page.click('#record');
      const from = await counter(page, 'frames');
      await until('no frames come', async () => (await counter(page, 'frames')) > from + 50);
      await page.workers().at(-1).evaluate(() => void setTimeout(() => {
        throw new Error('out of memory');
      }));
      await reads(page, '#verdict-text', 'The decoder has failed.');
      await page.waitForTimeout(500);
      await reads(page, '#verdict-text', 'The decoder has failed.');
      const { text } = await downloaded(page, '#record');
      assert.ok(text.split('\n').length > 40);
      await page.click('#source-simulated');
      await reads(page, '#verdict-text', 'Simulation.');
    });
  }

  await check('a device without a serial number that is plugged in again goes on by one click, with its recording', async (page) => {
    await page.evaluate((bytes) => {
      fake.port.ephemeral = true;
      fake.port.onOpen = () => fake.port.feed(bytes);
    }, [good, good, good].flat());
    await connect(page);
    await counts(page, 'frames', 3);
    await page.click('#record');
    await page.evaluate(() => fake.port.unplug());
    await reads(page, '#verdict-text', 'The port is gone.');
    await reads(page, '#verdict-remedy', /press Adapter… or Board… and choose it/);
    await page.evaluate(() => fake.port.plug());
    await page.waitForTimeout(1200);
    await reads(page, '#verdict-text', 'The port is gone.');
    await page.click('#source-adapter');
    await counts(page, 'frames', 6);
    await counts(page, 'port reopened', 1);
    assert.equal(await page.getAttribute('#record', 'aria-pressed'), 'true');
    await raw(page, 1, '1000');
  });

  await check('a port that does not open gets advice after 3 s', async (page) => {
    await page.evaluate(() => (fake.port.openMs = 1e8));
    await page.click('#source-adapter');
    await reads(page, '#title', /\(opening\)$/);
    await page.waitForTimeout(1000);
    await reads(page, '#verdict-text', 'Listening.');
    await page.evaluate(() => fake.skip(2500));
    await reads(page, '#verdict-text', 'The port does not respond.');
    await reads(page, '#verdict-remedy', /^The system has not answered for 3 s/);
    await page.click('#source-simulated');
    await reads(page, '#verdict-text', 'Simulation.');
  });
}
