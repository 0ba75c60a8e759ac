// The trigger: what it stops at, where the picture stands then, and what it says about a condition that is none.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import path from 'node:path';
import { build, check, connect, counter, drawn, frame, opensWith, playPaused, reads, recorded, seek, until } from './support.mjs';

const set = async (page, condition) => {
  if (await page.evaluate(() => document.querySelector('#trigger').hidden)) await page.click('#trigger-open');
  await page.fill('#trigger-condition', condition);
};
const text = (page) => page.textContent('#trigger-text');
const at = (us) => `Event at ${(us / 1e6).toFixed(3)} s.`;
// The place of the marked moment, as a part of the curves' width: the pixels that have the ink's colour from top to bottom.
const marked = (page) => page.evaluate(() => {
  const canvas = document.querySelector('#plot canvas');
  const over = document.querySelector('#plot .u-over').getBoundingClientRect();
  const { left, width } = canvas.getBoundingClientRect();
  const scale = canvas.width / width;
  const ink = getComputedStyle(document.querySelector('#curves-title')).color;
  const probe = Object.assign(document.createElement('canvas'), { width: canvas.width }).getContext('2d', { willReadFrequently: true });
  probe.fillStyle = ink;
  probe.fillRect(0, 0, 1, 1);
  const wanted = probe.getImageData(0, 0, 1, 1).data.join();
  probe.clearRect(0, 0, 1, 1);
  probe.drawImage(canvas, 0, -Math.round(60 * scale));
  const row = probe.getImageData(0, 0, canvas.width, 1).data;
  for (let x = Math.ceil((over.left - left) * scale); x < canvas.width; x++) {
    if (Array.from(row.slice(4 * x, 4 * x + 4)).join() === wanted) return ((x + 1) / scale - (over.left - left)) / over.width;
  }
  return undefined;
});
const isInMiddle = async (page) => {
  await drawn(page);
  const found = await marked(page);
  assert.ok(Math.abs(found - 0.5) < 0.01, `the event is at ${found} of the width`);
};
const zoomIn = async (page) => {
  for (let i = 0; i < 5; i++) await page.click('#zoom-in'); // half a second
};

// Channels rise with the frame; failsafe from 120 to 129, a lost frame at 200, half a frame at 250, nothing from 300 on for half a second.
const story = () => Array.from({ length: 400 }, (_, i) => {
  const bytes = frame([500 + i, 992], { flags: i >= 120 && i < 130 ? 12 : i === 200 ? 4 : 0 });
  return recorded(10000 * (i + 1) + (i >= 300 ? 500000 : 0), i === 250 ? bytes.slice(0, 12) : bytes);
}).join('');
const endUs = (i) => 10000 * (i + 1) + 2880 + (i >= 300 ? 500000 : 0);

