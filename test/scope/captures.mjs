// Captures of the wire: the page decodes from them what is in the recording that they were made of.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { gzipSync } from 'node:zlib';
import { build, check, counts, downloaded, frame, playPaused, playToEnd, reads, recorded, root, seek } from './support.mjs';

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

// A session of sigrok, 1 MHz, its samples in this many entries (0: one entry without a number), packed by another program.
function session(wire, parts, { metadata = true, stored = false } = {}) {
  const samples = Buffer.alloc(wire.at(-1)[0] + 20000);
  wire.forEach(([us, high], i) => samples.fill(high << 4, us, wire[i + 1]?.[0]));
  const size = Math.ceil(samples.length / Math.max(parts, 1));
  const entries = Array.from({ length: parts }, (_, i) => [`logic-1-${i + 1}`, samples.subarray(i * size, (i + 1) * size)]);
  const all = [...(parts === 0 ? [['logic-1', samples]] : entries.reverse()), ...(metadata ? [['metadata', Buffer.from(
    '[global]\nsigrok version=0.5.2\n\n[device 1]\ncapturefile=logic-1\ntotal probes=8\nsamplerate=1 MHz\nprobe5=SBUS\nunitsize=1\n')]] : [])];
  return pack(all, stored);
}
function pack(entries, stored = false) {
  const program = `import base64, io, json, sys, zipfile
out = io.BytesIO()
with zipfile.ZipFile(out, "w", zipfile.ZIP_STORED if json.loads(sys.argv[1]) else zipfile.ZIP_DEFLATED) as packed:
    for name, content in json.load(sys.stdin):
        packed.writestr(name, base64.b64decode(content))
sys.stdout.buffer.write(out.getvalue())`;
  const input = JSON.stringify(entries.map(([name, content]) => [name, content.toString('base64')]));
  return execFileSync('python3', ['-c', program, JSON.stringify(stored)], { input, maxBuffer: 1 << 26 });
}

const rows = (csv) => csv.trim().split('\n').slice(1);
const choose = (page, name, content) => page.setInputFiles('#file', { name, mimeType: 'application/octet-stream', buffer: Buffer.from(content) });

