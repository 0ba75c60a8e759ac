// Two recordings side by side: the numbers are those of sbus compare, and B's curves are at the same moments as A's. And two
// ports.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import path from 'node:path';
import { clean, fits } from './looks.mjs';
import { build, check, drawn, frame, inWorkers, play, playPaused, reads, recorded, seek, until } from './support.mjs';

const count = 6000; // frames of A, each 9 ms
const earlierUs = 3000000; // B began that much later, and counts from there
const delayUs = 12340;
const drift = 20e-6;
const ch1 = (i) => 1000 + Math.round(600 * Math.sin(i / 40)) + (i % 7);
const values = (i) => [ch1(i), 300 + (i % 1300), 992];
const aUs = (i) => 9000 * (i + 1);
const bUs = (i) => Math.round(aUs(i) + delayUs + drift * aUs(i) - earlierUs);
const lostByA = (i) => i >= 2000 && i < 2010; // flagged
const lostByB = (i) => i >= 3000 && i < 3040; // missing

function files() {
  const [a, b] = ['a.txt', 'b.txt'].map((name) => path.join(build, name));
  const all = Array.from({ length: count }, (_, i) => i);
  writeFileSync(a, all.map((i) => recorded(aUs(i), frame(values(i), { flags: lostByA(i) ? 4 : 0 }))).join(''));
  writeFileSync(b, all.filter((i) => bUs(i) > 1000 && !lostByB(i)).map((i) => recorded(bUs(i), frame(values(i)))).join(''));
  return [a, b];
}

// Gives the page a second port. Both bring frames whose CH1 changes with each: the second one 40 ms later, and it has marked some of
// them as lost.
const receivers = ([frames, lost]) => {
  const [one, other] = [fake.port, fake.second ?? (fake.second = fake.newPort())];
  one.permitted = other.permitted = true;
  const feed = (port, all, laterMs) => {
    let sent = 0;
    setInterval(() => {
      for (const end = Math.min(Math.floor((performance.now() - startMs - laterMs) / 9), all.length); sent < end; sent++) port().feed(all[sent]);
    }, 4);
  };
  let startMs;
  // Both are fed from when both are open on: before, one has no frames that the other lacks.
  other.onOpen = () => {
    other.onOpen = () => undefined;
    startMs = performance.now() + 300;
    feed(() => fake.port, frames, 0);
    feed(() => fake.second, frames.map((bytes, i) => (lost.includes(i) ? [...bytes.slice(0, 23), 4, 0] : bytes)), 40);
  };
  fake.choose = () => ((fake.choices = (fake.choices ?? 0) + 1) > 1 ? fake.second : fake.port);
};
// The first port.
const adapter = async (page) => {
  await page.click('#source-adapter');
  await reads(page, '#title', /^S\.Bus on a serial adapter, 8E2, FTDI/);
};
const many = Array.from({ length: 500 }, (_, i) => frame([400 + 2 * i, 992, 300 + i % 700]));
const lost = Array.from({ length: 25 }, (_, i) => 300 + i);

