// Page, host and sketches agree on every recording, and have the same message for each bad one.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { random } from './modules.mjs';
import { Native } from './native.mjs';
import { build, check, counter, counts, downloaded, frame, play, playToEnd, raw, reads, recorded, root, seek, toEnd, until } from './support.mjs';

const recordings = path.join(root, 'test/recordings');

const rows = (csv) => csv.trim().split('\n').slice(1);
const channels = (row) => row.split(',').slice(1, 19).join(',');

export default async function () {
  for (const name of ['paper', 'frsky-neutral', 'sbus2', 'slow/25-hz']) {
    await check(`${name}.txt: the page has the frames that the host has, and those that AllChannels prints`, async (page) => {
      const file = path.join(recordings, `${name}.txt`);
      await playToEnd(page, file);
      const { text } = await downloaded(page, '#csv');
      const frames = rows(text);
      const columns = 'time,ch1-ch18,failsafe,lostframe';
      const printed = execFileSync(process.env.SCOPE_SBUS, ['csv', '--every-frame', '--header', '--columns', columns, file], { encoding: 'utf8' });
      assert.deepEqual([text.split('\n')[0], ...frames], printed.trim().split('\n'));
      assert.ok(frames.length > 0);
      await counts(page, 'frames', frames.length);
      const golden = path.join(root, 'test/golden', `AllChannels-${name}.csv`);
      let at = 0;
      for (const row of existsSync(golden) ? readFileSync(golden, 'utf8').trim().split(/\r?\n/) : []) {
        while (at < frames.length && channels(frames[at]) !== row) at++;
        assert.ok(at < frames.length, `the sketch has printed ${row}`);
      }
    });
  }

  const table = readFileSync(path.join(root, 'test/tool/RECORDINGS'), 'utf8').trim().split('\n').slice(1);
  await check('each bad recording is rejected with the message of the command, and where; the simulation continues', async (page) => {
    for (const [number, row] of table.entries()) {
      const [, text, line, words] = /^(.*?)\|(?:(\d+):)? (.*)$/.exec(row);
      if (text.startsWith('PK')) continue; // the page unpacks a ZIP itself: captures.mjs
      const name = `bad-${number}.txt`;
      await page.setInputFiles('#file', { name, mimeType: 'text/plain', buffer: Buffer.from(text.replaceAll('\\n', '\n')) });
      const said = () => page.textContent('#notice-text');
      await until(async () => `${await said()}\n${row}`, async () => (await said()).startsWith(line ? `In line ${line} of ${name}, ${words}` : `${name}${/^(is|has|ends|cannot) /.test(words) ? '' : ':'} ${words}`));
      await reads(page, '#state', 'Fine');
    }
  });

  await check('a byte order mark before a recording is no error', async (page) => {
    const text = readFileSync(path.join(recordings, 'paper.txt'), 'utf8');
    await playToEnd(page, 'mark.txt', `\ufeff${text}`);
    await counts(page, 'frames', 6);
  });

  await check('a file that is cut anywhere after its first line opens: all whole lines and bytes are there, and what is left out is said', async () => {
    const lines = [1, 2, 3].map((i) => recorded(9000 * i, frame([1000 + i])).replace(' ', '~3000 '));
    const table = [1, 2, 3].map((i) => `${(0.009 * i).toFixed(6)},${Array.from({ length: 16 }, (_, channel) => 900 + i + channel)}\n`);
    const json = [1, 2, 3].map((i) => `${JSON.stringify({ type: 'frame', time_us: 9000 * i, channels: Array(16).fill(1000 + i) })}\n`);
    const header = `time,${Array.from({ length: 16 }, (_, i) => `CH${i + 1}`)}\n`;
    for (const [head, all] of [['# 100000 baud, 8E2, inverted\n', lines], [header, table], ['', json]]) {
      const text = head + all.join('');
      for (let end = head.length + all[0].length + (head === header ? all[1].length : 0); end <= text.length; end++) {
        const page = await new Native().load();
        page.open(text.slice(0, end));
        page.advance(100000);
        const whole = text.slice(head.length, end).split('\n').length - 1;
        const part = text.slice(head.length, end).split('\n').at(-1);
        const isFrame = head.startsWith('#') && part.split(' ').length === 26 && /\w\w$/.test(part);
        const frames = page.status(100000, 'frames');
        const isJsonWhole = head === '' && part.endsWith('}');
        assert.equal(frames, whole + Number(isFrame || isJsonWhole), part);
        const isHalf = part !== '' && !isJsonWhole && (!head.startsWith('#') || !/^\d+~\d+( \w\w)+ ?$/.test(part));
        assert.equal(/cut off/.test(page.words(page.wasm.fileNote())), isHalf, part);
      }
    }
  });

  await check('after 12 to 80 bytes of junk, without times 12 or 20, the last frame is found, as sbus summary finds it', async (page) => {
    const next = random(67);
    let found = 0;
    const junk = (count) => Array.from({ length: count }, () => Math.floor(256 * next()));
    for (let count = 12; count <= 80; count += 8) {
      const bytes = [...junk(count).with(Math.floor(count * next()), 0x0f), ...frame([1000])]; // half a frame may begin there
      const text = recorded(10000, bytes);
      for (const [name, content] of [['time.txt', text], ['notime.txt', text.replace(/^\d+ /, '')], ['late.txt', text.replace(' ', '~18000 ')]]) {
        if (name === 'notime.txt' && count > 20) continue; // half of the bytes in one frame are a line
        await playToEnd(page, name, content);
        const { stdout } = spawnSync(process.env.SCOPE_SBUS, ['summary', '--json', path.join(build, name)], { encoding: 'utf8' });
        const frames = Number(/"frames":(\d+)/.exec(stdout)?.[1] ?? 0);
        await until(`${count} bytes of junk, ${name}: not ${frames}`, async () => (await counter(page, 'frames')) === frames);
        found += frames;
      }
    }
    assert.ok(found > 15, `${found} frames`);
  });

  await check('bytes without times have no length, no rate and no intervals, and their failsafe no duration', async (page) => {
    const flags = (i) => (i >= 90 && i < 130 ? 12 : 0);
    await playToEnd(page, 'notime.txt', Array.from({ length: 240 }, (_, i) => recorded(0, frame([992 + i], { flags: flags(i) })).slice(2)).join(''));
    await reads(page, '#whole-text', 'Failsafe 1 time; 16.67 % of the frames lost.');
    await reads(page, '#report-facts', 'Times are not known: 240 frames; 40 with the lost-frame flag, 40 in failsafe; 0 discarded bytes, 0 character errors.');
    assert.equal(await page.$eval('#report', (card) => / s\b|a second/.test(card.innerText)), false);
    for (const where of ['#rate', '#gap']) await reads(page, where, '–');
  });

  await check('what is left out of a file that is cut off stands beside its name', async (page) => {
    const text = readFileSync(path.join(recordings, 'paper.txt'), 'utf8');
    await page.setInputFiles('#file', { name: 'cut.txt', mimeType: 'text/plain', buffer: Buffer.from(`${text}40`) });
    await reads(page, '#title', 'Recording cut.txt, cut off within its last line: what was not whole is left out');
    await toEnd(page);
    await counts(page, 'frames', 6);
  });

  await check('a recording that says when it began has date and time beside its name', async (page) => {
    await play(page, 'began.txt', `# format 1, began 2026-11-24T15:16:18.000000Z\n${recorded(9000, frame([1000]))}`);
    const local = await page.evaluate(() => new Date('2026-11-24T15:16:18.000000Z').toLocaleString());
    await reads(page, '#title', `Recording began.txt, of ${local}`);
  });

  for (const [end, shown] of [
    ['0F E3 03 1F', /^0F E3 03 1F$/],
    ['55!', /^55$/],
  ]) {
    await check(`the last bytes of a recording are shown: ${end}`, async (page) => {
      const text = readFileSync(path.join(recordings, 'paper.txt'), 'utf8');
      await playToEnd(page, 'cut.txt', `${text}400000 ${end}`);
      await reads(page, '#lines li:first-child.none code', shown);
      await counts(page, 'frames', 6);
    });
  }

  await check('a recording dropped onto the page is played', async (page) => {
    const text = readFileSync(path.join(recordings, 'paper.txt'), 'utf8');
    await page.evaluate((content) => {
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([content], 'paper.txt'));
      dispatchEvent(new DragEvent('drop', { dataTransfer, cancelable: true }));
    }, text);
    await reads(page, '#title', 'Recording paper.txt');
    await raw(page, 3, '1811');
  });

  await check('of two files that are dropped the first is played, and the page says so', async (page) => {
    await page.evaluate((content) => {
      const dataTransfer = new DataTransfer();
      for (const name of ['one.txt', 'other.txt']) dataTransfer.items.add(new File([content], name));
      dispatchEvent(new DragEvent('drop', { dataTransfer, cancelable: true }));
    }, recorded(9000, frame([1000])));
    await reads(page, '#title', 'Recording one.txt');
    await reads(page, '#notice-text', 'Only one.txt is played.');
  });

  await check('a recording of one byte at its time 0 is shown', async (page) => {
    await playToEnd(page, 'byte.txt', '0 55\n');
    await reads(page, '#fault-counts li:first-child', 'whole recording: no faults');
    await reads(page, '#position-text', '0:00.0 / 0:00.0');
  });

  await check('the time line goes to any place and back, at another speed, and repeats', async (page) => {
    await playToEnd(page, path.join(recordings, 'sbus2.txt'));
    const all = 14;
    await counts(page, 'frames', all);
    await seek(page, 300);
    await reads(page, '#position-text', /^0:00\.3 /);
    await reads(page, '[data-counter="frames"]', new RegExp(`^(?!${all}$)[1-9]`));
    await page.selectOption('#speed', '10');
    await page.click('#play');
    await reads(page, '#play', 'Play');
    await counts(page, 'frames', all);
    await page.check('#loop');
    await page.click('#play');
    await reads(page, '#play', 'Pause');
    await reads(page, '[data-counter="frames"]', new RegExp(`^(?!${all}$)`));
  });
  const drop = (page, name, content, size) =>
    page.evaluate(([called, text, bytes]) => {
      const file = new File([text], called);
      if (bytes) Object.defineProperty(file, 'size', { value: bytes });
      const dataTransfer = { files: [file] };
      dispatchEvent(Object.assign(new Event('drop', { cancelable: true }), { dataTransfer }));
    }, [name, content, size]);

  await check('dragged text raises no curtain, a file does; a folder is said', async (page) => {
    const drag = (type) => page.evaluate((kind) => {
      const dataTransfer = new DataTransfer();
      if (kind === 'text') dataTransfer.setData('text/plain', 'hello');
      else dataTransfer.items.add(new File(['x'], 'x.txt'));
      const event = new DragEvent('dragover', { dataTransfer, cancelable: true });
      dispatchEvent(event);
      dispatchEvent(new DragEvent('dragleave', { dataTransfer, relatedTarget: document.querySelector('main') }));
      return [event.defaultPrevented, document.querySelector('#drop').hidden];
    }, type);
    assert.deepEqual(await drag('text'), [false, true]);
    assert.deepEqual(await drag('file'), [true, false]);
    await page.evaluate(() => dispatchEvent(Object.assign(new Event('drop', { cancelable: true }), {
      dataTransfer: { files: [new File([''], 'flights')], items: [{ webkitGetAsEntry: () => ({ isDirectory: true, createReader: () => ({ readEntries: (take) => take([]) }) }) }] },
    })));
    await reads(page, '#notice-text', 'flights is a folder.');
    assert.ok(await page.locator('#drop').isHidden());
  });

  await check('a folder with one file, beside hidden ones, plays it', async (page) => {
    await page.evaluate((text) => {
      const entry = (name) => ({ name, isFile: true, file: (take) => take(new File([text], name)) });
      const folder = { isDirectory: true, createReader: () => ({ readEntries: (take) => take([entry('.DS_Store'), entry('flight.txt')]) }) };
      dispatchEvent(Object.assign(new Event('drop', { cancelable: true }), { dataTransfer: { files: [new File([''], 'flights')], items: [{ webkitGetAsEntry: () => folder }] } }));
    }, recorded(9000, frame([1000])));
    await reads(page, '#title', 'Recording flight.txt');
  });

  for (const [name, content, said, remedy] of [
    ['picture.png', '\u0089PNG\r\n\u001a\n\0\0\0\rIHDR', /^picture\.png is a picture, a document or a program/, /^The page plays recordings .* captures of the wire/],
    ['nothing.txt', '', /^nothing\.txt is empty/, /^$/],
  ]) {
    await check(`${name} is rejected with the reason, and what can be played only where that helps`, async (page) => {
      await drop(page, name, content);
      await reads(page, '#notice-text', said);
      await reads(page, '#notice-remedy', remedy);
      await reads(page, '#state', 'Fine');
    });
  }

  await check('a file that is too large for the memory is rejected; the notice says which command reads it', async (page) => {
    await drop(page, 'year.txt', '120 0F\n', 9e9);
    await reads(page, '#notice-text', /^year\.txt is larger than 2 GB: sbus summary/);
  });
}
