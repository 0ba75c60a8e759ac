// Lost frames, as numbers and as bars.
import assert from 'node:assert/strict';
import { check, codes, connect, counts, frame, playToEnd, reads, until } from './support.mjs';

// Returns a recording of frames with these intervals, in ms, and flags.
async function playFrames(page, list) {
  let us = 0;
  const lines = list.map(([ms, flags = 0]) => `${(us += 1000 * ms)} ${frame([1000], { flags }).map((byte) => byte.toString(16)).join(' ')}\n`);
  await playToEnd(page, 'intervals.txt', lines.join(''));
  await counts(page, 'frames', list.length);
}
// Returns the titles of the bars that are not empty.
const bars = (page) => page.$$eval('#losses-chart g', (groups) => groups
  .filter((group) => [...group.querySelectorAll('rect')].some((rect) => Number(rect.getAttribute('height')) > 0))
  .map((group) => group.querySelector('title').textContent));
const shows = (page, expected) => {
  let now;
  return until(() => JSON.stringify(now), async () => JSON.stringify((now = await bars(page))) === JSON.stringify(expected));
};

export default async function () {
  await check('lost frames have a bar for each second: their share, failsafe and silence', async (page) => {
    const second = (lost, failsafe = 0) => Array.from({ length: 100 }, (_, i) => [10, i < failsafe ? 12 : i < lost ? 4 : 0]);
    await playFrames(page, [...second(0), ...second(20), ...second(50, 30), [2000], ...second(0)]);
    await reads(page, '#losses-text', '17.5 % of 401 frames were lost by radio, 17.5 % in the last ten seconds; 7.5 % came in failsafe.');
    await shows(page, ['1 to 2 s: 20.0 %', '2 to 3 s: 50.0 %', '4 to 5 s: silence']);
    await reads(page, '#losses-top', '50 %');
    const heights = await page.$$eval('#losses-chart g:nth-child(3) rect', (rects) => rects.map((rect) => `${rect.getAttribute('class')} ${Number(rect.getAttribute('height'))}`));
    assert.deepEqual(heights, ['failsafe 0.6', 'lost 0.4']);
  });

  await check('the link quality is the share of the frames of a second that are not lost', async (page) => {
    await playFrames(page, Array.from({ length: 300 }, (_, i) => [10, i % 4 === 1 ? 4 : 0]));
    await reads(page, '#quality', /^quality.(74|75|76).%$/);
  });

  await check("a board's rows are counted as rows; another source begins again", async (page) => {
    await connect(page, 'board');
    for (let i = 0; i < 5; i++) {
      await page.evaluate((letters) => fake.port.feed(letters), codes('1500,1000\r\n'));
      await page.evaluate(() => fake.skip(1000));
    }
    await reads(page, '#losses-text', /^0\.0 % of 4 rows/);
    await reads(page, '#quality', '');
    await page.evaluate(() => (fake.choose = () => fake.newPort()));
    await page.click('#source-adapter');
    await reads(page, '#losses-text', 'No frames yet.');
  });
}
