// The strip of a recording: its faults along it, and the way from one to the next.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import path from 'node:path';
import { build, check, frame, play, playPaused, reads, recorded, seek, until } from './support.mjs';

// A minute of frames, 10 ms apart, and the faults in it: [what, from, to], in ms, at ends of frames. A line of recorded() ends
// 2.88 ms after its time.
const endMs = 2.88;
const lines = Array.from({ length: 6000 }, (_, i) => ({ ms: 10 * (i + 1), bytes: frame([1000, i % 2048]) }));
const at = (ms) => lines[ms / 10 - 1];
const flagged = (fromMs, toMs, flags) => {
  for (let ms = fromMs; ms < toMs; ms += 10) at(ms).bytes = frame([1000], { flags });
};
flagged(5000, 5050, 4);
flagged(5500, 5510, 4);
flagged(10000, 10010, 4);
flagged(20000, 22500, 12);
for (let ms = 30010; ms < 31000; ms += 10) at(ms).gone = true;
at(40000).bytes.splice(7, 1);
at(45000).bad = true;
flagged(50000, 50010, 4);
const text = lines.filter(({ gone }) => !gone)
  .map(({ ms, bytes, bad }) => recorded(1000 * ms, bytes).replace(/\n$/, bad ? '!\n' : '\n')).join('');
const short = 0.12; // ms: a byte less
const expected = [
  ['lost frames', 5000, 5050],
  ['lost frames', 5500, 5510],
  ['lost frames', 10000, 10010],
  ['failsafe', 20000, 22500],
  ['no frames', 30000, 31000],
  ['damaged bytes', 40000 - short, 40010],
  ['damaged bytes', 45000, 45010],
  ['lost frames', 50000, 50010],
].map(([what, from, to]) => [what, from + endMs, to + endMs]);

const clock = (ms) => `0:${(Math.floor(ms + 1e-6) / 1000).toFixed(3).padStart(6, '0')}`;
const told = ([what, from, to], i) => `Fault ${i + 1} of ${expected.length}: ${what}, ${clock(from)} to ${clock(to)}.`;
const file = path.join(build, 'faults.txt');
const decoded = (page) => until('it is not decoded', async () => (await page.getAttribute('#strip .decoded', 'width')) === '512');
const positionMs = (page) => page.inputValue('#position').then(Number);

// Returns the parts of the strip's width in which a fault is drawn: [from, to].
const boxes = (page, name) => page.$eval(`#strip .${name}`, (shape) => {
  const all = [];
  for (const [, from, width] of shape.getAttribute('d').matchAll(/M(\S+) \S+?h([\d.]+)v/g)) {
    if (Number(from) / 512 !== all.at(-1)?.[1]) all.push([Number(from) / 512]);
    all.at(-1)[1] = (Number(from) + Number(width)) / 512;
  }
  return all;
});