export default async function () {
  await check('a condition that is none is said with its place, which is selected', async (page) => {
    await reads(page, '#state', 'Fine');
    await page.click('#trigger-open');
    for (const [condition, said, from, to] of [
      ['', 'Character 1: a channel such as ch5, failsafe, nopulses, lostframe, rejected, jump, ok, lossy, stale, state, age, quality, ! or ( is expected.', 0, 0],
      ['ch5 >', 'Character 6: a value, 0 to 2047, a pulse such as 1500us or a part such as -50%, is expected.', 5, 5],
      ['ch5 > 2047', 'Character 7: a value, 0 to 2047, a pulse such as 1500us or a part such as -50%, is expected.', 6, 10],
      ['age > 50', 'Character 7: a time with its unit, such as 50ms or 0.05s, is expected.', 6, 8],
      ['ch33 > 1', 'Character 1: a channel from ch1 to ch32 is expected.', 0, 4],
      ['failsafe or ch5 ? 3', 'Character 17: <, <=, >, >=, = or != is expected.', 16, 17],
      ['ch5 > 1500 volt', 'Character 12: &&, || or the end is expected.', 11, 15],
    ]) {
      await set(page, condition);
      await page.click('#trigger-arm');
      await reads(page, '#trigger-text', said);
      assert.deepEqual(await page.evaluate(() => [document.querySelector('#trigger-condition').selectionStart, document.querySelector('#trigger-condition').selectionEnd]), [from, to]);
      assert.equal(await page.getAttribute('#trigger-condition', 'aria-invalid'), 'true');
      assert.equal(await page.textContent('#trigger-arm'), 'Arm');
    }
  });

  await check('before the first frame of a recording a condition that S.Bus cannot meet is said, too', async (page) => {
    await playPaused(page, 'trigger.txt', story());
    await page.waitForSelector('#report', { state: 'visible' });
    await seek(page, 0);
    await reads(page, '[data-counter="frames"]', '0');
    await page.click('#trigger-open');
    await set(page, 'ch5 > 2047');
    await page.click('#trigger-arm');
    await reads(page, '#trigger-text', /^Character 7: a value, 0 to 2047/);
  });

  await check('in a recording the trigger goes from event to event, each in the middle, with its bytes, and says where they end', async (page) => {
    const file = path.join(build, 'trigger.txt');
    writeFileSync(file, story());
    await zoomIn(page);
    for (const [condition, places] of [
      ['ch1 > 600', [endUs(101)]],
      ['ch1 > 600 and not failsafe', [endUs(101), endUs(130)]],
      ['ch1 < 512 raw or lostframe', [endUs(0), endUs(120), endUs(200)]],
      ['failsafe', [endUs(120)]],
      ['rejected', undefined],
      ['state = failsafe', [endUs(120)]],
      ['state = stale', undefined],
      ['age > 200 ms', undefined],
      ['ch1 >= 1250 us', [endUs(91)]],
      ['ch1 > -50 %', [endUs(83)]],
      ['ch1 = 700', [endUs(200)]],
    ]) {
      await playPaused(page, file);
      await seek(page, 0);
      await set(page, condition);
      for (const us of places ?? []) {
        await page.click('#trigger-next');
        await reads(page, '#trigger-text', at(us));
        await isInMiddle(page);
        await reads(page, '#lines li:first-child .time', (us / 1e6).toFixed(3));
      }
      if (!places) {
        await page.click('#trigger-next');
        await reads(page, '#trigger-text', /^Event at/);
        const seconds = parseFloat((await text(page)).slice(9));
        const [low, high] = { rejected: [endUs(249), endUs(251)], 'state = stale': [endUs(299) + 100000, endUs(299) + 120000] }[condition] ?? [endUs(299) + 200000, endUs(299) + 220000];
        assert.ok(1e6 * seconds > low && 1e6 * seconds <= high, `${condition}: ${seconds}`);
      }
      await page.click('#trigger-next');
      await reads(page, '#trigger-text', /^No event after/);
    }
  }, { patience: 120000 });

  await check('a recording that the trigger has stopped is played on by Continue, and by Arm', async (page) => {
    await playPaused(page, 'trigger.txt', story());
    await zoomIn(page);
    await seek(page, 0);
    await set(page, 'ch1 > 600');
    await page.click('#trigger-next');
    await reads(page, '#trigger-text', at(endUs(101)));
    await reads(page, '#play', 'Play');
    await page.click('#pause');
    await reads(page, '#play', 'Pause');
    await set(page, 'lostframe && !failsafe');
    await page.click('#trigger-arm');
    await reads(page, '#trigger-text', at(endUs(200)));
    await reads(page, '#play', 'Play');
    await page.click('#trigger-arm');
    await reads(page, '#play', 'Pause');
  });

  await check('a board\'s numbers are compared as printed', async (page) => {
    await playPaused(page, 'trigger-rows.csv', `time,throttle,roll\n${Array.from({ length: 100 }, (_, i) => `${(i / 10).toFixed(3)},${i - 50}.5,7\n`).join('')}`);
    await seek(page, 1000);
    await set(page, 'ch1 > 1500 us');
    await page.click('#trigger-next');
    await reads(page, '#trigger-text', 'Character 12: leave out us and %: a board\'s numbers are compared as printed.');
    await set(page, 'ch1 > -12.5 && ch2 = 7 and not failsafe');
    await page.click('#trigger-next');
    await reads(page, '#trigger-text', at(3.9e6));
  });

  await check('at a port the trigger stops the picture once, and Continue goes on', async (page) => {
    await opensWith(page, [frame([1000]), frame([1000])]);
    await connect(page);
    await reads(page, '#bars li:nth-child(1) .raw', '1000');
    await page.evaluate((frames) => {
      fake.value = 0;
      setInterval(() => fake.port.feed(frames[fake.value]), 20);
    }, [frame([1000]), frame([1600])]);
    await zoomIn(page);
    await set(page, 'ch1 > 1500');
    await page.click('#trigger-arm');
    await reads(page, '#trigger-text', 'Armed.');
    await page.waitForTimeout(300);
    assert.equal(await text(page), 'Armed.');
    await page.evaluate(() => (fake.value = 1));
    await reads(page, '#trigger-text', /^Event at [\d.]+ s\.$/);
    await isInMiddle(page);
    assert.equal(await page.textContent('#pause'), 'Continue');
    assert.equal(await page.textContent('#trigger-arm'), 'Arm');
    const lines = await page.textContent('#lines');
    await page.waitForTimeout(300);
    assert.equal(await page.textContent('#lines'), lines);
    await isInMiddle(page);
    await page.click('#pause');
    await until('the bytes go on', async () => (await page.textContent('#lines')) !== lines);
  });

  await check('an adapter that stalls for half a second, and then hands all over, fires no condition of silence; a silent line does', async (page) => {
    await connect(page);
    await page.evaluate((bytes) => (fake.timer = fake.every(9, bytes)), frame([1000]));
    await reads(page, '#state', 'Fine');
    await page.waitForTimeout(1500); // the pace of a line is known after half a second
    await set(page, 'age > 150 ms');
    await page.click('#trigger-arm');
    await page.evaluate(() => {
      const feed = fake.port.feed.bind(fake.port);
      const held = [];
      fake.port.feed = (packet) => held.push(...packet) > 0;
      setTimeout(() => {
        fake.port.feed = feed;
        feed(held);
      }, 500);
    });
    await reads(page, '#trigger-text', /^Event at [\d.]+ s; the picture is filling\.$/);
    await reads(page, '#trigger-text', 'Armed.');
    assert.equal(await page.getAttribute('#trigger-arm', 'aria-pressed'), 'true');
    await page.evaluate(() => clearInterval(fake.timer));
    await reads(page, '#trigger-text', /^Event at [\d.]+ s\.$/);
  });

  await check('an event of more than five minutes ago, while the page was in the background, is said', async (page) => {
    await opensWith(page, [frame([1000]), frame([1000])]);
    await connect(page);
    await reads(page, '#bars li:nth-child(1) .raw', '1000');
    await set(page, 'failsafe');
    await page.click('#trigger-arm');
    await reads(page, '#trigger-text', 'Armed.');
    await page.evaluate(() => {
      const draw = requestAnimationFrame;
      globalThis.requestAnimationFrame = (picture) => void (globalThis.shown = () => (globalThis.requestAnimationFrame = draw)(picture));
    });
    await until('its last picture is not drawn', () => page.evaluate(() => globalThis.shown !== undefined));
    const before = await counter(page, 'frames');
    await page.evaluate(([bad, good]) => {
      fake.port.feed([...good, ...bad, ...good]);
      const many = Array(150).fill(good).flat(); // what the port's buffer holds
      fake.left = 230;
      const timer = setInterval(() => fake.port.feed(many) && --fake.left === 0 && clearInterval(timer), 15);
    }, [frame([1000], { flags: 8 }), frame([1000])]);
    await until('not all is fed', () => page.evaluate(() => fake.left === 0));
    await page.evaluate(() => shown());
    await until('not all frames came', async () => (await counter(page, 'frames')) > before + 34000);
    await reads(page, '#trigger-text', /^Event at [\d.]+ s, which the curves do not reach: the page was in the background\.$/);
    assert.equal(await page.textContent('#trigger-arm'), 'Arm');
  });
}
