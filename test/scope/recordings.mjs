// Page, host and sketches agree on every recording; what is wrong with a bad one is said in the same words.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { check, counts, downloaded, play, raw, reads, root, toEnd } from './support.mjs';

const recordings = path.join(root, 'test/recordings');
const golden = path.join(root, 'test/golden');
const host = process.env.SCOPE_FRAMES; // Frames.cpp

const rows = (csv) => csv.trim().split('\n').slice(1);
const withoutTime = (row) => row.slice(row.indexOf(',') + 1);
const channels = (row) => row.split(',').slice(1, 19).join(',');

export default async function () {
  for (const name of ['paper', 'frsky-neutral', 'sbus2', 'slow/25-hz']) {
    await check(`${name}.txt: the page has the frames that the host has, and those that AllChannels prints`, async (page) => {
      const file = path.join(recordings, `${name}.txt`);
      await play(page, file);
      await toEnd(page);
      const { text } = await downloaded(page, '#csv');
      const frames = rows(text);
      assert.equal(text.split('\n')[0], execFileSync(host, [file], { encoding: 'utf8' }).split('\n')[0]);
      assert.deepEqual(frames.map(withoutTime), rows(execFileSync(host, [file], { encoding: 'utf8' })).map(withoutTime));
      assert.ok(frames.length > 0);
      await counts(page, 'frames', frames.length);
      const printed = path.join(golden, `AllChannels-${name}.csv`);
      let at = 0;
      for (const row of existsSync(printed) ? readFileSync(printed, 'utf8').trim().split(/\r?\n/) : []) {
        while (at < frames.length && channels(frames[at]) !== row) at++;
        assert.ok(at < frames.length, `the sketch has printed ${row}`);
      }
    });
  }

  for (const message of readFileSync(path.join(recordings, 'bad/MESSAGES'), 'utf8').trim().split('\n')) {
    const name = message.split(':')[0];
    if (!existsSync(path.join(recordings, 'bad', name))) {
      continue;
    }
    await check(`bad/${name}: what is wrong, and where, in the words of the host`, async (page) => {
      await page.setInputFiles('#file', path.join(recordings, 'bad', name));
      await reads(page, '#verdict-text', /^THIS IS NO RECORDING/);
      const said = await page.textContent('#verdict-text');
      const [, line, words] = /^[^:]+(?::(\d+))?: (.*)$/.exec(message);
      assert.ok(said.includes(`${name}: ${line ? `line ${line}: ` : ''}${words}`), `${said}\n${message}`);
      await reads(page, '#state', 'Fine');  // the simulation goes on
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

  await check('time line: to any place and back, at another speed, again and again', async (page) => {
    await play(page, path.join(recordings, 'sbus2.txt'));
    await toEnd(page);
    const all = 14;
    await counts(page, 'frames', all);
    const seek = (ms) => page.evaluate((to) => {
      const position = document.querySelector('#position');
      position.value = to;
      position.dispatchEvent(new Event('input'));
    }, ms);
    await seek(300);
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
}
