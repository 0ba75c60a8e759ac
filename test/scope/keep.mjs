// What the user saves.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { build, bytesOf, check, codes, connect, counter, counts, downloaded, drawn, frame, opensWith, playToEnd, raw, recorded, root, until } from './support.mjs';

const bytesIn = (text) => text.split('\n').filter((line) => /^\d/.test(line)).flatMap((line) => line.split(' ').slice(1));

export default async function () {
  await check('a recording of a port has every byte since Record was pressed, also damaged ones, and plays again as it was', async (page) => {
    await opensWith(page, [frame([7]), frame([7]), 0x0f, 0x11]);
    await connect(page);
    await counts(page, 'frames', 2);
    const sent = [...bytesOf('sbus2.txt'), ...frame([1, 2, 3]).slice(0, 9), ...bytesOf('paper.txt'), ...frame([5]), ...frame([6])];
    await page.click('#record');
    for (let i = 0; i < sent.length; i += 31) {
      await page.evaluate((part) => fake.port.feed(part), sent.slice(i, i + 31));
    }
    await raw(page, 1, '6');
    const { text: csv } = await downloaded(page, '#csv');
    const { name, text, path: file } = await downloaded(page, '#record');
    assert.match(name, /^sbus-\d{8}-\d{6}\.txt$/);
    assert.deepEqual(bytesIn(text), sent.map((byte) => byte.toString(16).toUpperCase().padStart(2, '0')));
    await playToEnd(page, file);
    const values = (of) => of.trim().split('\n').slice(1).map((line) => line.slice(line.indexOf(','))).filter((line) => !line.startsWith(',7,'));
    const again = values((await downloaded(page, '#csv')).text);
    let at = 0;
    for (const row of values(csv)) {
      at = again.indexOf(row, at) + 1;
      assert.ok(at > 0, row);  // its times tell more than the port did: there may be one frame more
    }
    assert.ok(again.length >= 12);
  });

  await check('a recording of the simulation has what the simulation showed, with times that count from when Record was pressed', async (page) => {
    await until('no frames come', async () => (await counter(page, 'frames')) > 100);
    await page.click('#record');
    await drawn(page);
    const from = await counter(page, 'frames');
    await until('no frames come', async () => (await counter(page, 'frames')) > from + 200);
    const { path: recording, text } = await downloaded(page, '#record');
    assert.match(text, /^# Simulated FrSky R-XSR/);
    assert.match(text, /\n# 100000 baud, 8E2, inverted\n/);
    const [first] = text.split('\n').filter((line) => /^\d/.test(line));
    assert.ok(Number(first.split(' ')[0]) <= 9000, first); // us: a frame comes every 9 ms
    const rows = (csv) => csv.trim().split('\n').slice(1).map((row) => row.split(','));
    await drawn(page); // what was recorded up to the click
    const before = rows((await downloaded(page, '#csv')).text);
    await playToEnd(page, recording);
    const after = rows((await downloaded(page, '#csv')).text).slice(1, -1);
    assert.ok(after.length > 140, `${after.length}`);
    const values = (row) => String(row.slice(1));
    const begin = before.findIndex((row, i) => values(row) === values(after[0]) && values(before[i + 1] ?? []) === values(after[1]));
    assert.ok(begin > 0, String(after[0]));
    const shown = before.slice(begin, begin + after.length);
    assert.deepEqual(after.map(values), shown.map(values));
    const us = (row) => Math.round(row[0] * 1e6);
    assert.deepEqual(after.map((row) => us(row) - us(after[0])), shown.map((row) => us(row) - us(shown[0])));
  });

  for (const [name, channels, text] of [
    ['16 channels', 'ch1-ch16', [1, 2, 3, 4, 5].map((i) => recorded(9000 * i, frame([1000 + i, 2047, 0], { flags: 3 * i }))).join('')],
    ['16 channels, a header of which has become 2F', 'ch1-ch18', [1, 2, 3, 4, 5, 6].map((i) => recorded(9000 * i, frame([1000 + i], { header: i === 3 ? 0x2f : 0x0f }))).join('')],
    ['32 channels', 'ch1-ch32', [1, 2, 3, 4, 5].map((i) => recorded(18000 * i, frame([1500 + i], { header: 0x2f })) + recorded(18000 * i + 9000, frame([1000 + i]))).join('')],
  ]) {
    await check(`the CSV that the page saves of ${name}, and that sbus csv --header prints, are the same frames to sbus and to the page`, async (page) => {
      const sbus = (...options) => execFileSync(process.env.SCOPE_SBUS, options, { encoding: 'utf8' });
      const columns = `time,${channels},failsafe,lostframe`;
      const [file, saved, printed] = ['frames.txt', 'saved.csv', 'printed.csv'].map((each) => path.join(build, each));
      writeFileSync(file, text);
      await playToEnd(page, file);
      const { name: savedAs, text: csv } = await downloaded(page, '#csv');
      assert.match(savedAs, /^sbus-\d{8}-\d{6}-0m00s-0m00s\.csv$/);
      writeFileSync(saved, csv);
      writeFileSync(printed, sbus('csv', '--every-frame', '--header', '--columns', columns, file));
      const told = sbus('csv', '--every-frame', '--columns', columns, file);
      assert.equal(told.trim().split('\n').length, 5);
      for (const each of [saved, printed]) {
        assert.match(sbus('summary', each), /, 5 frames, /);
        assert.equal(sbus('csv', '--every-frame', '--columns', columns.slice(5), each), told.replace(/^[^,]*,/gm, ''));
        await playToEnd(page, each);
        const { text: again } = await downloaded(page, '#csv');
        const values = (rows) => rows.replace(/^[^,]*,/gm, '');
        if (each === saved) assert.equal(values(again), values(csv));
        await counts(page, 'frames', 5);
      }
    });
  }

  await check("a board's CSV has the numbers as they were printed", async (page) => {
    await connect(page, 'board');
    await page.click('#record');
    const rows = ['0.732,0.469,-0.599,-0.043', '0.675,0.369,-0.426,-0.143', '0.5,0.25,-1,0'];
    await page.evaluate((letters) => fake.port.feed(letters), codes(`${rows[0]}\r\n${rows.join('\r\n')}\r\n`));
    await counts(page, 'rows', 3);
    const { text } = await downloaded(page, '#csv');
    const [header, ...lines] = text.trim().split('\n');
    assert.equal(header, 'time,CH1,CH2,CH3,CH4,CH17,CH18,failsafe,lostframe');
    assert.deepEqual(lines.map((line) => line.split(',').slice(1, 5).join(',')), rows);
    const { path: recording } = await downloaded(page, '#record');
    await playToEnd(page, recording);
    await counts(page, 'rows', 3);
  });

  // `sbus monitor` and `sbus summary` read the same file: test/tool.
  await check("a recording of a board's port has the port's settings, and plays again; so do rows that sbus has recorded, without the last if the file may be cut within it", async (page) => {
    const rows = readFileSync(path.join(root, 'test/golden/AllChannels.csv'), 'utf8').trim().split('\r\n').slice(0, 3);
    const kept = readFileSync(path.join(root, 'test/recordings/board/rows.txt'), 'utf8').trim().split('\n');
    await connect(page, 'board');
    await page.click('#record');
    for (const row of rows) {
      await page.evaluate((letters) => fake.port.feed(letters), codes(`${row}\r\n`));
      await page.evaluate(() => fake.skip(200));
    }
    await counts(page, 'rows', rows.length - 1);
    const { text, path: recording } = await downloaded(page, '#record');
    const withoutTimes = (lines) => lines.map((line) => line.replace(/^# \d{4}-.*|^\d+(~\d+)?/, ''));
    assert.deepEqual(withoutTimes(text.trim().split('\n')), withoutTimes(kept));
    const rowsOfCsv = path.join(build, 'rows.csv');
    writeFileSync(rowsOfCsv, `# sbus record /dev/ttyACM0: rows of CSV as the sketch printed them, not S.Bus\n${rows.join('\r\n')}\r\n${rows[0]}`);
    for (const file of [recording, path.join(root, 'test/recordings/board/rows.txt'), rowsOfCsv]) {
      await playToEnd(page, file);
      await counts(page, 'rows', rows.length - 1);
      const { text: csv } = await downloaded(page, '#csv');
      assert.deepEqual(csv.trim().split('\n').slice(1).map((line) => line.split(',').slice(1, 19).join(',')), rows.slice(1)); // the first is not known for one yet
    }
  });

  // Returns 'held' or 'released' for each wake lock that the page ever had.
  const locks = (page) => page.evaluate(() => String(fake.locks.map(({ released }) => (released ? 'released' : 'held'))));
  const lockedAs = (page, expected) => until(async () => `${await locks(page)}, not ${expected}`, async () => (await locks(page)) === expected);

  await check('the PC stays awake while it records, also after the page was hidden, and no longer', async (page) => {
    await until('no frames come', async () => (await counter(page, 'frames')) > 10);
    await page.evaluate(() => fake.show(false));
    await page.evaluate(() => fake.show(true));
    await page.click('#record');
    await lockedAs(page, 'held');
    await page.evaluate(() => fake.show(false));
    await lockedAs(page, 'released');
    await page.evaluate(() => {
      fake.show(true);
      fake.show(false); // before it has a lock
      fake.show(true);
    });
    await lockedAs(page, 'released,held');
    await page.click('#record');
    await lockedAs(page, 'released,released');
    await page.click('#record');
    await page.click('#record'); // perhaps before it has a lock
    await until('it is held', async () => /^released,released(,released)?$/.test(await locks(page)));
    await page.evaluate(() => fake.show(true));
    await page.click('#record');
    await until('it is not held', async () => /^[^h]*,held$/.test(await locks(page)));
    await page.click('#source-simulated'); // which ends the recording
    await until('it is held', async () => !(await locks(page)).includes('held'));
  });

  await check('another source ends a recording: the file is handed over, not lost', async (page) => {
    await page.click('#record');
    await page.waitForTimeout(300);
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#source-adapter')]);
    assert.ok(bytesIn(readFileSync(await download.path(), 'utf8')).length >= 25);
    await page.waitForSelector('#record[aria-pressed="false"]');
  });
}
