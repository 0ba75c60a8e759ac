// Bookmarks: set, listed, jumped to, renamed, removed; on the strip and on the curves; kept with the recording.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { clean, fits } from './looks.mjs';
import path from 'node:path';
import { build, check, counter, downloaded, drawn, play, playRamp, ramp, reads, seek, toEnd, until } from './support.mjs';

const sbus = process.env.SCOPE_SBUS;
const list = (page) => page.$$eval('#bookmarks-list li', (rows) => rows.map((row) => `${row.firstChild.textContent} ${row.children[1].value}`));
const lists = (page, expected) => until(async () => `${await list(page)}, not ${expected}`, async () => String(await list(page)) === String(expected));
const rename = async (page, from, to) => {
  const find = () => page.$$eval('#bookmarks-list input', (all, name) => all.findIndex(({ value }) => value === name), from);
  await until(`there is no ${from}`, async () => (await find()) >= 0);
  const at = await find();
  const input = page.locator('#bookmarks-list input').nth(at);
  await input.fill(to);
  await input.press('Enter');
};
// Answers the question that comes with the next act. `asked` has the questions.
const answers = (page, act, isYes) => {
  const asked = [];
  page.once('dialog', (dialog) => {
    asked.push(dialog.message());
    void (isYes ? dialog.accept() : dialog.dismiss());
  });
  return act().then(() => asked);
};
const asksBeforeUnload = (page) => page.evaluate(() => !dispatchEvent(new Event('beforeunload', { cancelable: true })));
const commentsIn = (text) => text.split('\n').filter((line) => line.startsWith('# bookmark'));

// The colour of the curves' canvas at a time, in a row of pixels at which a bookmark has a dash.
const inkAt = (page, ms) => page.evaluate((at) => {
  const canvas = document.querySelector('#plot canvas');
  const over = document.querySelector('#plot .u-over').getBoundingClientRect();
  const place = canvas.getBoundingClientRect();
  const seconds = parseFloat(document.querySelector('#window').textContent);
  const right = Number(document.querySelector('#position').value) / 1000;
  const x = Math.round(over.left - place.left + over.width * (1 - (right - at / 1000) / seconds));
  const copy = Object.assign(document.createElement('canvas'), { width: 3, height: canvas.height }).getContext('2d', { willReadFrequently: true });
  copy.drawImage(canvas, 1 - x, 0);
  const { data } = copy.getImageData(0, 0, 3, canvas.height);
  let dark = 0;
  for (let i = 0; i < data.length; i += 4) dark += data[i + 3] > 200 && data[i] + data[i + 1] + data[i + 2] < 150;
  return dark;
}, ms);

