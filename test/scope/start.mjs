// The page when it opens: a simulated receiver, and its faults.
import assert from 'node:assert/strict';
import { check, counts, lit, raw, reads, until } from './support.mjs';

const counted = (name) => `[data-counter="${name}"]`;

export default async function () {
  await check('a check leaves storage, a script and a pressed key behind', async (page) => {
    await page.evaluate(async () => {
      localStorage.setItem('left', 'behind');
      globalThis.left = 'behind';
      await new Promise((resolve) => (indexedDB.open('left').onsuccess = resolve));
    });
    await page.addInitScript(() => (globalThis.leftScript = 'behind'));
    await page.keyboard.down('Shift');
  });
  await check('the next check finds nothing of them', async (page) => {
    await page.evaluate(() => addEventListener('mousemove', (event) => (globalThis.shift = event.shiftKey)));
    await page.mouse.move(700, 400);
    const found = await page.evaluate(async () =>
      [localStorage.length, globalThis.left, globalThis.leftScript, (await indexedDB.databases()).length, globalThis.shift]);
    assert.deepEqual(found, [0, undefined, undefined, 0, false]);
  });

  await check('the page opens with the simulated receiver running, and requests nothing from the network', async (page) => {
    await reads(page, '#state', 'Fine');
    await reads(page, '#verdict-text', 'Simulation.');
    await reads(page, '#verdict-remedy', 'Connect yours with Adapter…, or drop a file.');
    await reads(page, '#rate', /^11[0-2]$/);
    await reads(page, '#gap', '9.0 ms');
    await counts(page, 'frames', /^\d{3}/);
    assert.equal(await page.locator('#bars li:visible').count(), 16);
    await raw(page, 7, '992');
    await reads(page, '#bars li:nth-child(7) .us', '1500');
    await reads(page, '#bars li:nth-child(7) .percent', '0.0');
  });

  await check('the page may run no script but its own, and fetch nothing', async (page) => {
    const policy = await page.getAttribute('meta[http-equiv="Content-Security-Policy"]', 'content');
    assert.match(policy, /default-src 'none'; script-src 'sha256-[^']+' 'wasm-unsafe-eval'/);
    assert.equal(await page.evaluate(() => fetch('https://example.org/').then(() => 'fetched', () => 'rejected')), 'rejected');
    page.complaints.length = 0;  // that was one
  });

  await check('a browser without WebAssembly shows a message, not a blank page', async (page) => {
    await page.addInitScript(() => (WebAssembly.instantiate = () => Promise.reject(new Error('no WebAssembly'))));
    await page.reload();
    await reads(page, '#verdict-text', 'The page has failed: no WebAssembly.');
    page.complaints.length = 0;
  });

  await check('a cut wire shows at once: stale, doubtful values, no signal; once it is joined, all is fine', async (page) => {
    await reads(page, '#state', 'Fine');
    await page.click('#cut');
    await reads(page, '#state', 'Stale');
    await page.waitForSelector('#bars.doubtful');
    await reads(page, '#verdict-text', 'Signal lost: frames came before, but no bytes come now.');
    await reads(page, '#verdict-remedy', /^Check wire, pin and receiver/);
    await reads(page, '#rate', '0');
    await page.click('#cut');
    await reads(page, '#state', 'Fine');
    await reads(page, '#verdict-text', 'Simulation.');
  });

  for (const [fault, found] of [
    ['inversion', /^Wrong polarity: .* The page has set it: 100000 baud, inverted\.$/],
    ['baud', /^Wrong baud rate: .* The page has set it: 100000 baud, inverted\.$/],
  ]) {
    await check(`at the simulated fault ${fault} the page tries the other settings, says which is right, and keeps it`, async (page) => {
      await page.selectOption('#fault', fault);
      await reads(page, '#verdict-note', /^Trying /);
      await reads(page, '#verdict-note', found);
      await reads(page, '#state', 'Fine');
    });
  }

  for (const [sentence, of, choice, ...shown] of [
    ['simulated noise shows as character errors, discarded bytes and the verdict Noise', '#fault', 'noise',
      ['#verdict-text', /^Noise: frames are damaged/], [counted('characterErrors'), /^\d\d/], [counted('discardedBytes'), /^\d\d/], ['#lines .none .why', /./]],
    ['without any signal the page says so from the start, in all settings', '#fault', 'silent',
      ['#verdict-text', 'No signal: not a byte with any setting.'], [counted('frames'), '0']],
    ['32 channels are shown, also those of the frames with header 2F', '#receiver', '32',
      ['#bars li:nth-child(32) .raw', /^1[67]\d\d$/], [counted('extraFrames'), /^[1-9]/], ['#rate', /^5[5-7]$/], ['#indicator-ch17', /^DG1/]],
  ]) {
    await check(sentence, async (page) => {
      await page.selectOption(of, choice);
      for (const [where, text] of shown) await reads(page, where, text);
    });
  }

  await check('24 channels are all shown, without switches', async (page) => {
    await page.selectOption('#receiver', '24');
    await reads(page, '#verdict-text', '24 channels: frames come, but of 24 channels, not of 16.');
    await reads(page, '#bars li:nth-child(24) .chip', 'CH24');
    assert.equal(await page.locator('#bars li:visible').count(), 24);
    await raw(page, 24, /^1[234]\d\d$/);
    await until('its bytes are not shown', async () => (await page.locator('#bits .byte').count()) === 36);
    assert.equal(await page.locator('.indicator:visible').count(), 2);
  });

  await check("failsafe shows in the verdict, the indicator, the receiver's failsafe values and the curves", async (page) => {
    await lit(page, 'failsafe');  // after 10 s of the flight
    await reads(page, '#state', 'Failsafe');
    await reads(page, '#verdict-text', 'Failsafe: the receiver works, but has lost the link.');
    await raw(page, 3, '172');
    await counts(page, 'failsafeFrames', /^[1-9]/);
  });
}