export default async function () {
  const [a, b] = files();

  await check('a second recording is compared as sbus compare does it: who lost what, the delay, the drift; a click goes to a loss', async (page) => {
    await playPaused(page, a);
    await page.setInputFiles('#second-file', b);
    await reads(page, '#second-title', 'B, b.txt');
    await reads(page, '#second-text', /^B is /);
    const lines = execFileSync(process.env.SCOPE_SBUS, ['compare', a, b, '--json'], { encoding: 'utf8' }).trim().split('\n').map((line) => JSON.parse(line));
    const found = lines.find(({ type }) => type === 'comparison');
    const ms = (us) => `${(us / 1000).toFixed(2)} ms`;
    const text = await page.textContent('#second-text');
    const earlier = ms(-found.delay_us);
    assert.equal(
      text,
      `B is ${earlier} earlier than A (${ms(found.least_delay_us)} to ${ms(found.most_delay_us)}, drift ${found.drift_ppm.toFixed(1)} µs/s), by ${found.evidence}. ` +
        `${found.same} frames alike, ${found.different} different; ${found.alone_a} only in A and ${found.alone_b} only in B before or after the other.`,
    );
    const median = parseFloat(earlier);
    assert.ok(Math.abs(median - (earlierUs - delayUs - (drift * aUs(count)) / 2) / 1000) < 1, earlier);
    assert.ok(Math.abs(found.drift_ppm - 1e6 * drift) < 1, `${found.drift_ppm}`);
    const lists = await page.$$eval('#second-lists section', (all) => all.map((each) => [each.querySelector('h3').textContent, ...[...each.querySelectorAll('li')].map((row) => row.textContent)]));
    const at = (i) => `0:${(Math.floor(aUs(i) / 1000 + 2.88) / 1000).toFixed(3)}`;
    assert.deepEqual(lists, [
      ['Lost by A: 10 frames in 1 span', `${at(2000)}10 frames`],
      ['Lost by B: 40 frames in 1 span', `${at(3000)}40 frames`],
    ]);
    await fits(page);
    await clean(page);
    await page.click('#second-lists section:nth-child(2) button');
    await reads(page, '#position-text', /^0:27\.3/);
    assert.equal(await page.textContent('#play'), 'Play');
  }, { size: { width: 360, height: 740 }, colorScheme: 'dark' });

  await check('a second file is read once: that it is gone afterwards is no failure of either', async (page) => {
    await playPaused(page, a);
    const large = path.join(build, 'large.txt');
    writeFileSync(large, Array.from({ length: 200000 }, (_, i) => recorded(9000 * (i + 1), frame(values(i)))).join(''));
    await page.setInputFiles('#second-file', large);
    await reads(page, '#second-title', 'B, large.txt');
    writeFileSync(large, '');
    await reads(page, '#second-text', /^B is .* 0 only in A and 194\d\d\d only in B/);
    assert.match(await page.textContent('#second-link'), /^Link: /);
    assert.doesNotMatch(await page.textContent('#verdict-text'), /failed/);
  });

  await check('two rates are told: frames differ by them', async (page) => {
    const [slow, fast] = [9, 14].map((period) => Array.from({ length: Math.floor(20000 / period) }, (_, i) =>
      recorded(1000 * period * (i + 1), frame([Math.round(1000 + 600 * Math.sin((period * i) / 400)), 992]))).join(''));
    await playPaused(page, 'rate9.txt', slow);
    await seek(page, 15000);
    writeFileSync(path.join(build, 'rate14.txt'), fast);
    await page.setInputFiles('#second-file', path.join(build, 'rate14.txt'));
    await reads(page, '#second-text', /A sends every 9\.00 ms, B every 14\.00 ms: frames differ while sticks move\. \d+ frames alike, \d+ different;/);
  });

  await check("B's curves are at the same moments as A's, also after a seek and while it plays", async (page) => {
    await playPaused(page, a);
    await seek(page, 20000);
    await page.setInputFiles('#second-file', b);
    await reads(page, '#second-text', /^B is /);
    const expect = async (seconds) => {
      await page.locator('#second-plot').scrollIntoViewIfNeeded();
      const over = await page.locator('#second-plot .u-over').boundingBox();
      for (const part of [0.15, 0.5, 0.93]) {
        await page.mouse.move(over.x + part * over.width, over.y + 20);
        let [time, one, timeOfA, oneOfA] = [];
        await until(() => `B at ${time} s, A at ${timeOfA} s`, async () => {
          await drawn(page);
          [, time, one] = /^B ([\d.]+) s {3}CH1 (\d+)/.exec(await page.textContent('#second-readout')) ?? [];
          [, timeOfA, oneOfA] = /^([\d.]+) s {3}CH1 (\d+)/.exec(await page.textContent('#readout')) ?? []; // the pointer is on both
          const right = (await page.evaluate(() => Number(document.querySelector('#position').value))) / 1000;
          const away = [Number(time) + (earlierUs - delayUs) / 1e6, Number(timeOfA)].map((at) => Math.abs(at - (right - seconds * (1 - part))));
          return Math.max(...away) < 0.03;
        });
        const i = Math.round((1e6 * Number(time) + earlierUs - delayUs - 2880) / 9000) - 1;
        assert.equal(Number(one), ch1(i), `frame ${i}`);
        assert.ok(Math.abs(oneOfA - one) < 60, `${oneOfA}, ${one}`);
      }
    };
    for (const ms of [20000, 45000, 12000]) {
      await seek(page, ms);
      await reads(page, '#position-text', new RegExp(`^0:${ms / 1000}\\.0`));
      await expect(10);
    }
    await page.selectOption('#speed', '2');
    await page.click('#play');
    await until('it plays', async () => (await page.evaluate(() => Number(document.querySelector('#position').value))) > 14000);
    await page.click('#play');
    await expect(10);
    await page.click('#second-close');
    await page.waitForSelector('#second', { state: 'hidden' });
    await page.setInputFiles('#second-file', b);
    await reads(page, '#second-text', /^B is /);
    await page.workers().at(-1).evaluate(() => void setTimeout(() => {
      throw new Error('out of memory');
    }));
    await reads(page, '#second-link', /^The decoder has failed\. /);
    await page.click('#source-simulated');
    await page.waitForSelector('#second', { state: 'hidden' });
  });

  await check("a channel that only A has is no number in B's values", async (page) => {
    const line = (i, header) => recorded(14000 * i + (header === 0x0f ? 7000 : 14000), frame(values(i), { header }));
    const [all, few] = [[0x0f, 0x2f], [0x0f]].map((headers, side) => {
      const file = path.join(build, `channels${side}.txt`);
      writeFileSync(file, Array.from({ length: 1000 }, (_, i) => headers.map((header) => line(i, header)).join('')).join(''));
      return file;
    });
    await playPaused(page, all);
    await page.setInputFiles('#second-file', few);
    await reads(page, '#second-text', /^B is /);
    await seek(page, 10000);
    await page.click('#bars li:nth-child(20) .chip');
    await reads(page, '#bars li:nth-child(20) .raw', '992');
    await page.locator('#plot').scrollIntoViewIfNeeded();
    await drawn(page);
    const over = await page.locator('#plot .u-over').boundingBox();
    await page.mouse.move(over.x + over.width / 2, over.y + 30);
    await reads(page, '#second-readout', /^B [\d.]+ s .* CH20 –$/);
  });

  await check('a second file that cannot be read, or has no frame in common, is said, and the first goes on', async (page) => {
    await play(page, a);
    await page.setInputFiles('#second-file', { name: 'bad.txt', mimeType: 'text/plain', buffer: Buffer.from('hello\n') });
    await reads(page, '#notice-text', /^This cannot be played: bad.txt: /);
    assert.ok(await page.locator('#second').isHidden());
    await page.setInputFiles('#second-file', { name: 'other.txt', mimeType: 'text/plain', buffer: Buffer.from(recorded(5000, frame([1]))) });
    await reads(page, '#second-text', 'The recordings have no frame in common.');
    assert.equal(await page.textContent('#title'), 'Recording a.txt');
  });

  await check('two receivers that scale the sticks differently: the ends that differ are told, of the same scale nothing', async (page) => {
    const line = (ends) => Array.from({ length: 2000 }, (_, i) => {
      const [low, high] = ends;
      return recorded(9000 * (i + 1), frame([low + Math.round(((high - low) * (1 + Math.sin(i / 40))) / 2), 992]));
    }).join('');
    const second = (ends) => page.setInputFiles('#second-file', { name: 'scaled.txt', mimeType: 'text/plain', buffer: Buffer.from(line(ends)) });
    await play(page, 'scale.txt', line([172, 1811]));
    await second([192, 1792]);
    await reads(page, '#second-text', /CH1 goes from 172 to 1811 in A, from 192 to 1792 in B: their scales differ\./);
    await second([172, 1811]);
    await reads(page, '#second-text', /^B is 0\.00 ms later(?!.*scales differ).* 2000 frames alike/);
  });

  for (const [where, set] of [['in a worker', inWorkers], ['in the page', (page, act, argument) => page.evaluate(act, argument)]]) {
    await check(`two adapters side by side, read ${where}: the delay of the second, who lost what, and its curves at the same moments`, async (page) => {
      await set(page, receivers, [many, lost]);
      await page.evaluate(receivers, [where === 'in the page' ? many : [], lost]);
      assert.ok(await page.locator('#compare').isHidden()); // the simulation has no second one
      await adapter(page);
      await page.click('#compare');
      await reads(page, '#second-title', 'B, FTDI FT232 (0403:6001)');
      // A frame that is read late, by a PC that is busy with other tests, may be left out; it is no loss.
      const numbers = async () => {
        const text = await page.textContent('#second-text');
        const [delay, alike = 0, different, onlyA, onlyB] = (/^B is ([\d.]+) ms later than A .* by the contents: [^.]*\. (\d+) frames alike, (\d+) different; (\d+) only in A and (\d+) only in B/.exec(text) ?? []).slice(1).map(Number);
        const late = Number(/Not compared: (\d+) of A/.exec(text)?.[1] ?? 0);
        const [lostByA, lostByB] = [...(await page.textContent('#second-lists')).matchAll(/Lost by .: (\d+) frame/g)].map(([, count]) => Number(count));
        return { delay, alike, different, onlyA, onlyB, late, lostByA, lostByB };
      };
      await until(async () => JSON.stringify(await numbers()), async () => {
        const { alike, late, lostByB } = await numbers();
        return alike + late + lostByB >= 495 && (lostByB === 25 || late > 0);
      });
      const { delay, alike, different, onlyA, onlyB, lostByA, lostByB } = await numbers();
      assert.ok(Math.abs(delay - 40) < 20, `${delay}`);
      assert.deepEqual([different, onlyB, lostByA], [0, 0, 0]);
      assert.ok(alike <= 475 && onlyA <= 5 && lostByB <= 25, `${alike} ${onlyA} ${lostByB}`);
      await page.click('#pause');
      await page.locator('#second-plot').scrollIntoViewIfNeeded();
      const over = await page.locator('#second-plot .u-over').boundingBox();
      let [b, a] = [];
      let tries = 0;
      await until(() => `B ${b}, A ${a}`, async () => {
        await page.mouse.move(over.x + over.width * (0.5 + (tries++ % 10) / 100), over.y + 20);
        await drawn(page);
        b = /^B [\d.]+ s {3}CH1 (\d+)/.exec(await page.textContent('#second-readout'))?.[1];
        a = /^[\d.]+ s {3}CH1 (\d+)/.exec(await page.textContent('#readout'))?.[1];
        return Math.abs(a - b) <= 8 && a > 420 && a < 1390; // two a frame
      });
      await fits(page);
      await clean(page);
      if (lostByB > 0) await page.click('#second-lists section:nth-child(2) button');
      await page.click('#source-simulated');
      await page.waitForSelector('#second', { state: 'hidden' });
    });
  }

  await check('frames that come while the page tries baud rates at the second adapter are not lost by it', async (page) => {
    await page.evaluate(receivers, [[], []]);
    await page.evaluate((frames) => {
      const { second } = fake;
      const feed = () => {
        const startMs = performance.now() + 1150; // the page waits for frames for 1 s, then tries each rate for 0.5 s
        let sent = 0;
        setInterval(() => {
          for (const end = Math.min(Math.floor((performance.now() - startMs) / 9), frames.length); sent < end; sent++) {
            fake.port.feed(frames[sent]);
            if (second.opened.at(-1).baudRate === 100000) second.feed(frames[sent]);
          }
        }, 4);
      };
      second.onOpen = () => {
        second.onOpen = () => undefined;
        feed();
      };
    }, many);
    await adapter(page);
    await page.click('#compare');
    const alike = async () => Number(/(\d+) frames alike/.exec(await page.textContent('#second-text'))?.[1] ?? 0);
    await until(alike, async () => (await alike()) > 200);
    assert.match(await page.textContent('#second-lists'), /Lost by A: 0 frames in 0 spans.*Lost by B: 0 frames in 0 spans/);
    assert.ok(await page.evaluate(() => fake.second.opened.some(({ baudRate }) => baudRate === 200000)));
  });

  await check('a second adapter that takes long to open is closed again if its line is closed, or another source is chosen, meanwhile', async (page) => {
    await page.evaluate(receivers, [many, []]);
    await page.evaluate(() => (fake.second.openMs = 1300));
    const closed = async (port) => {
      await page.waitForSelector('#second', { state: 'hidden' });
      await page.waitForTimeout(1500);
      await until('it is closed', () => page.evaluate((name) => !fake[name].isOpen && !fake[name].isLocked, port));
    };
    await adapter(page);
    await page.click('#compare');
    await reads(page, '#second-title', /^B, /);
    await page.click('#second-close');
    await closed('second');
    await page.click('#compare');
    await page.evaluate(() => Object.assign(fake, { choose: () => fake.second }));
    await page.click('#compare'); // twice in a row
    await reads(page, '#second-text', /^B is .* frames alike/);
    await page.click('#second-close');
    await closed('second');
    await page.click('#compare');
    await page.click('#source-simulated');
    await closed('second');
    await closed('port');
  });

  await check('a second adapter that is unplugged is said, its losses grow, and it goes on once it is plugged in; the first port cannot be the second', async (page) => {
    await page.evaluate(receivers, [Array.from({ length: 4000 }, (_, i) => frame([400 + (i % 1200), 992, 300 + (i % 700)])), []]);
    await adapter(page);
    await page.evaluate(() => Object.assign(fake, { kept: fake.choose, choose: () => fake.port }));
    await page.click('#compare');
    await reads(page, '#notice-text', 'The page shows this port already.');
    await page.evaluate(() => fake.port.unplug());
    await reads(page, '#verdict-text', 'The port is gone.');
    await page.evaluate(() => fake.port.plug()); // now it is another SerialPort, of the same device as the second one
    await until('it is open again', () => page.evaluate(() => fake.port.isLocked));
    await page.click('#compare');
    await reads(page, '#notice-text', 'The page shows this port already.');
    await page.evaluate(() => Object.assign(fake, { choose: () => undefined }));
    await page.click('#compare');
    await reads(page, '#notice-text', 'No port was chosen.');
    assert.ok(await page.locator('#second').isHidden());
    await page.evaluate(() => Object.assign(fake, { choose: fake.kept, choices: 1 }));
    await page.click('#compare');
    await reads(page, '#second-text', /^B is .* frames alike/);
    await reads(page, '#second-link', /^Link: Fine, quality \d+ %\.$/);
    assert.equal(await page.getAttribute('#second-text', 'aria-live'), 'off'); // it changes twice a second
    const lostByB = async () => Number(/Lost by B: (\d+) frame/.exec(await page.textContent('#second-lists'))?.[1] ?? 0);
    await page.evaluate(() => fake.second.unplug());
    await reads(page, '#second-link', /^The port is gone\. Plug the adapter/);
    await until(lostByB, async () => (await lostByB()) > 100);
    await page.evaluate(() => void (fake.second = fake.second.plug()));
    await reads(page, '#second-link', /^Link: Fine/);
    const alike = async () => Number(/(\d+) frames alike/.exec(await page.textContent('#second-text'))[1]);
    const before = await alike();
    await until(alike, async () => (await alike()) > before + 100); // losses are certain a second later
    const missed = await lostByB();
    await until(alike, async () => (await alike()) > before + 300);
    assert.equal(await lostByB(), missed); // the span has ended
    await page.click('#second-close');
    await page.waitForSelector('#second', { state: 'hidden' });
    await until('it is closed', () => page.evaluate(() => !fake.second.isOpen));
    await page.click('#compare');
    await reads(page, '#second-text', /^B is .* frames alike/);
  });
}
