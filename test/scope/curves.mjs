// Curves and bytes: what pointer and keyboard show of them.
import assert from 'node:assert/strict';
import { check, codes, connect, counts, frame, play, raw, reads, root, toEnd, until } from './support.mjs';
import path from 'node:path';

const pixels = (page) => page.evaluate(() => {
  const canvas = document.querySelector('#plot canvas');
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  const colors = new Map();
  for (let i = 0; i < data.length; i += 4) {
    if (data[i + 3] > 200) {
      const color = `${data[i]},${data[i + 1]},${data[i + 2]}`;
      colors.set(color, (colors.get(color) ?? 0) + 1);
    }
  }
  return Object.fromEntries(colors);
});
const colorOf = (page, channel) => page.evaluate((name) => {
  const probe = document.body.appendChild(document.createElement('i'));
  probe.style.color = `var(--c${name - 1})`;
  const color = getComputedStyle(probe).color.match(/\d+/g).join(',');
  probe.remove();
  return color;
}, channel);

export default async function () {
  await check('CH1 to CH4 are drawn, each in its colour; the button of a channel shows or hides its curve', async (page) => {
    await reads(page, '#state', 'Fine');
    await until('CH1 is not drawn', async () => (await pixels(page))[await colorOf(page, 1)] > 20);
    assert.equal((await pixels(page))[await colorOf(page, 6)], undefined);
    await page.click('#bars li:nth-child(6) .chip');
    await until('CH6 is not drawn', async () => (await pixels(page))[await colorOf(page, 6)] > 5);
    await page.click('#bars li:nth-child(1) .chip');
    await until('CH1 is still drawn', async () => (await pixels(page))[await colorOf(page, 1)] === undefined);
    page.complaints.length = 0;  // about reading pixels
  });

  await check('the curve of a slow sketch joins rows that are four seconds apart', async (page) => {
    await connect(page, 'board');
    await page.click('#zoom-out');
    await reads(page, '#window', '20 s');
    for (let i = 0; i < 4; i++) {
      await page.evaluate((row) => fake.port.feed(row), codes('1500,1000\r\n'));
      await counts(page, 'rows', i);
      await page.evaluate(() => fake.skip(4000));
    }
    await until('CH1 is not drawn', async () => (await pixels(page))[await colorOf(page, 1)] > 200);
    page.complaints.length = 0;  // about reading pixels
  });

  await check('keys pause, zoom and scroll; End continues', async (page) => {
    await reads(page, '#window', '10 s');
    await page.focus('#plot');
    await page.keyboard.press('+');
    await reads(page, '#window', '5 s');
    await page.keyboard.press('-');
    await page.keyboard.press('-');
    await reads(page, '#window', '20 s');
    await page.keyboard.press(' ');
    await reads(page, '#pause', 'Continue');
    await page.keyboard.press('End');
    await reads(page, '#pause', 'Pause');
    await page.keyboard.press('ArrowLeft');
    await reads(page, '#pause', 'Continue');
  });

  await check('curves that moved by less than a pixel are not drawn again: four minutes a few times a second, a pause never', async (page) => {
    await page.addInitScript(() => {
      const clear = CanvasRenderingContext2D.prototype.clearRect;
      globalThis.drawn = 0;
      CanvasRenderingContext2D.prototype.clearRect = function (...place) {
        globalThis.drawn++;
        clear.apply(this, place);
      };
    });
    await page.reload();
    await reads(page, '#state', 'Fine');
    // Pictures drawn, and frames that came, at one moment.
    const both = () => page.evaluate(() => [globalThis.drawn, Number(document.querySelector('[data-counter="frames"]').textContent.replace(/\D/g, ''))]);
    const all = async () => (await both())[0];
    // Pictures in each 100 frames, while 100 come or, on a busy PC, more.
    const drawn = async (frames) => {
      const [picture, frame] = await both();
      let now;
      await until('no frames come', async () => (now = await both())[1] >= frame + frames);
      return (100 * (now[0] - picture)) / (now[1] - frame);
    };
    assert.ok((await drawn(50)) > 6);
    for (const seconds of [20, 30, 60, 120, 240]) {
      await page.click('#zoom-out');
      await reads(page, '#window', `${seconds} s`);
    }
    const few = await drawn(200);
    assert.ok(few > 0 && few <= 4, `${few}`);
    await page.click('#pause');
    await reads(page, '#pause', 'Continue');
    await drawn(100);
    assert.equal(await drawn(100), 0);
    const before = await all();
    await page.click('#theme');
    await until('the theme is not drawn', async () => (await all()) > before);
  });

  await check('the pointer reads time and values; dragging with Shift zooms in and pauses', async (page) => {
    await play(page, path.join(root, 'test/recordings/paper.txt'));
    await toEnd(page);
    const box = await page.locator('#plot .u-over').boundingBox();
    await page.mouse.move(box.x + 0.998 * box.width, box.y + 50);
    await reads(page, '#readout', /^0\.3[678]\d s {3}CH1 995 {3}CH2 993 {3}CH3 1811 {3}CH4 992$/);
    await page.keyboard.down('Shift');
    await page.mouse.down();
    await page.mouse.move(box.x + 0.96 * box.width, box.y + 50, { steps: 4 });
    await page.mouse.up();
    await reads(page, '#pause', 'Continue');
    await reads(page, '#window', '0.5 s');
  });

  await check('pointing at a bit shows its channel and its value; meanwhile the view stands still', async (page) => {
    await page.evaluate((bytes) => (fake.port.onOpen = () => fake.every(9, bytes)), frame([172, 992, 1811]));
    await connect(page);
    await raw(page, 3, '1811');
    await page.waitForSelector('#bits .byte');
    await page.hover('[data-bit="8"]');
    await reads(page, '#bit-text', 'CH1, bit 0 (worth 1): byte 1, bit 0. CH1 = 172 = 00010101100 in binary.');
    await page.hover('[data-bit="31"]');
    await reads(page, '#bit-text', 'CH3, bit 1 (worth 2): byte 3, bit 7. CH3 = 1811 = 11100010011 in binary.');
    assert.equal(await page.locator('#bits .same').count(), 11);
    await page.hover('[data-bit="186"]');
    await reads(page, '#bit-text', 'The lost-frame flag: byte 23, bit 2, of the flags.');
    await page.hover('[data-bit="0"]');
    await reads(page, '#bit-text', 'The header: byte 0, bit 0.');
    const held = await page.textContent('#lines');
    await page.waitForTimeout(300);
    assert.equal(await page.textContent('#lines'), held);
    await page.mouse.move(5, 5);
    await until('it holds still', async () => (await page.textContent('#lines')) !== held);
    await page.focus('#bits');
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('ArrowRight');
    await reads(page, '#bit-text', /^The header: byte 0, bit 1\.$|^CH\d+, bit/);
  });
}