export default async function () {
  await check('bookmarks are set by a button and by B, named, jumped to and removed; the strip and the curves show them', async (page) => {
    await playRamp(page);
    assert.ok(await page.locator('#bookmarks').isHidden());
    await seek(page, 3000);
    await reads(page, '#position-text', /^0:03\.0/);
    await page.click('#bookmark');
    await seek(page, 1500);
    await reads(page, '#position-text', /^0:01\.5/);
    await page.focus('#position');
    await page.keyboard.press('b');
    await lists(page, ['0:01.500 Bookmark 2', '0:03.000 Bookmark 1']);
    await reads(page, '#bookmark-announcement', 'Bookmark 2 at 0:01.500');
    await rename(page, 'Bookmark 2', '  take <off> ');
    await lists(page, ['0:01.500 take <off>', '0:03.000 Bookmark 1']);
    assert.equal(await page.getAttribute('#bookmarks-list input', 'title'), 'take <off>'); // all of a long one
    const strip = () => page.getAttribute('#strip .bookmark', 'd');
    const places = [...(await strip()).matchAll(/M([\d.]+)/g)].map(([, x]) => (Number(x) * ramp.lengthS) / 512);
    assert.ok(Math.abs(places[0] - 1.5) < 0.01 && Math.abs(places[1] - 3) < 0.01, String(places));
    await page.click('#bookmarks-list li:nth-child(2) button');
    await reads(page, '#position-text', /^0:03\.0/);
    assert.equal(await page.textContent('#play'), 'Play');
    await drawn(page);
    await until('the curves show it', async () => (await inkAt(page, 1500)) > 40);
    assert.ok((await inkAt(page, 1900)) < 20);
    await page.click('#bookmarks-list li:nth-child(1) [title="Remove"]');
    await lists(page, ['0:03.000 Bookmark 1']);
    assert.equal((await strip()).match(/M/g).length, 1);
    await until('the curves show it no more', async () => (await inkAt(page, 1500)) < 20);
  });

  await check('a line has bookmarks as well: B on its curves, and a jump shows the time in the middle', async (page) => {
    await until('no frames come', async () => (await counter(page, 'frames')) > 150);
    await page.focus('#plot');
    await page.keyboard.press('B');
    await until('it is listed', async () => (await list(page)).length === 1);
    const [row] = await list(page);
    const at = Number(row.match(/^0:([\d.]+)/)[1]);
    await page.waitForTimeout(1500);
    await page.click('#zoom-in'); await page.click('#zoom-in'); await page.click('#zoom-in');
    await reads(page, '#window', '1 s');
    await page.click('#bookmarks-list button');
    await reads(page, '#pause', 'Continue');
    await drawn(page);
    const over = await page.locator('#plot .u-over').boundingBox();
    await page.mouse.move(over.x + over.width / 2, over.y + 20);
    await drawn(page);
    const shown = parseFloat(await page.textContent('#readout'));
    assert.ok(Math.abs(shown - at) < 0.03, `${shown}, not ${at}`);
    assert.ok(await asksBeforeUnload(page));
    const question = 'A bookmark is not saved, and will be lost. Go on?';
    assert.deepEqual(await answers(page, () => page.selectOption('#receiver', '24'), false), [question]);
    assert.equal(await page.inputValue('#receiver'), '16');
    assert.equal((await list(page)).length, 1);
    assert.deepEqual(await answers(page, () => page.click('#source-simulated'), true), [question]);
    await until('another line has none', async () => (await list(page)).length === 0);
    assert.ok(!(await asksBeforeUnload(page)));
  });

  await check('a recording that the page saves keeps its bookmarks, its readers skip them, and the page shows them again', async (page) => {
    await until('no frames come', async () => (await counter(page, 'frames')) > 50);
    await page.click('#bookmark'); // before the recording
    await page.click('#record');
    const from = await counter(page, 'frames');
    await until('no frames come', async () => (await counter(page, 'frames')) > from + 80);
    await page.click('#bookmark');
    await rename(page, 'Bookmark 2', 'the stall');
    await until('no frames come', async () => (await counter(page, 'frames')) > from + 120);
    const last = Number((await list(page))[1].match(/^0:([\d.]+)/)[1]);
    const { text, path: file } = await downloaded(page, '#record');
    const [head, mark, ...others] = commentsIn(text);
    assert.equal(head, '# bookmarks');
    assert.match(mark, /^# bookmark \d+ the stall$/);
    assert.deepEqual(others, []);
    const us = Number(mark.split(' ')[2]);
    const times = text.split('\n').filter((line) => /^\d/.test(line)).map((line) => Number(line.split(/[ ~]/)[0]));
    assert.ok(us > times[40] && us < times.at(-1) && us / 1e6 < last, `${us}`);
    const without = text.split('\n').filter((line) => !line.startsWith('# bookmark')).join('\n');
    const csv = (input) => execFileSync(sbus, ['csv', '-'], { input, encoding: 'utf8' });
    assert.equal(csv(text), csv(without));
    assert.deepEqual(await answers(page, () => play(page, file), true), ['A bookmark is not saved, and will be lost. Go on?']); // that before it
    const clock = `0:0${(Math.floor(us / 1000) / 1000).toFixed(3)}`;
    await lists(page, [`${clock} the stall`]);
    await page.click('#play');
    await page.click('#bookmarks-list button');
    await reads(page, '#position-text', new RegExp(`^0:0${Math.floor(us / 1e5) / 10}`));
  });

  await check('a recording is saved with the bookmarks that it has now: renamed ones once, removed ones not', async (page) => {
    await playRamp(page);
    await page.click('#bookmark');
    await rename(page, 'Bookmark 1', 'end');
    await lists(page, ['0:04.003 end']);
    await seek(page, 2000);
    await page.click('#bookmark');
    await lists(page, ['0:02.000 Bookmark 2', '0:04.003 end']);
    await fits(page);
    await clean(page);
    const first = await downloaded(page, '#bookmarks-save');
    assert.equal(first.name, 'ramp.txt');
    assert.deepEqual(commentsIn(first.text), ['# bookmarks', '# bookmark 2000000 Bookmark 2', '# bookmark 4003880 end']);
    await play(page, first.path);
    await lists(page, ['0:02.000 Bookmark 2', '0:04.003 end']);
    await page.click('#bookmarks-list li:nth-child(2) [title="Remove"]');
    await rename(page, 'Bookmark 2', 'two');
    await lists(page, ['0:02.000 two']);
    const second = await downloaded(page, '#bookmarks-save');
    assert.deepEqual(commentsIn(second.text), ['# bookmarks', '# bookmark 2000000 two']);
    await play(page, second.path);
    await lists(page, ['0:02.000 two']);
    await page.click('#bookmarks-list li:nth-child(1) [title="Remove"]');
    const third = await downloaded(page, '#bookmarks-save');
    await play(page, third.path);
    await lists(page, []);
    assert.equal(third.text, readFileSync(path.join(build, 'ramp.txt'), 'utf8'));
  }, { size: { width: 360, height: 740 }, colorScheme: 'dark' });

  await check('a recording that was changed on the disk cannot be saved: that is said, and its bookmarks stay', async (page) => {
    await playRamp(page);
    await page.click('#bookmark');
    await lists(page, ['0:04.003 Bookmark 1']);
    writeFileSync(path.join(build, 'ramp.txt'), '# another\n');
    await page.click('#bookmarks-save');
    await reads(page, '#notice-text', 'ramp.txt is not saved: the file has changed since it was opened, or is gone.');
    await lists(page, ['0:04.003 Bookmark 1']);
    assert.ok(await asksBeforeUnload(page));
  });

  await check('of 10000 bookmarks only those that the curves show cost time', async (page) => {
    await playRamp(page);
    const marks = Array.from({ length: 10000 }, (_, i) => `# bookmark ${i < 9990 ? 9e8 + i : 300 * i} mark ${i}\n`);
    await play(page, 'many.txt', `${readFileSync(path.join(build, 'ramp.txt'), 'utf8')}${marks.join('')}`);
    await until('they are listed', async () => (await page.locator('#bookmarks-list li').count()) === 10000);
    assert.equal(await page.locator('#bookmarks-list > *').count(), 100); // lists: those out of sight are not laid out
    assert.ok((await page.getAttribute('#strip .bookmark', 'd')).split('M').length < 1100, 'the strip has more marks than pixels');
    await page.evaluate(() => {
      const measure = CanvasRenderingContext2D.prototype.measureText;
      fake.measured = 0;
      CanvasRenderingContext2D.prototype.measureText = function (text) {
        fake.measured += Number(text.startsWith('mark '));
        return measure.call(this, text);
      };
    });
    await toEnd(page);
    await until('they are not drawn', () => page.evaluate(() => fake.measured > 0));
    await drawn(page);
    assert.ok((await page.evaluate(() => fake.measured)) < 5000, 'all are drawn');
  });
}
