// Telemetry of S.BUS2 on the page: its card, and slots that are neither a fault nor discarded.
import assert from 'node:assert/strict';
import { check, counts, frame, reads, recorded, seek, until } from './support.mjs';

// 15 s of frames; in the first 10 s the receiver and an SBS-01V answer after each that ends in 04.
function line() {
  let text = '';
  for (let i = 0; i < 1000; i++) {
    const us = 15000 * i + 120;
    text += recorded(us, frame([1000 + (i % 500)], { end: 0x10 * (i % 4) + 4 }));
    if (i % 4 === 0 && i < 667) {
      const receiver = i % 8 === 0 ? [0x03, 0xc0, 0x2e] : [0x03, 0xc4, 0xf1];
      text += recorded(us + 5030, [...receiver, 0x83, 0x80, 0x38, 0x43, 0x00, 0x7d]);
    }
  }
  return text;
}

const list = (page) => page.$$eval('#telemetry-list li', (items) => items.map((item) => item.textContent));

export default async function () {
  await check('telemetry has a card while slots come, with both voltages of the receiver and the slots; they are no fault', async (page) => {
    assert.ok(await page.locator('#telemetry').isHidden());
    await page.setInputFiles('#file', { name: 'telemetry.txt', mimeType: 'text/plain', buffer: Buffer.from(line()) });
    await reads(page, '#title', 'Recording telemetry.txt');
    await page.click('#play'); // pauses
    await seek(page, 8000);
    const expected = ['external voltage 24.1 V', 'receiver voltage 4.6 V', 'slots 0, 1, 2'];
    await until(async () => String(await list(page)), async () => String(await list(page)) === String(expected));
    await counts(page, 'discardedBytes', 0);
    await reads(page, '#verdict-text', /^All well/);
    await until('the slots are named', async () => (await page.locator('.lines .why').allTextContents()).includes('telemetry slots 0, 1, 2'));
    assert.equal(await page.locator('.lines .none').count(), 0);
    await seek(page, 14000);
    await page.waitForSelector('#telemetry', { state: 'hidden' });
    await seek(page, 5000);
    await page.waitForSelector('#telemetry', { state: 'visible' });
  });
}
