// The wire below the bytes: its edges as the capture has them, at any zoom, the names of bits, and which of them is wrong.
import assert from 'node:assert/strict';
import { clean, fits } from './looks.mjs';
import { load, random } from './modules.mjs';
import { Native } from './native.mjs';
import { check, drawn, frame, playPaused, reads, seek, until } from './support.mjs';

const bitUs = 10;
const seed = Number(process.env.SEED ?? 42);
const frames = 3000;
const bad = { parity: 5 * 25 + 3, stop: 5 * 25 + 6 }; // characters
const bytes = Array.from({ length: frames }, (_, i) => frame([500 + (i % 1000), 992, 300]));
const beginOf = (character) => 9000 * (Math.floor(character / 25) + 1) + (character % 25) * 12 * bitUs;
const byteOf = (character) => bytes[Math.floor(character / 25)][character % 25];

// Start, d0 to d7, parity, stop, stop, as they are on the wire: 1 is idle.
function bitsOf(character) {
  const data = Array.from({ length: 8 }, (_, bit) => (byteOf(character) >> bit) & 1);
  const parity = data.reduce((sum, bit) => sum ^ bit, 0) ^ Number(character === bad.parity);
  return [0, ...data, parity, Number(character !== bad.stop), 1];
}

const edges = [[0, 0]];
for (let character = 0; character < 25 * frames; character++) {
  bitsOf(character).forEach((bit, i) => {
    if (edges.at(-1)[1] === bit) edges.push([beginOf(character) + i * bitUs, 1 - bit]);
  });
}
const endUs = edges.at(-1)[0] + 20000;
const vcd = `$timescale 1us $end\n$var wire 1 ! RX $end\n$enddefinitions $end\n${edges.map(([us, high]) => `#${us}\n${high}!\n`).join('')}#${endUs}\n`;

// The edges that begin before `toUs`, from the newest before `fromUs` on.
const { firstFrom } = await load('numbers');
const firstAt = (isBefore) => firstFrom(0, edges.length, (i) => isBefore(edges[i][0]));
const truth = (fromUs, toUs) => edges.slice(Math.max(firstAt((us) => us <= fromUs) - 1, 0), firstAt((us) => us < toUs));

// Whether the curve is high or low in the middle of a bit: where the canvas has its colour.
const levelAt = (page, us) => page.evaluate(([timeUs, fromUs, toUs]) => {
  const canvas = document.querySelector('#wire-plot canvas');
  const over = document.querySelector('#wire-plot .u-over').getBoundingClientRect();
  const place = canvas.getBoundingClientRect();
  const x = Math.round(over.left - place.left + (over.width * (timeUs - fromUs)) / (toUs - fromUs));
  const copy = Object.assign(document.createElement('canvas'), { width: 1, height: canvas.height }).getContext('2d', { willReadFrequently: true });
  copy.drawImage(canvas, -x, 0);
  const { data } = copy.getImageData(0, 0, 1, canvas.height);
  const y = (level) => over.top - place.top + (over.height * (1.15 - level)) / (1.15 + 0.9);
  const isBlue = (level) => [-1, 0, 1].some((off) => data[4 * (Math.round(y(level)) + off) + 2] > data[4 * (Math.round(y(level)) + off)] + 60);
  return isBlue(1) ? 1 : isBlue(0) ? 0 : undefined;
}, us);

