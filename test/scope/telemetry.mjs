// Telemetry of S.BUS2 on the page: its card, and slots that are neither a fault nor discarded.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { clean, fits } from './looks.mjs';
import { check, connect, counts, drawn, frame, play, playPaused, reads, recorded, seek, until } from './support.mjs';

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

// A minute of frames and slots: the receiver's voltage, and an SBS-01V whose battery rises by 0.1 V with each of its answers.
const batteryV = (us) => (40 + Math.floor(us / 60000)) / 10;
function rising() {
  let text = '';
  for (let i = 0; i < 4000; i++) {
    const us = 15000 * i + 120;
    text += recorded(us, frame([1000], { end: 0x10 * (i % 4) + 4 }));
    if (i % 4 === 0) {
      const battery = Math.round(10 * batteryV(us)) | 0x8000;
      text += recorded(us + 5030, [0x03, 0xc0, 0x2e, 0x83, battery >> 8, battery & 0xff, 0x43, 0x00, 0x7d]);
    }
  }
  return text;
}

const list = (page) => page.$$eval('#telemetry-list li', (items) => items.map((item) => item.textContent));

export default async function () {
  await check('telemetry has a card while slots come, with both voltages of the receiver and the slots; they are no fault', async (page) => {
    assert.ok(await page.locator('#telemetry').isHidden());
    await playPaused(page, 'telemetry.txt', line());
    await seek(page, 8000);
    const expected = ['receiver voltage 4.6 V', 'external voltage 24.1 V', 'slots 0, 1, 2'];
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

  const playRising = async (page) => {
    await playPaused(page, 'rising.txt', rising());
    await seek(page, 50000);
    await reads(page, '#position-text', /^0:50/);
    await page.waitForSelector('#telemetry', { state: 'visible' });
  };
  const chip = (page, name) => page.locator('#telemetry-list .chip', { hasText: name });
  const lists = (page, expected) => until(async () => String(await list(page)), async () => String(await list(page)) === String(expected));

  await check('a sensor that is named has its readings in the card and as curves: the pointer and the cursors have their values', async (page) => {
    await playRising(page);
    await lists(page, ['receiver voltage 4.6 V', 'slots 0, 1, 2']);
    await page.selectOption('[data-slot="1"]', 'SBS-01V');
    await lists(page, ['receiver voltage 4.6 V', `battery voltage ${batteryV(49980000)} V`, 'external voltage 12.5 V', 'slots 0, 1, 2']);
    await reads(page, '#position-text', /^0:50/);
    assert.deepEqual(await page.$$eval('#sensors select', (all) => all.map(({ dataset, value }) => [dataset.slot, value])), [['1', 'SBS-01V']]);
    await chip(page, 'battery voltage').click();
    await drawn(page);
    await clean(page);
    const over = await page.locator('#plot .u-over').boundingBox();
    const seconds = parseFloat(await page.textContent('#window'));
    for (const part of [0.1, 0.35, 0.8]) {
      await page.mouse.move(over.x + part * over.width, over.y + 30);
      await drawn(page);
      const [, time, volts] = /^([\d.]+) s.* battery voltage ([\d.]+) V/.exec(await page.textContent('#readout'));
      assert.ok(Math.abs(time - (50 - seconds * (1 - part))) < 0.05, time);
      const newest = Math.floor((time * 1e6 - 9000) / 60000) * 60000; // a slot is proved by the frame that follows
      assert.equal(Number(volts), batteryV(newest), `at ${time} s`);
    }
    await page.click('#cursors');
    await until('the table has the readings', async () => {
      const cells = await page.$$eval('#cursor-values tr', (rows) => rows.map((row) => row.lastElementChild.textContent));
      const [a, b] = cells.slice(1, 3).map(parseFloat);
      return cells[0] === 'battery voltage' && b > a && cells[3] === `+${+(b - a).toFixed(6)} V` && cells[1].endsWith(' V');
    });
  });

  await check('a sensor is remembered, has its slots for itself, and is taken away again', async (page) => {
    await playRising(page);
    await page.selectOption('[data-slot="2"]', 'SBS-01T');
    await until('slot 2 is measured', async () => (await list(page)).some((line) => line.startsWith('temperature')));
    const offered = () => page.$$eval('[data-slot="1"] option', (all) => all.map(({ value }) => value));
    assert.deepEqual(await offered(), ['unknown', 'SBS-01T', 'F1713', 'SBS-01R', 'SBS-01TAS']);
    await page.selectOption('[data-slot="2"]', 'unknown');
    await until('both slots are free', async () => (await offered()).includes('SBS-01V'));
    await page.selectOption('[data-slot="1"]', 'SBS-01V');
    await page.reload();
    await playRising(page);
    await until('it is remembered', async () => (await list(page)).includes('external voltage 12.5 V'));
    assert.equal(await page.locator('[data-slot="2"]').count(), 0);
    await fits(page);
    await clean(page);
  }, { size: { width: 360, height: 740 }, colorScheme: 'dark' });

  await check('a sensor that is chosen for a recording leaves the trigger armed, and what was recorded so far is saved', async (page) => {
    await play(page, 'telemetry.txt', line());
    await page.click('#record');
    await page.waitForSelector('#telemetry', { state: 'visible' });
    await page.click('#trigger-open');
    await page.fill('#trigger-condition', 'ch1 > 1400');
    await page.click('#trigger-arm');
    const saved = page.waitForEvent('download');
    await page.selectOption('[data-slot="1"]', 'SBS-01V');
    assert.ok(readFileSync(await (await saved).path(), 'utf8').split('\n').length > 10);
    await reads(page, '#record-text', 'Record');
    await reads(page, '#trigger-text', /^Event at 6\.018 s\.$/);
  });

  await check('the readings of a port are curves', async (page) => {
    await connect(page);
    await page.evaluate((bytes) => {
      let i = 0;
      globalThis.feeding = setInterval(() => {
        const [head, slots] = bytes;
        fake.port.feed([...head.slice(0, 24), 0x10 * (i % 4) + 4]);
        if (i++ % 4 === 0) setTimeout(() => fake.port.feed(slots), 4);
      }, 15);
    }, [frame([1000]), [0x03, 0xc0, 0x2e, 0x83, 0x80, 0x38, 0x43, 0x00, 0x7d]]);
    await page.waitForSelector('[data-slot="1"]');
    await page.selectOption('[data-slot="1"]', 'SBS-01V');
    await chip(page, 'battery voltage').click();
    await until('the newest frame has it', async () => {
      const over = await page.locator('#plot .u-over').boundingBox();
      if (!over) return false; // the plot is being built
      await page.mouse.move(over.x + over.width - 3, over.y + 30);
      return / battery voltage 5.6 V/.test(await page.textContent('#readout'));
    });
    await page.evaluate(() => clearInterval(feeding));
    await until('an old value is none', async () => (await list(page)).includes('battery voltage –'));
  });
}
