// A calibration at a port.
import assert from 'node:assert/strict';
import { check, connect, counter, counts, frame, opensWith, reads } from './support.mjs';

// Sends this many frames of these channels, as quickly as it goes, and waits until the page has them all: a late one would
// count for the next step.
async function frames(page, list) {
  const before = await counter(page, 'frames');
  for (const channels of list) {
    assert.ok(await page.evaluate((bytes) => fake.port.feed(bytes), frame(channels)), 'the port is closed');
    await page.evaluate(() => fake.skip(9));
  }
  await counts(page, 'frames', before + list.length);
}
const times = (count, channels) => Array.from({ length: count }, () => channels);
const whole = [...times(10, [200, 200, 250, 300]), ...times(10, [1800, 1790, 1750, 1700])]; // travel

async function calibrate(page, travel) {
  await opensWith(page, times(3, frame(travel[0])));
  await connect(page);
  await counts(page, 'frames', 3);
  await page.click('#calibrate');
  await reads(page, '#calibration-text', /^1 of 3/);
  await frames(page, travel);
  await page.click('#calibration-next');
  await reads(page, '#calibration-text', /^2 of 3/);
  await frames(page, times(30, [1000, 990, 250, 1024]));
  await page.click('#calibration-next');
  await reads(page, '#calibration-text', /^3 of 3/);
  await frames(page, times(100, [1800, 200, 1750, 1700]));
  await page.click('#calibration-next');
}

export default async function () {
  await check('after the three steps of a calibration 100 % is where the sticks end, and CH2 runs backwards', async (page) => {
    await calibrate(page, whole);
    await page.waitForSelector('#calibration', { state: 'hidden' });
    assert.equal(await page.inputValue('#scale'), '2');
    await frames(page, times(3, [1800, 200, 250, 1024]));
    await reads(page, '#bars li:nth-child(1) .percent', '100.0');
    await reads(page, '#bars li:nth-child(2) .percent', '100.0');
    await reads(page, '#bars li:nth-child(3) .percent', '-100.0');
    await reads(page, '#bars li:nth-child(4) .percent', '0.0');
    await reads(page, '#bars li:nth-child(2) .us', '2012');
  });

  const stored = (page) => page.evaluate(() => localStorage.getItem('sbus-scope-calibration'));

  await check('a calibration outlives the page, says that it is used, and can be removed', async (page) => {
    await calibrate(page, whole);
    await reads(page, '#calibrated-text', `Calibrated on ${new Date().toLocaleDateString('en-US')}.`);
    await page.reload();
    await page.waitForSelector('#calibrated');
    assert.equal(await page.inputValue('#scale'), '2');
    await opensWith(page, times(3, frame([1800, 200, 250, 1024])));
    await connect(page);
    await reads(page, '#bars li:nth-child(2) .percent', '100.0');
    await page.selectOption('#scale', '1');
    await page.waitForSelector('#calibrated', { state: 'hidden' });
    await page.selectOption('#scale', '2');
    await page.click('#calibration-drop');
    await page.waitForSelector('#calibrated', { state: 'hidden' });
    assert.equal(await page.inputValue('#scale'), '0');
    assert.ok(await page.locator('#scale option').nth(2).evaluate((option) => option.disabled));
    await reads(page, '#bars li:nth-child(2) .percent', '-96.6');
    assert.equal(await stored(page), null);
    await page.reload();
    await reads(page, '#state', 'Fine');
    assert.equal(await page.inputValue('#scale'), '0');
  }, { locale: 'en-US' });

  await check('a stored calibration that is damaged is not used', async (page) => {
    await calibrate(page, whole);
    const good = await stored(page);
    for (const bad of [good.slice(0, -1), good.replace(/(....)$/, '0000'), good.replace(/ 01/, ' 02'), 'nonsense', '']) {
      await page.evaluate((value) => localStorage.setItem('sbus-scope-calibration', value), bad);
      await page.reload();
      await reads(page, '#state', 'Fine');
      assert.equal(await page.inputValue('#scale'), '0', bad);
    }
  });

  await check('a browser that stores nothing can calibrate all the same', async (page) => {
    await page.addInitScript(() => Object.defineProperty(window, 'localStorage', { get: () => { throw new DOMException('denied', 'SecurityError'); } }));
    await page.reload();
    await reads(page, '#state', 'Fine');
    await calibrate(page, whole);
    await reads(page, '#calibration-text', ''); // it says what is missing
    await page.waitForSelector('#calibrated');
    await page.click('#calibration-drop');
    assert.equal(await page.inputValue('#scale'), '0');
  });

  await check('a stick that was not moved is rejected, with the channel and what to do', async (page) => {
    await calibrate(page, [...times(10, [200, 200, 250, 1000]), ...times(10, [1800, 1790, 1750, 1030])]);
    await reads(page, '#calibration-text', /^Not accepted: CH4 .*move it to both ends/);
    assert.equal(await page.inputValue('#scale'), '0');
  });

  await check("the Futaba scale's centre is 1024", async (page) => {
    await opensWith(page, times(5, frame([1024, 352, 1696])));
    await connect(page);
    await page.selectOption('#scale', '1');
    await reads(page, '#bars li:nth-child(1) .us', '1520');
    await reads(page, '#bars li:nth-child(1) .percent', '0.0');
    await reads(page, '#bars li:nth-child(2) .percent', '-100.0');
    await reads(page, '#bars li:nth-child(2) .us', '1100');
    await reads(page, '#bars li:nth-child(3) .us', '1940');
  });

  await check('marks show the lowest and highest value, and their button clears them', async (page) => {
    await opensWith(page, [...times(3, frame([300])), ...times(3, frame([1500]))]);
    await connect(page);
    await counts(page, 'frames', 6);
    await page.waitForSelector('#bars li:nth-child(1) .track[title="CH1: lowest 300, highest 1500"]');
    await page.click('#reset-marks');
    await frames(page, times(3, [700]));
    await page.waitForSelector('#bars li:nth-child(1) .track[title="CH1: lowest 700, highest 700"]');
  });
}