export default async function () {
  writeFileSync(file, text);

  await check('the strip shows where the faults of a recording are, and how many', async (page) => {
    await play(page, file);
    await decoded(page);
    assert.deepEqual(await page.$$eval('#fault-counts li', (items) => items.filter(({ hidden }) => !hidden).map(({ textContent }) => textContent)),
      ['whole recording: 8 faults', 'failsafe: 1 ×', 'lost frames: 4 ×', 'damaged bytes: 2 ×', 'no frames: 1 ×']);
    const all = 60005.88;
    for (const [name, what] of [['failsafe', 'failsafe'], ['silence', 'no frames'], ['damage', 'damaged bytes']]) {
      const wanted = expected.filter(([each]) => each === what);
      const drawn = await boxes(page, name);
      assert.equal(drawn.length, wanted.length, `${name}: ${JSON.stringify(drawn)}`);
      drawn.forEach(([from, to], i) => {
        assert.ok(from <= wanted[i][1] / all && from > wanted[i][1] / all - 1 / 512, `${name} from ${from}`);
        assert.ok(to >= wanted[i][2] / all && to < wanted[i][2] / all + 2 / 512, `${name} to ${to}`);
      });
    }
    // In failsafe frames are lost as well, and in a silence they are missing.
    await page.waitForSelector('#report:not([hidden])');
    const lost = await page.$eval('#strip .lost', (shape) => [...shape.getAttribute('d').matchAll(/M(\S+) /g)].map(([, bin]) => Number(bin) / 512));
    assert.deepEqual(lost.map((from) => Math.round((from * all) / 1000)), [5, 10, 20, 21, 22, 30, 50]);
  });

  await check('N goes from fault to fault and pauses where each shows, P goes back', async (page) => {
    await play(page, file);
    await page.focus('#plot');
    await page.click('#play');
    await seek(page, 0);
    for (const [i, fault] of expected.entries()) {
      await page.keyboard.press('n');
      await reads(page, '#fault-text', told(fault, i));
      const ms = await positionMs(page);
      const late = fault[0] === 'no frames' ? 101 : fault[0] === 'damaged bytes' ? 20 : 2;
      assert.ok(ms >= Math.floor(fault[1]) && ms <= fault[1] + late, `${fault} is shown at ${ms} ms`);
      assert.equal(await page.textContent('#play'), 'Play');
      const indicator = { 'lost frames': 'lost-frame', failsafe: 'failsafe' }[fault[0]];
      await until(() => `${fault} is not seen`, () => page.evaluate(([what, name]) =>
        what ? document.querySelector(`#indicator-${what}`).dataset.on === 'true' :
          name === 'no frames' ? document.querySelector('#state').textContent === 'Stale' :
            document.querySelector('#lines li:first-child').className === 'none' || document.querySelector('#lines li:nth-child(2)').className === 'none',
      [indicator, fault[0]]));
      await until('it is not told', async () => new RegExp(`of 1:00\\.0, (.*, )?${fault[0]}`).test(await page.getAttribute('#position', 'aria-valuetext')));
    }
    await page.keyboard.press('n');
    await reads(page, '#fault-text', 'There is no other fault in this direction.');
    for (const i of [6, 5, 4, 3, 2, 1, 0]) {
      await page.keyboard.press('Shift+P');
      await reads(page, '#fault-text', told(expected[i], i));
    }
    await reads(page, '#fault-announcement[role="status"]', told(expected[0], 0));
  });

  await check('the more of a time is damaged, the higher it stands on the strip', async (page) => {
    const isBad = (i) => i === 1000 || (i >= 3000 && i < 3010) || (i >= 5000 && i < 5050);
    await play(page, 'damage.txt', Array.from({ length: 6000 }, (_, i) => recorded(10000 * (i + 1), frame([1000])).replace(/\n$/, isBad(i) ? '!\n' : '\n')).join(''));
    await decoded(page);
    const heights = await page.$eval('#strip .damage', (shape) => [...shape.getAttribute('d').matchAll(/M(\d+) 0h1v([\d.]+)/g)].map(([, bin, height]) => [Number(bin), Number(height)]));
    const highest = [10, 30, 50].map((second) => Math.max(...heights.filter(([bin]) => Math.abs((bin * 60) / 512 - second) < 1).map(([, height]) => height)));
    assert.ok(highest[0] > 0.5 && highest[1] > 1.2 * highest[0] && highest[2] >= highest[1] && highest[2] <= 3, `${highest}`);
  });

  await check('a fault beyond the decoded part is found', async (page) => {
    await play(page, 'late.txt', Array.from({ length: 400000 }, (_, i) => recorded(10000 * (i + 1), frame([1000], { flags: i === 399990 ? 8 : 0 }))).join(''));
    await page.click('#fault-next');
    await reads(page, '#fault-text', 'Fault 1 of 1: failsafe, 66:39.912 to 66:39.922.');
  });

  await check('the strip fills while the recording is decoded', async (page) => {
    const long = path.join(build, 'late.txt');
    await page.evaluate(() => {
      fake.seen = [];
      new MutationObserver(() => {
        const decoded = document.querySelector('#strip .decoded').getAttribute('width');
        const said = document.querySelector('#fault-counts li').textContent;
        if (fake.seen.at(-1)?.[0] !== Number(decoded)) fake.seen.push([Number(decoded), said]);
      }).observe(document.querySelector('#timeline'), { subtree: true, attributes: true });
    });
    await play(page, long);
    await decoded(page);
    const seen = await page.evaluate(() => fake.seen);
    assert.deepEqual(seen.map(([width]) => width), seen.map(([width]) => width).sort((a, b) => a - b));
    assert.equal(seen.at(-1)[0], 512);
    const [, [width, said]] = seen;
    assert.ok(seen.length > 2 && width > 0 && width < 512 && said === `${Math.floor((100 * width) / 512)} % decoded`, JSON.stringify(seen));
  });

  await check('the strip seeks where it is clicked, to where it is dragged, and by its keys', async (page) => {
    await playPaused(page, file);
    const box = await page.locator('.strip').boundingBox();
    const place = (part) => [box.x + part * box.width, box.y + box.height / 2];
    const stands = (part) => until(async () => `it is at ${await positionMs(page)} ms, not at ${60000 * part}`, async () => Math.abs((await positionMs(page)) - 60000 * part) < 300);
    await page.mouse.click(...place(0.4));
    await stands(0.4);
    await page.mouse.down();
    await page.mouse.move(...place(0.6));
    await page.mouse.move(...place(0.8), { steps: 5 });
    await page.mouse.up();
    await stands(0.8);
    await seek(page, 30000);
    await page.focus('#position');
    for (const [key, ms] of [['ArrowRight', 30600], ['ArrowLeft', 30000], ['ArrowDown', 29400], ['ArrowUp', 30000], ['Home', 0], ['End', 60004]]) {
      await page.keyboard.press(key);
      await until(async () => `${key}: ${await positionMs(page)} ms, not ${ms}`, async () => Math.abs((await positionMs(page)) - ms) <= 2);
    }
    await until('its text is not told', async () => (await page.getAttribute('#position', 'aria-valuetext')) === '1:00.0 of 1:00.0');
    await page.keyboard.press('p');
    await reads(page, '#fault-text', told(expected[7], 7));
  });

  await check('seeking and playing clear the text of the fault; N in the list of speeds is a letter', async (page) => {
    await playPaused(page, file);
    await seek(page, 0);
    await page.click('#fault-next');
    await reads(page, '#fault-text', told(expected[0], 0));
    await page.click('#play');
    await reads(page, '#fault-text', '');
    await page.click('#play');
    const before = await positionMs(page);
    await page.focus('#speed');
    await page.keyboard.press('n');
    await page.keyboard.press('Control+n');
    await page.waitForTimeout(300);
    assert.equal(await positionMs(page), before);
  });

  // Frames 10 ms apart, then this.
  for (const [what, last, expectedText] of [
    ['half a frame', '0F E8 03', 'no damaged bytes'],
    ['a frame whose flags are none', '0F E8 03 20 A8 01 08 16 50 03 10 80 00 04 20 00 01 08 40 00 02 10 80 10 00', 'damaged bytes: 1 ×'],
    ['a frame without its header', 'E8 03 20 A8 01 08 16 50 03 10 80 00 04 20 00 01 08 40 00 02 10 80 00 00', 'damaged bytes: 1 ×'],
    ['a parity error', '0F E8!', 'damaged bytes: 1 ×'],
  ]) {
    await check(`a recording that ends with ${what}: ${expectedText}`, async (page) => {
      await play(page, 'ends.txt', `${Array.from({ length: 20 }, (_, i) => recorded(10000 * (i + 1), frame([1000]))).join('')}210000 ${last}\n`);
      await decoded(page);
      assert.deepEqual(await page.$$eval('#fault-counts li', (items) => items.filter(({ hidden }) => !hidden).map(({ textContent }) => textContent)),
        expectedText.startsWith('no') ? ['whole recording: no faults'] : ['whole recording: 1 fault', expectedText]);
    });
  }

  await check('telemetry of S.BUS2 is no fault', async (page) => {
    // Slots 0 to 7: sbus2/Slots.h. Their data are headers, which no frame begins with.
    const slots = [0x03, 0x83, 0x43, 0xc3, 0x23, 0xa3, 0x63, 0xe3].flatMap((id) => [id, 0x0f, 0x0f]);
    const healthy = Array.from({ length: 200 }, (_, i) => recorded(15000 * (i + 1), frame([1000], { end: 0x04 })) + recorded(15000 * (i + 1) + 5000, slots)).join('');
    await play(page, 'telemetry.txt', healthy);
    await reads(page, '#fault-counts li', 'whole recording: no faults');
  });
}