export default async function () {
  for (const [recording, form, idle, signal, width] of [
    ['paper', 'vcd', 0, 'RX, 100000 baud, 8E2, inverted', '0.401 s'],
    ['sbus2', 'vcd', 1, 'RX, 100000 baud, 8E2, not inverted', '0.805 s'],
    ['frsky-neutral', 'csv', 0, 'Channel 0, 100000 baud, 8E2, inverted', '0.2 s'],
  ]) {
    await check(`${recording}.txt as ${form}, idle ${idle}, also as .gz and .zip, has the frames and times of the recording, and names its signal`, async (page) => {
      const file = path.join(root, `test/recordings/${recording}.txt`);
      const capture = forms[form](edges(readFileSync(file, 'utf8'), idle));
      await playToEnd(page, file);
      const wanted = rows((await downloaded(page, '#csv')).text);
      assert.ok(wanted.length > 0);
      const zip = pack([[`__MACOSX/._wire.${form}`, Buffer.from('Mac OS X')], [`wire.${form}`, Buffer.from(capture)]]); // as macOS packs it
      for (const [name, content] of [[`wire.${form}`, capture], [`wire.${form}.gz`, gzipSync(capture)], [`wire.${form}.zip`, zip]]) {
        await playToEnd(page, name, content);
        assert.equal(await page.textContent('#title'), `Capture ${name}, signal ${signal}`);
        assert.equal(await page.textContent('#window'), width); // all of it
        assert.deepEqual(rows((await downloaded(page, '#csv')).text), wanted);
      }
    });
  }

  for (const [how, parts, stored] of [['one entry', 0, false], ['one entry, not packed', 0, true], ['eleven entries, the last one first', 11, false]]) {
    await check(`a session of sigrok, ${how}, has the frames and times of the recording, and names its signal`, async (page) => {
      const file = path.join(root, 'test/recordings/paper.txt');
      await playToEnd(page, file);
      const wanted = rows((await downloaded(page, '#csv')).text);
      await playToEnd(page, 'wire.sr', session(edges(readFileSync(file, 'utf8'), 0), parts, { stored }));
      assert.equal(await page.textContent('#title'), 'Capture wire.sr, signal SBUS, 100000 baud, 8E2, inverted');
      assert.deepEqual(rows((await downloaded(page, '#csv')).text), wanted);
    });
  }

  const wire = edges('120 0F', 0);
  const whole = session(wire, 0, { stored: true });
  const damaged = Buffer.from(whole);
  damaged[500] ^= 1;
  const metadata = Buffer.from('[device 1]\ncapturefile=logic-1\nsamplerate=1 MHz\nprobe1=A\nunitsize=1\n');

  const frames = ['0F5B2469B59198445E7A15462622A61E6B5B5982A7882D0000', '0F770C68BEA598445E7A15462622A61E6B5B5982A7882D0000',
    '0F883C69B9F398445E7A15462622A61E6B5B5982A7882D0000'].map((hex) => [...Buffer.from(hex, 'hex')]);
  // The messages are those of `sbus decode` and of `sbus csv`.
  const noSignal = 'No signal has a frame of S.Bus: a frame is 25 characters (36 with 24 channels), 8E2 at 100000 or 200000 baud, from 0F to an end byte, after a gap';
  for (const [name, content, said] of [
    ['idle.csv', 'Time [s],Channel 0\n0.1,0\n0.2,1\n', `idle.csv: signal Channel 0 has no pulses: is the probe on S-BUS_OUT, and the receiver on? ${noSignal}`],
    ['broken.vcd', forms.vcd([[0, 0], [10, 1]]).replace('#10', '#-10'), 'In line 9 of broken.vcd, "-10" is not a time: a whole number is expected after #'],
    ['wire.vcd.xz', Buffer.from('\xFD7zXZ\0', 'latin1'), 'wire.vcd.xz is packed in a way that is not read here: unpack it, or pack it as .gz or .zip'],
    ['other.zip', pack([['a', Buffer.from('1')], ['b', Buffer.from('2')]]), 'other.zip is a ZIP, but not a session of sigrok or PulseView, which has metadata: export it as VCD or as CSV'],
    ['empty.sr', pack([['version', Buffer.from('2')], ['metadata', metadata]]), 'empty.sr has no samples: logic-1 or logic-1-1 is expected in it'],
    ['analog.sr', pack([['metadata', Buffer.from('[device 1]\nsamplerate=1 MHz\n')]]), 'analog.sr has no logic signals: a session with them, or CSV of analogue ones, is expected'],
    ['idle.sr', pack([['metadata', metadata], ['logic-1', Buffer.alloc(1000)]]), `idle.sr: signal A has no pulses: is the probe on S-BUS_OUT, and the receiver on? ${noSignal}`],
    ['cut.sr', whole.subarray(0, 600), 'cut.sr cannot be read: the ZIP has no directory: is it incomplete?'],
    ['damaged.sr', damaged, 'damaged.sr cannot be read: the ZIP is damaged'],
    ['digital.bin', '<SALEAE>\0\0', 'digital.bin is Logic 2\'s binary export: export it as CSV'],
    ['logic.sal', pack([['meta.json', Buffer.from('{}')], ['digital-0.bin', Buffer.from('1')]]), 'logic.sal is a capture of Saleae\'s Logic 2: export it as CSV (File, Export Raw Data)'],
    ['utf8.bin', Buffer.from(String.fromCharCode(...frames.flat()), 'utf8'), /^utf8\.bin: its bytes went through UTF-8: a program took them for text; /],
  ]) {
    await check(`${name} is rejected with the message of the command, and the simulation continues`, async (page) => {
      await choose(page, name, content);
      await reads(page, '#notice-text', typeof said === 'string' ? said.replace(/[^?]$/, '$&.') : said);
      await reads(page, '#state', 'Fine');
    });
  }

  // What the command reads, the page reads: the same frames, and the file's own times. One of each reader: test/tool has all that they read.
  const words = (bytes) => bytes.map((byte) => byte.toString(16).padStart(2, '0')).join(' ');
  const lines = (form) => `${frames.map(form).join('\n')}\n`;
  const times = frames.map((bytes, i) => `${9000 * i - 12345} ${words(bytes)}`).join('\n');
  const levels = edges(times.replace(/^(-?\d+)/gm, (us) => String(Number(us) + 20000)), 0);
  const early = `Time [s],S\n${levels.map(([us, high]) => `${((us - 20000) / 1e6).toFixed(6)},${high}\n`).join('')}`;
  const channels = Array.from({ length: 16 }, (_, i) => i);
  const table = `time,${channels.map((i) => `CH${i + 1}`)}\n${lines((_, row) => `${(0.009 * row).toFixed(6)},${channels.map((i) => 200 + 40 * i + row)}`)}`;
  for (const [what, name, content] of [
    ['a capture that begins before its trigger', 'wire.csv', early],
    ['rows in German', 'rows-de.csv', table.replaceAll(',', ';').replaceAll('.', ',')],
    ['a recording of one', 'wire.txt', `# 100000 baud, 8E2, inverted\n${times}\n`],
    ['raw bytes', 'raw', Buffer.from(frames.flat())],
    ['a dump', 'dump.txt', frames.flat().map((_, i, all) => (i % 16 ? '' : `${i.toString(16).padStart(8, '0')}  ${words(all.slice(i, i + 16))}\n`)).join('')],
    ['JSON lines', 'lines.json', lines((bytes, i) => JSON.stringify({ type: 'frame', time_us: 9000 * i - 12345, channels: bytes.slice(0, 16) }))],
  ]) {
    await check(`${what} is read as the command reads it`, async (page) => {
      const file = path.join(build, name);
      await playToEnd(page, name, content);
      const shown = rows((await downloaded(page, '#csv')).text).map((row) => row.split(',').map(Number));
      const printed = execFileSync(process.env.SCOPE_SBUS, ['csv', file, '--every-frame', '--columns', 'time,ch1-ch16'], { stdio: ['ignore', 'pipe', 'ignore'] });
      const wanted = printed.toString().trim().split('\n').map((row) => row.split(',').map(Number));
      assert.equal(wanted.length, 3);
      assert.deepEqual(shown.map((row) => row.slice(1, 17)), wanted.map((row) => row.slice(1)));
      if (!Number.isNaN(wanted[0][0])) {
        assert.deepEqual(shown.map(([time]) => Math.round(time * 1e5)), wanted.map(([time]) => Math.round(time * 1e5)));
      }
    });
  }

  for (const [name, content, wire] of [
    ['early.csv', `Time [s],S\n${levels.map(([us, high]) => `${((us - 2020000) / 1e6).toFixed(6)},${high}\n`).join('')}`, /^[0-9A-F]{2} at -(2\.0|1\.9)\d{5} s/],
    ['early.txt', `# 100000 baud, 8E2, inverted\n${frames.map((bytes, i) => `${9000 * i - 2012345} ${words(bytes)}\n`).join('')}`, ''],
  ]) {
    await check(`times before the trigger are below 0 in the wire view and at the position: ${name}`, async (page) => {
      await playPaused(page, name, content);
      await seek(page, 15);
      await reads(page, '#position-text', /^-0:0(2\.0|1\.9)/);
      await reads(page, '#wire-text', wire);
    });
  }

  await check('bytes without 11 and 13 are named as sbus doctor names them', async (page) => {
    const lacking = frames.flatMap((bytes) => [...bytes, ...bytes.toSpliced(9, 1)]);
    await playToEnd(page, 'xon', Buffer.from([...lacking, ...lacking].map((byte) => (byte === 0x11 || byte === 0x13 ? 0x12 : byte))));
    await reads(page, '#verdict-text', 'Changed bytes: 11 and 13 are missing throughout, and frames are too short: they are taken for XON and XOFF.');
    await reads(page, '#verdict-remedy', 'Turn software flow control off in the program that wrote it.');
  });

  await check('a VCD that is cut within a line plays all whole ones, and says so', async (page) => {
    const text = forms.vcd(edges(readFileSync(path.join(root, 'test/recordings/paper.txt'), 'utf8'), 0));
    await playToEnd(page, 'half.vcd', text.slice(0, text.lastIndexOf('#') + 1));
    await reads(page, '#title', /, cut off within its last line: what was not whole is left out$/);
    await counts(page, 'frames', 5);
  });

  await check('the silence before the first frame of a capture and after the last one is a fault, which Next fault reaches', async (page) => {
    const text = edges(readFileSync(path.join(root, 'test/recordings/frsky-neutral.txt'), 'utf8'), 0).map(([us, high]) => [us + 700000, high]);
    await playToEnd(page, 'ends.vcd', `${forms.vcd([[0, 1 - text[0][1]], ...text])}#${text.at(-1)[0] + 900000}\n`);
    await reads(page, '#fault-counts', /no frames: 2 ×/);
    await reads(page, '#verdict-text', /^Signal lost/);
    await seek(page, 0);
    for (const at of [1, 2]) {
      await page.click('#fault-next');
      await reads(page, '#fault-text', new RegExp(`^Fault ${at} of 2: no frames, `));
    }
  });

  await check('a .gz that is cut off is rejected', async (page) => {
    await choose(page, 'cut.vcd.gz', gzipSync(forms.vcd([[0, 0], [10, 1]])).subarray(0, 40));
    await reads(page, '#notice-text', /^cut\.vcd\.gz cannot be read: [^.]*\.$/);
    await reads(page, '#state', 'Fine');
  });

  await check('of a capture with two receivers either can be shown', async (page) => {
    const texts = [1000, 300].map((ch1) => Array.from({ length: 300 }, (_, i) => recorded(10000 * (i + 1), frame([ch1 + (i % 2)]))).join(''));
    const all = texts.flatMap((text, at) => edges(text, 0).map(([us, high]) => [us, `${high}${'AB'[at]}`])).sort(([a], [b]) => a - b);
    await choose(page, 'two.vcd', `$timescale 1us $end\n$var wire 1 A first $end\n$var wire 1 B second $end\n$enddefinitions $end\n${all.map(([us, change]) => `#${us}\n${change}\n`).join('')}#3100000\n`);
    await reads(page, '#title', /^Capture two\.vcd, signal /);
    const names = () => page.$$eval('#wire-signal option', (options) => options.map(({ value }) => value));
    assert.deepEqual((await names()).sort(), ['first', 'second']);
    for (const [signal, value] of [['second', /^30[01]$/], ['first', /^100[01]$/]]) {
      await page.selectOption('#wire-signal', signal);
      await reads(page, '#title', new RegExp(`^Capture two\\.vcd, signal ${signal}`));
      await reads(page, '#bars li:nth-child(1) .raw', value);
      assert.equal(await page.inputValue('#wire-signal'), signal);
      assert.equal((await names()).length, 2);
    }
  });
}