export default async function () {
  await check(`any part of a capture has its edges, and each column its levels, seed ${seed}`, async () => {
    const native = await new Native().load();
    native.open(vcd);
    const { wasm } = native;
    const next = random(seed);
    for (let i = 0; i < 300; i++) {
      const fromUs = Math.floor(next() * endUs);
      const toUs = fromUs + Math.ceil(20 * 2 ** (next() * 13));
      const expected = truth(fromUs, toUs);
      const first = wasm.edges(fromUs, toUs, 4000);
      if (expected.length > 4000) {
        assert.equal(first, -1);
      } else {
        const found = Array.from(new Float64Array(wasm.memory.buffer, wasm.transferBuffer(), first & 0xffff));
        assert.deepEqual([found, first >> 16], [expected.map(([us]) => us), expected[0]?.[1] ?? 0], `${fromUs} to ${toUs}`);
      }
      const columns = 50;
      wasm.levels(fromUs, toUs, columns);
      const masks = new Uint8Array(wasm.memory.buffer, wasm.transferBuffer(), columns).slice();
      const wide = (toUs - fromUs) / columns;
      masks.forEach((mask, column) => {
        const [begin, end] = [fromUs + column * wide, fromUs + (column + 1) * wide];
        const inner = truth(begin + 1e-6, end - 1e-6).reduce((sum, [, high]) => sum | (1 << high), 0);
        assert.equal(mask & inner, inner, `column ${column} of ${fromUs} to ${toUs}`);
      });
    }
  });

  await check('the wire of a capture shows each bit of a character with its name, and which bit of a bad one is wrong', async (page) => {
    await playPaused(page, 'wire.vcd', vcd);
    for (const [character, wrong] of [[5 * 25 + 1, ''], [bad.parity, ', wrong parity'], [bad.stop, ', wrong stop bit']]) {
      const begin = beginOf(character);
      const frameUs = beginOf(4 * 25); // the frame after it is damaged
      await seek(page, 50);
      await reads(page, '#lines .time', /^0\.04[78]$/);
      await page.focus('#wire-plot');
      await page.keyboard.press('0');
      await reads(page, '#wire-width', '3.3 ms'); // the last whole frame
      await page.keyboard.press('+');
      await reads(page, '#wire-width', '825 µs');
      const steps = Math.round((frameUs + 1500 - begin) / 82.5);
      for (let i = 0; i < Math.abs(steps); i++) await page.keyboard.press(steps > 0 ? 'ArrowLeft' : 'ArrowRight');
      const fromUs = frameUs + 1500 - 412.5 - 82.5 * steps;
      const toUs = fromUs + 825;
      const hex = byteOf(character).toString(16).toUpperCase().padStart(2, '0');
      const names = ['start', ...Array.from({ length: 8 }, (_, bit) => `d${bit} = ${(byteOf(character) >> bit) & 1}`), 'parity', 'stop', 'stop'];
      const bits = bitsOf(character);
      for (const [bit, name] of names.entries()) {
        const us = begin + (bit + 0.5) * bitUs;
        const over = await page.locator('#wire-plot .u-over').boundingBox();
        await page.mouse.move(over.x + (over.width * (us - fromUs)) / (toUs - fromUs), over.y + 20);
        await reads(page, '#wire-text', `${hex} at ${(begin / 1e6).toFixed(6)} s${wrong}; here ${name}.`);
        await drawn(page);
        assert.equal(await levelAt(page, [us, fromUs, toUs]), 1 - bits[bit], `${name} of ${hex}`);
      }
    }
  });

  await check('the wire zooms from a whole capture to two bits, and follows the recording; faults, curves, bits and wire are on one screen', async (page) => {
    await playPaused(page, 'wire.vcd', vcd);
    const below = () => page.$$eval('#fault-next, #plot, #bits, #wire-plot', (all) => all.map((each) => [each.id, each.getBoundingClientRect().bottom + scrollY]).filter(([, bottom]) => bottom > 900));
    await until(async () => `below 900 px: ${await below()}`, async () => (await below()).length === 0);
    await page.setViewportSize({ width: 1400, height: 900 });
    await until('25 bytes in two rows', () => page.$$eval('#bits .byte', (all) => all.length === 25 && all[0].offsetTop === all[24].offsetTop));
    assert.equal((await page.locator('#plot').boundingBox()).height, (await page.locator('#wire-plot').boundingBox()).height);
    await seek(page, 10000);
    for (let i = 0; i < 9; i++) await page.click('#wire-out');
    await reads(page, '#wire-width', /^28\.\d s$/);
    for (let i = 0; i < 14; i++) await page.click('#wire-in');
    await reads(page, '#wire-width', '20 µs');
    await fits(page);
    await clean(page);
    await page.focus('#wire-plot');
    await page.keyboard.press('0');
    await page.mouse.move(0, 0);
    await reads(page, '#wire-text', /^[0-9A-F]{2} at 9\.99/);
    await seek(page, 20000);
    await reads(page, '#wire-text', /^[0-9A-F]{2} at 19\.99/);
    await page.click('#source-simulated');
    await until('a simulation has a wire', () => page.evaluate(() => document.querySelector('#wire').hidden));
  });
}
