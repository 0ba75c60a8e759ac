// What the page finds on each line of verdicts/LINES, on which `sbus doctor` and the sketch Diagnose are also tested. This calls
// the library as src/worker/trials.ts does: the settings of a port one after the other, unless frames come.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { EndUs, Native } from './native.mjs';
import { check, root } from './support.mjs';

const test = path.join(root, 'test');
const trialUs = 500000;
const watchUs = 1000000;
const settings = [[100000, 1], [200000, 1], [100000, 0], [200000, 0]];

class Page extends Native {
  simulated(option) {
    const inverted = Number(!option('uninverted'));
    this.wasm.openSimulated(0, option('channels') ?? 16, option('noise') ?? 0, option('baud') ?? 100000, inverted);
    this.wasm.setPort(0, 100000, 1);
    this.wasm.cutWire(Number(option('silent') ?? 0));
    this.advance(watchUs);
    if (this.status(watchUs, 'frames') > 0) {
      return this.status(watchUs, 'findingSoFar');
    }
    this.wasm.beginRound();
    settings.forEach(([baud, way], i) => {
      this.wasm.setPort(watchUs + i * trialUs, baud, way);
      this.advance(watchUs + (i + 1) * trialUs);
      this.wasm.addTrial();
    });
    return this.wasm.roundFinding();
  }

  recording(text) {
    this.open(text);
    const endUs = this.wasm.recordingLengthUs() + EndUs;
    this.advance(endUs);
    return this.status(endUs, 'findingSoFar');
  }

  // In a recording of an adapter, a line has what the adapter brought at once.
  port(text) {
    this.wasm.openPort(0, 100000, 0);
    let nowUs = 0;
    for (const [, us, words] of text.matchAll(/^(\d+)~\d+ (.*)$/gm)) {
      const bytes = words.split(' ').map((word) => parseInt(word, 16));
      nowUs = Number(us) + 120 * (bytes.length - 1);
      this.advance(nowUs - 1000);
      this.give(bytes, (count) => this.wasm.received(count, nowUs));
    }
    this.advance(nowUs + 100000);
    return this.status(nowUs + 100000, 'findingSoFar');
  }
}

export default async function () {
  const folder = mkdtempSync(path.join(os.tmpdir(), 'lines-'));
  execFileSync('sh', [path.join(test, 'verdicts/lines.sh'), folder]);
  for (const line of readFileSync(path.join(test, 'verdicts/LINES'), 'utf8').trim().split('\n')) {
    const [finding, well, , by, source] = line.split('|');
    if (line.startsWith('#') || !by.includes('p')) {
      continue;
    }
    await check(`the page finds on ${source}: ${finding}`, async () => {
      const page = await new Page().load();
      const words = (/^sim:(\S+)/.exec(source)?.[1] ?? '').split(',').map((word) => word.split('='));
      const options = new Map(words.map(([word, value]) => (/^\d/.test(word) ? ['channels', word] : [word, value ?? true])));
      options.set('baud', /--baud (\d+)/.exec(source)?.[1]);
      const option = (name) => options.get(name);
      const text = source.startsWith('sim') ? '' : readFileSync(path.resolve(test, source.replace('WORK', folder)), 'utf8');
      const found = text === '' ? [page.simulated(option)] : [page.recording(text)];
      if (text.includes('~')) {
        found.push(page.port(text));
      }
      for (const each of found) {
        assert.equal(page.words(page.wasm.findingText(each)).slice(0, finding.length), finding);
        assert.equal(page.wasm.findingIsWell(each), Number(well === 'yes'));
      }
    });
  }
  rmSync(folder, { recursive: true });
}
