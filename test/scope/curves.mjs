// Curves and bytes: what pointer and keyboard show of them.
import assert from 'node:assert/strict';
import path from 'node:path';
import { check, codes, connect, counts, drawn, frame, play, playPaused, playToEnd, raw, reads, recorded, root, seek, until } from './support.mjs';

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
    const drawnIn = async (frames) => {
      const [picture, frame] = await both();
      let now;
      await until('no frames come', async () => (now = await both())[1] >= frame + frames);
      return (100 * (now[0] - picture)) / (now[1] - frame);
    };
    assert.ok((await drawnIn(50)) > 6);
    for (const seconds of [20, 30, 60, 120, 240]) {
      await page.click('#zoom-out');
      await reads(page, '#window', `${seconds} s`);
    }
    const few = await drawnIn(200);
    assert.ok(few > 0 && few <= 4, `${few}`);
    await page.click('#pause');
    await reads(page, '#pause', 'Continue');
    await drawnIn(100);
    assert.equal(await drawnIn(100), 0);
    const before = await all();
    await page.click('#theme');
    await until('the theme is not drawn', async () => (await all()) > before);
  });

  await check('the pointer reads time and values; dragging with Shift zooms in and pauses', async (page) => {
    await playToEnd(page, path.join(root, 'test/recordings/paper.txt'));
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

  await check('curves zoom out to a whole recording of 20 minutes, of which a single frame is seen; a part that is zoomed into is gone to', async (page) => {
    const value = (i) => (i === 30000 ? 1900 : i === 45000 ? 200 : 1000);
    await playPaused(page, 'whole.txt', Array.from({ length: 59999 }, (_, i) => recorded(20000 * (i + 1), frame([value(i + 1), i % 2048]))).join(''));
    await reads(page, '#fault-counts', /^whole recording/);
    for (const width of [20, 30, 60, 120, 240]) {
      await page.click('#zoom-out');
      await reads(page, '#window', `${width} s`);
    }
    for (const width of ['8 min', '20 min', '20 min']) {
      await until(`there is no ${width}`, async () => {
        await page.click('#zoom-out'); // the envelope comes a moment after the faults
        return (await page.textContent('#window')) === width;
      });
    }
    await drawn(page);
    await reads(page, '#readout', /^Each column reaches from the lowest to the highest value/);
    const over = await page.locator('#plot .u-over').boundingBox();
    const to = (seconds) => page.mouse.move(over.x + (over.width * seconds) / 1200, over.y + 40);
    let x = 599;
    await until('the frame is not read', async () => {
      await to((x = x > 601 ? 599 : x + 0.1));
      return /^(9:59|10:00)\.\d to 10:00\.\d {3}CH1 1000 to 1900 {3}CH2 \d+ to \d+/.test(await page.textContent('#readout'));
    });
    await to(896);
    await page.keyboard.down('Shift');
    await page.mouse.down();
    await to(904);
    await page.mouse.up();
    await page.keyboard.up('Shift');
    await reads(page, '#window', '10 s');
    await reads(page, '#position-text', /^15:0[0-9]\.\d /);
    await until('its frame is not read', async () => {
      await page.mouse.move(over.x + over.width * ((x += 0.01) % 1), over.y + 40);
      await drawn(page);
      return / s {3}CH1 (1000|200) {3}CH2 \d+ {3}/.test(await page.textContent('#readout'));
    });
    for (const ms of [60000, 900000]) { // the curves stand where they are, and a place that is sought stays
      await seek(page, ms);
      await reads(page, '#position-text', new RegExp(`^${ms / 60000}:00\\.0 `));
      await page.waitForTimeout(600);
      assert.match(await page.textContent('#position-text'), new RegExp(`^${ms / 60000}:00\\.0 `));
    }
    await page.focus('#plot');
    await page.keyboard.press('0');
    await reads(page, '#window', '10 s');
    await page.click('#source-simulated');
    await reads(page, '#state', 'Fine');
    for (let i = 0; i < 7; i++) await page.click('#zoom-out');
    await reads(page, '#window', '240 s');
  });

  await check('another line starts at its own length from the left, with what comes, and its label is true', async (page) => {
    const ramp = (count) => Array.from({ length: count }, (_, i) => recorded(10000 * (i + 1), frame([i + 1, 300]))).join('');
    await playPaused(page, 'twenty.txt', ramp(120000));
    await until('it cannot be seen whole', async () => {
      await page.click('#zoom-out');
      return (await page.textContent('#window')) === '20 min';
    });
    await playPaused(page, 'three.txt', ramp(300));
    await reads(page, '#window', '3 s');
    await seek(page, 1000);
    const over = await page.locator('#plot .u-over').boundingBox();
    for (const [part, value] of [[0.2, 60], [0.9, 270]]) { // before the position, and after it
      await until(`CH1 at ${part} of 3 s`, async () => {
        await page.mouse.move(over.x + part * over.width, over.y + 40);
        const [, read] = / CH1 (\d+) /.exec(await page.textContent('#readout')) ?? [];
        return Math.abs(read - value) < 4;
      });
    }
    await page.click('#source-simulated');
    await reads(page, '#window', '10 s');
    for (let i = 0; i < 7; i++) await page.click('#zoom-out');
    await reads(page, '#window', '240 s');
    await play(page, 'three.txt', ramp(300));
    await reads(page, '#window', '3 s');
  });

  await check("a whole recording of a board's numbers has an axis for all of them", async (page) => {
    await playPaused(page, 'board.csv', `time,CH1,CH2\n${Array.from({ length: 3000 }, (_, i) => `${i / 5},${i === 2500 ? -870 : i},7\n`).join('')}`);
    await seek(page, 100000);
    await until('its ends are not known', async () => (await page.getAttribute('#bars li:nth-child(1) .track', 'aria-valuemin')) === '-1000');
    assert.equal(await page.getAttribute('#bars li:nth-child(1) .track', 'aria-valuemax'), '5000');
  });
}
