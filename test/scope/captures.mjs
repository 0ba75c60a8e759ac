// Captures of the wire: what the page decodes is what the recording holds that they were made of.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { gzipSync } from 'node:zlib';
import { check, downloaded, play, reads, root, toEnd } from './support.mjs';

const bitUs = 10;

// The edges of a recording's wire, 8E2: [us, high].
function edges(text, idle) {
  const found = [[0, idle]];
  const level = (us, high) => high !== found.at(-1)[1] && found.push([us, high]);
  for (const line of text.split('\n').filter((each) => /^\d/.test(each))) {
    const [us, ...words] = line.trim().split(/\s+/);
    words.forEach((word, i) => {
      const value = parseInt(word, 16);
      const begin = Number(us) + (i - 1) * 12 * bitUs;
      const bits = Array.from({ length: 8 }, (_, bit) => (value >> bit) & 1);
      const parity = bits.reduce((sum, bit) => sum ^ bit, 0);
      [0, ...bits, parity, 1].forEach((bit, at) => level(begin + at * bitUs, bit ? idle : 1 - idle));
    });
  }
  return found;
}

const forms = {
  vcd: (wire) => `$timescale 1us $end\n$var wire 1 ! RX $end\n$var wire 1 " GND $end\n$enddefinitions $end\n#0\n0"\n` +
    `${wire.map(([us, high]) => `#${us}\n${high}!\n`).join('')}#${wire.at(-1)[0] + 20000}\n`,
  csv: (wire) => `Time [s],Channel 0\n${wire.map(([us, high]) => `${(us / 1e6).toFixed(6)},${high}\n`).join('')}` +
    `${(wire.at(-1)[0] / 1e6 + 0.02).toFixed(6)},${wire.at(-1)[1]}\n`,
};

const rows = (csv) => csv.trim().split('\n').slice(1);
const choose = (page, name, content) => page.setInputFiles('#file', { name, mimeType: 'application/octet-stream', buffer: Buffer.from(content) });

export default async function () {
  for (const [recording, form, idle, signal] of [
    ['paper', 'vcd', 0, 'RX, 100000 baud, 8E2, inverted'],
    ['sbus2', 'vcd', 1, 'RX, 100000 baud, 8E2, not inverted'],
    ['frsky-neutral', 'csv', 0, 'Channel 0, 100000 baud, 8E2, inverted'],
  ]) {
    await check(`${recording}.txt as ${form}, idle ${idle}, also as .gz: the frames and times of the recording, and the signal that has them`, async (page) => {
      const file = path.join(root, `test/recordings/${recording}.txt`);
      const capture = forms[form](edges(readFileSync(file, 'utf8'), idle));
      await play(page, file);
      await toEnd(page);
      const wanted = rows((await downloaded(page, '#csv')).text);
      assert.ok(wanted.length > 0);
      for (const [name, content] of [[`wire.${form}`, capture], [`wire.${form}.gz`, gzipSync(capture)]]) {
        await choose(page, name, content);
        await reads(page, '#title', `Capture ${name}, signal ${signal}`);
        await toEnd(page);
        assert.deepEqual(rows((await downloaded(page, '#csv')).text), wanted);
      }
    });
  }

  // The words of `sbus decode` and of what reads captures: `sbus csv`.
  const noSignal = 'No signal has a frame of S.Bus: a frame is 25 characters (36 of 24 channels), 8E2 at 100000 or 200000 baud, from 0F to an end byte, after a gap';
  const slow = 'Time [s],Channel 0\n0.0,0\n0.1,1\n0.2,0\n0.3,1\n0.4,0\n';
  for (const [name, content, said] of [
    ['idle.csv', 'Time [s],Channel 0\n0.1,0\n0.2,1\n', `idle.csv: signal Channel 0 has no pulses: is the probe on S-BUS_OUT, and the receiver on? ${noSignal}`],
    ['slow.csv', slow, `slow.csv: signal Channel 0 is no S.Bus: its shortest pulses last 100000.0 us, as bits of 10 baud do: 10 us or 5 us are expected, within 3 %. ${noSignal}`],
    ['broken.vcd', forms.vcd([[0, 0], [10, 1]]).replace('#10', '#-10'), /^This cannot be played: broken\.vcd:\d+: .*; sbus decode -o FILE keeps what came before it\.$/],
    ['session.sr', 'PK\u0003\u0004', 'session.sr: is packed: sbus decode reads a session of PulseView (.sr); or export it as VCD or CSV'],
    ['logic.sal', '<SALEAE>\0\0', 'logic.sal: is Logic 2\'s binary export: export it as CSV'],
  ]) {
    await check(`${name} is rejected in the words of the command, and the simulation goes on`, async (page) => {
      await choose(page, name, content);
      await reads(page, '#notice-text', typeof said === 'string' ? `This cannot be played: ${said}.` : said);
      await reads(page, '#state', 'Fine');
    });
  }

  await check('a .gz that is cut off is rejected', async (page) => {
    await choose(page, 'cut.vcd.gz', gzipSync(forms.vcd([[0, 0], [10, 1]])).subarray(0, 40));
    await reads(page, '#notice-text', /^This cannot be played: cut\.vcd\.gz: cannot be read: /);
    await reads(page, '#state', 'Fine');
  });
}
