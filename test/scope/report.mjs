// A whole flight at a glance: the page's figures, verdict, report and rows are those of `sbus summary` and `sbus csv`, on lines of a generator.
// SCOPE_SBUS is the program.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { random } from './modules.mjs';
import { Native } from './native.mjs';
import { build, check, downloaded, frame, play, playToEnd, reads, recorded, until } from './support.mjs';

const lines = 60;
const seed = Number(process.env.SEED ?? 4202);
const sbus = (...options) => execFileSync(process.env.SCOPE_SBUS, options, { encoding: 'utf8' });

// A flight of some seconds: with losses, spans of failsafe, silences, damaged bytes, jumps and a PC that is late, each in some of them.
function flight(random) {
  const chance = (part) => random() < part;
  const period = [7000, 9000, 14000][Math.floor(3 * random())];
  const lost = chance(0.3) ? 0 : random() ** 4;
  const [failsafes, silences, damages, lates, jumps] = [0.004, 0.002, 0.01, 0.002, 0.01].map((part) => (chance(0.5) ? part * random() : 0));
  const isPort = chance(0.3);
  let text = chance(0.3) ? '# format 1, began 2026-11-24T15:16:18.000000Z\n' : '';
  let failsafe = 0;
  let stick = 992;
  let us = Math.floor(1e6 * random()); // sbus remarks on two silent seconds
  for (const endUs = us + 2e6 + 2e7 * random(); us < endUs; us += period) {
    failsafe = failsafe > 0 ? failsafe - 1 : chance(failsafes) ? Math.floor(300 * random()) : 0;
    stick = Math.min(1811, Math.max(172, stick + Math.floor(41 * random()) - 20));
    const bytes = frame([chance(jumps) ? Math.floor(2048 * random()) : stick, 992], { flags: (chance(lost) ? 4 : 0) + (failsafe > 0 ? 8 : 0) });
    if (chance(damages)) {
      bytes.splice(Math.floor(25 * random()), 1);
    }
    const late = chance(lates) ? Math.floor(2e6 * random()) : 0;
    us += chance(silences) ? Math.floor(2e6 * random()) : late;
    const line = recorded(us, bytes);
    text += isPort ? line.replace(' ', `~${late || 3000} `) : chance(damages) ? line.replace(/\n/, '!\n') : line;
  }
  return text;
}

const textsOf = (page, selector) => page.$$eval(selector, (all) => all.filter((each) => each.checkVisibility()).map(({ textContent }) => textContent));
const heights = (page) => page.$eval('#strip .lost', (shape) =>
  [...shape.getAttribute('d').matchAll(/M([\d.]+) 8h[\d.]+v-([\d.]+)/g)].map(([, x, height]) => [Number(x), Number(height)]));
const known = (page) => page.waitForSelector('#report:not([hidden])');

export default async function () {
  const next = random(seed);
  const flights = Array.from({ length: lines }, (_, i) => {
    const file = path.join(build, `flight${i}.txt`);
    writeFileSync(file, flight(next));
    return file;
  });

  await check(`the figures, the verdict and the report of ${lines} flights are those of sbus summary (seed ${seed})`, async () => {
    const severities = new Set();
    for (const file of flights) {
      const page = await new Native().load();
      page.give(new TextEncoder().encode(path.basename(file)), (count) => page.wasm.nameFile(count));
      page.open(readFileSync(file, 'utf8'));
      const found = page.flight();
      const told = sbus('summary', '--json', file).trim().split('\n').map((line) => JSON.parse(line));
      const { frames, lost_frames, failsafe_frames, discarded_bytes, character_errors, from_us, to_us } = told.find(({ type }) => type === 'summary');
      assert.deepEqual([found.frames, found.lostFrames, found.failsafeFrames, found.discardedBytes, found.characterErrors, found.fromUs, found.toUs],
        [frames, lost_frames, failsafe_frames, discarded_bytes, character_errors, from_us, to_us], file);
      ['failsafe', 'no_pulses', 'lost_frames', 'no_frames', 'late', 'jump'].forEach((name, kind) => {
        const spans = told.filter(({ type, kind: each }) => type === 'span' && each === name);
        const us = spans.reduce((sum, span) => sum + span.to_us - span.from_us, 0);
        assert.deepEqual([found.spans[kind].count, found.spans[kind].us], [spans.length, us], `${file}: ${name}`);
      });
      const html = page.words(page.wasm.flightPage());
      assert.equal(html, sbus('summary', '-o', '-', file), file);
      assert.ok(html.includes(found.text), file);
      severities.add(found.severity);
    }
    assert.equal(severities.size, 3, 'not every verdict was there');
  }, { patience: 120000 });

  await check(`the rows of ${lines} flights that the page saves are those of sbus csv`, async (page) => {
    for (const file of flights) {
      await playToEnd(page, file);
      const told = sbus('csv', '--every-frame', '--columns', 'time,ch1-ch16,failsafe,lostframe', file).trim().split('\n');
      let rows = [];
      await until(() => `${file}: ${rows.length} rows, not ${told.length}`, async () => {
        const { text } = await downloaded(page, '#csv');
        rows = text.trim().split('\n').slice(1).map((row) => row.split(',').filter((_, i) => i < 17 || i > 18).join());
        return rows.length === told.length;
      });
      assert.deepEqual(rows, told, file);
    }
  }, { patience: 300000 });

  for (const file of flights.slice(0, 6)) {
    await check(`the page shows what sbus summary prints about ${path.basename(file)}`, async (page) => {
      await play(page, file);
      await known(page);
      const text = sbus('summary', file);
      const [, severity, verdict] = /class="verdict ([a-z]+)">([^<]*)/.exec(sbus('summary', '-o', '-', file));
      assert.equal(await page.textContent('#whole-text'), verdict);
      assert.equal(await page.getAttribute('#whole', 'data-severity'), severity === 'bad' ? 'alarm' : severity);
      const facts = await page.textContent('#report-facts');
      const [, frames, lost, failsafe, discarded, errors] = /, (\d+) frames, (\d+) with the lost-frame flag, (\d+) in failsafe; (\d+) discarded bytes, (\d+) character/.exec(text);
      for (const wanted of [`: ${frames} frames, `, `; ${lost} with the lost-frame flag, `, `${failsafe} in failsafe; ${discarded} discarded bytes, ${errors} character errors.`]) {
        assert.ok(facts.includes(wanted), `${facts} lacks ${wanted}`);
      }
      const shown = await textsOf(page, '#report-lists h3');
      const strip = await textsOf(page, '#fault-counts li');
      for (const [, name, times] of text.matchAll(/^(failsafe|lost frames|no frames|PC late) +(\d+ times?, [\d.]+ s in all)/gm)) {
        const title = `${name[0].toUpperCase()}${name.slice(1)}: ${times}`;
        assert.ok(shown.some((each) => each.startsWith(title)), `${shown} lacks ${title}`);
        assert.ok(strip.includes(`${name}: ${parseInt(times, 10)} ×`), `${strip} lacks ${name}: ${times}`);
      }
    });
  }

  // Two minutes. In second 20 are 0.9 % lost, in second 40 all but some, in second 60 failsafe, in second 80 nothing comes for half of it.
  const file = path.join(build, 'glance.txt');
  writeFileSync(file, Array.from({ length: 12000 }, (_, i) => {
    const second = Math.floor((i + 1) / 100);
    const at = (i + 1) % 100;
    const flags = (second === 20 && at === 50) || (second === 40 && at > 59) ? 4 : second === 60 && at > 19 && at < 70 ? 12 : 0;
    return second === 80 && at >= 50 ? '' : recorded(10000 * (i + 1), frame([1000], { flags }));
  }).join(''));

  await check('1 % and 40 % of lost frames have different heights on the strip', async (page) => {
    await play(page, file);
    await known(page);
    const of = new Map((await heights(page)).map(([x, height]) => [Math.round((x / 512) * 120), height]));
    assert.ok(of.get(40) > 4 * of.get(20), JSON.stringify([...of]));
    assert.ok(of.get(20) > 0.25);
  });

  await check('frames that are missing without a flag have a name beside the strip, which shows them', async (page) => {
    await play(page, 'silent.txt', Array.from({ length: 300 }, (_, i) => recorded(10000 * (i + 1) + (i < 150 ? 0 : 500000), frame([1000]))).join(''));
    await known(page);
    assert.deepEqual(await textsOf(page, '#fault-counts li:not([hidden])'), ['whole recording: 1 fault', 'missing frames', 'no frames: 1 ×']);
  });

  await check('the worst seconds besides those of failsafe and silence are ranked, and a click goes there and stands still', async (page) => {
    await play(page, file);
    await known(page);
    const worst = await textsOf(page, '#report-lists section:first-child li');
    assert.deepEqual(worst.map((text) => text.slice(0, 4)), ['0:40', '0:20']);
    await page.click('#report-lists section:first-child li:first-child button');
    await reads(page, '#play', 'Play');
    await until('it is not there', async () => Math.abs((await page.inputValue('#position')) - 41000) <= 10);
    await page.click('#report-lists section:nth-child(2) button');
    await until('it is not there', async () => Math.abs((await page.inputValue('#position')) - 60205) <= 10);
    await page.waitForSelector('#indicator-failsafe[data-on="true"]');
  });

  await check('one kind of fault is shown, and N and Shift+N go to faults of that kind', async (page) => {
    await play(page, file);
    await known(page);
    await page.click('#fault-counts li:nth-child(4) button');
    assert.equal(await page.textContent('#fault-counts [aria-pressed="true"]'), 'lost frames: 2 ×');
    assert.deepEqual(await page.$$eval('#strip path', (all) => all.map((each) => getComputedStyle(each).display !== 'none')), [false, false, true, false, false, false]);
    await page.focus('#plot');
    await page.evaluate(() => document.querySelector('#play').textContent === 'Pause' && document.querySelector('#play').click());
    await page.fill('#position', '0');
    for (const [key, text] of [['n', 'Fault 1 of 2: lost frames, 0:20'], ['n', 'Fault 2 of 2: lost frames, 0:40'], ['Shift+N', 'Fault 1 of 2: lost frames, 0:20']]) {
      await page.keyboard.press(key);
      await reads(page, '#fault-text', new RegExp(`^${text}`));
    }
    await page.keyboard.press('Shift+N');
    await reads(page, '#fault-text', 'There is no other fault "lost frames" in this direction.');
    await page.fill('#position', '0');
    await page.click('#fault-counts li:nth-child(2) button');
    await page.focus('#plot');
    await page.keyboard.press('n');
    await reads(page, '#fault-text', /^Fault 1 of 1: failsafe, 1:00/); // past lost frames
    await page.click('#fault-counts [aria-pressed="true"]');
    await page.focus('#plot');
    await page.keyboard.press('Shift+N');
    await reads(page, '#fault-text', /^Fault 2 of 4: lost frames/);
    await page.keyboard.press('n');
    await reads(page, '#fault-text', /^Fault 3 of 4: failsafe/);
  });

  await check('the report opens in a tab of its own', async (page) => {
    await play(page, file);
    await known(page);
    const [tab] = await Promise.all([page.waitForEvent('popup'), page.click('#report-open')]);
    await tab.waitForSelector('table');
    assert.equal(await tab.textContent('h1'), 'glance.txt');
    assert.match(await tab.textContent('.verdict'), /^Failsafe 1 time, longest 0\.5 s; no frames 1 time, longest 0\.5 s/);
    assert.equal(await tab.content().then((html) => html.includes('<script')), false);
    assert.ok(await tab.evaluate(() => getComputedStyle(document.querySelector('.verdict')).borderLeftWidth === '6px'), 'it has no style');
    assert.equal(await tab.evaluate(() => getComputedStyle(document.querySelector('.key i')).printColorAdjust), 'exact');
    await tab.close();
  });

  await check('a simulation has no report, nor has a recording that follows another', async (page) => {
    assert.ok(await page.isVisible('#report') === false);
    await play(page, file);
    await known(page);
    await page.click('#source-simulated');
    await until('it stays', async () => !(await page.isVisible('#report')));
    assert.ok((await textsOf(page, '#report-lists li')).length === 0);
  });
}
