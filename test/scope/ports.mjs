// Ports: a fake navigator.serial brings real bytes, errors, and is unplugged.
import assert from 'node:assert/strict';
import { bytesOf, check, codes, connect, counter, counts, frame, lit, opensWith, raw, reads, until } from './support.mjs';

// Makes the port repeat `bytes`, a frame every 9 ms, whenever it is opened with this setting.
const brings = (page, bytes, baud = 100000, everyMs = 9, latencyMs = 16) =>
  page.evaluate(([frameBytes, wanted, ms, latency]) => {
    fake.port.onOpen = ({ baudRate }) => {
      clearInterval(fake.timer);
      fake.timer = baudRate === wanted ? fake.every(ms, frameBytes, latency) : undefined;
    };
  }, [bytes, baud, everyMs, latencyMs]);

const good = frame([1000]);
const rawOf = (channel) => `#bars li:nth-child(${channel}) .raw`;

export default async function () {
  await check("an adapter is opened with S.Bus's settings, and its frames are shown", async (page) => {
    await brings(page, frame([172, 992, 1811, 1000], { flags: 1 }));
    await connect(page);
    await reads(page, '#state', 'Fine');
    await raw(page, 1, '172');
    await reads(page, '#bars li:nth-child(1) .us', '988');
    await reads(page, '#bars li:nth-child(1) .percent', '-100.0');
    await reads(page, '#bars li:nth-child(3) .percent', '100.0');
    await lit(page, 'ch17');
    await reads(page, '#verdict-text', 'All well.');
    const [options] = await page.evaluate(() => fake.port.opened);
    assert.deepEqual(options, { baudRate: 100000, dataBits: 8, parity: 'even', stopBits: 2, bufferSize: 4096 });
  });

  for (const [sentence, begin, ...shown] of [
    ['the frames of an adapter that was set to 1 ms are shown', (page) => brings(page, frame([172, 992]), 100000, 9, 1),
      [rawOf(1), '172'], ['#verdict-text', 'All well.'], ['[data-counter="discardedBytes"]', '0']],
    ["the paper's frames are shown, though they come byte by byte",
      (page) => page.evaluate((bytes) => (fake.port.onOpen = () => bytes.forEach((byte) => fake.port.feed([byte]))), bytesOf('paper.txt')),
      ['[data-counter="frames"]', '6'], [rawOf(3), '1811'], [rawOf(1), '995']],
    ['a receiver in failsafe shows in the verdict and the indicators, with the values as received', (page) => brings(page, frame([992, 992, 172], { flags: 0x0c })),
      ['#state', 'Failsafe'], ['#indicator-failsafe .value', 'on'], ['#indicator-lost-frame .value', 'on'], ['#verdict-text', /^Failsafe/], [rawOf(3), '172']],
    ['200000 baud are found on Fast S.Bus', (page) => brings(page, frame([1300]), 200000),
      ['#verdict-note', /^Wrong baud rate: frames come only with the other baud rate\. The page has set it: 200000 baud/], [rawOf(1), '1300'], ['#state', 'Fine']],
    ['for bytes without frames, as with an inverter too many, the verdict is No frames, with the remedy',
      (page) => brings(page, [0xfe, 0x3c, 0x0a, 0x00, 0xf8, 0x0a, 0x41, 0x0a, 0x81, 0x7c]),
      ['#verdict-text', /^No frames: bytes come/], ['#verdict-remedy', /Is an inverter missing, or one too many/], ['#state', 'Never seen'],
      ['[data-counter="discardedBytes"]', /^[1-9]/]],
    ['for breaks only, as on an idle line of the wrong level, the verdict is No frames, not No signal',
      (page) => page.evaluate(() => (fake.port.onOpen = () => {
        clearInterval(fake.timer);
        fake.timer = setInterval(() => fake.port.fail('BreakError'), 20);
      })), ['#verdict-text', /^No frames/]],
    ['a port with frames with header 2F is decoded', (page) => brings(page, [...frame(Array.from({ length: 16 }, (_, i) => 1500 + i), { header: 0x2f }), ...frame([1100])], 100000, 18),
      [rawOf(32), '1515'], [rawOf(1), '1100']],
    ["a board's rows are recognised though the button for adapters was pressed", (page) => brings(page, codes('995,992,172,992,0,0\r\n'), 100000, 50),
      [rawOf(1), '995'], ['#verdict-text', 'Receiving rows from a board.']],
    ['a damaged frame among good ones is shown with its reason', (page) => opensWith(page, [good, good, good, [...good.slice(0, 5), ...good.slice(6)], good, good]),
      ['[data-counter="frames"]', '5'], ['[data-counter="discardedBytes"]', '24'], ['[data-counter="resyncs"]', '1'], ['#lines .none .why', /no end byte|incomplete/]],
  ]) {
    await check(sentence, async (page) => {
      await begin(page);
      await connect(page);
      for (const [where, text] of shown) await reads(page, where, text);
    });
  }

  await check('parity, framing, overrun and system errors and breaks are counted by cause, and frames continue', async (page) => {
    await brings(page, frame([1200]));
    await connect(page);
    await reads(page, '#state', 'Fine');
    for (const name of ['ParityError', 'FramingError', 'BreakError', 'BufferOverrunError', 'UnknownError', 'ParityError']) {
      await until('the port is not read', () => page.evaluate(() => fake.port.isLocked)); // after the one before
      await page.evaluate((error) => fake.port.fail(error), name);
    }
    await counts(page, 'port parity errors', 2);
    await counts(page, 'port framing errors', 1);
    await counts(page, 'port breaks', 1);
    await counts(page, 'port overruns', 1);
    await counts(page, 'port system errors', 1);
    await counts(page, 'characterErrors', 6);
    const before = await counter(page, 'frames');
    await until('no more frames come', async () => (await counter(page, 'frames')) > before + 10);
    await reads(page, '#state', 'Fine');
    assert.equal((await page.evaluate(() => fake.port.opened)).length, 1);
  });

  for (const bound of [true, false]) {
    await check(`unplugged, as ${bound ? 'a read' : 'the browser'} finds out: the page says so, and continues by itself once it is plugged in; both are counted`, async (page) => {
      await brings(page, frame([1200]));
      await connect(page);
      await reads(page, '#state', 'Fine');
      await page.evaluate((still) => fake.port.unplug({ bound: still }), bound);
      await reads(page, '#verdict-text', 'The port is gone.');
      await reads(page, '#title', 'Serial adapter, 100000 baud, 8E2, FTDI FT232 (0403:6001) (opening again)');
      await reads(page, '#state', 'Stale');
      await page.waitForTimeout(1500); // the page has tried it again; the browser says only that it cannot be opened
      await reads(page, '#verdict-text', 'The port is gone.');
      await page.evaluate(() => fake.port.plug());
      await reads(page, '#state', 'Fine');
      await counts(page, 'port unplugged', 1);
      await counts(page, 'port reopened', 1);
      await reads(page, '#verdict-text', 'All well.');
    });
  }

  await check('unplugged while it opens: the page says so, and continues when the port is there again', async (page) => {
    await brings(page, frame([1200]));
    await page.evaluate(() => (fake.port.openMs = 1300));
    await page.click('#source-adapter');
    await until('it is not opened', () => page.evaluate(() => fake.port.isOpen));
    await page.evaluate(() => fake.port.unplug());
    await reads(page, '#verdict-text', 'The port is gone.');
    await page.evaluate(() => fake.port.plug());
    await reads(page, '#state', 'Fine');
  });

  await check('for a busy port the page says what may have it open; once it is free, it is opened', async (page) => {
    await brings(page, frame([1200]));
    await page.evaluate(() => (fake.port.busy = true));
    await page.click('#source-adapter');
    await reads(page, '#verdict-text', 'The port cannot be opened.');
    await reads(page, '#verdict-remedy', /^Close the program/);
    await reads(page, '#title', 'Serial adapter, 100000 baud, 8E2, FTDI FT232 (0403:6001) (not open)');
    await page.evaluate(() => (fake.port.busy = false));
    await reads(page, '#state', 'Fine');
    await reads(page, '#title', 'Serial adapter, 100000 baud, 8E2, FTDI FT232 (0403:6001)');
  });

  await check('while a port takes 1.3 s to open nothing is tried, and then each baud rate is listened to for the same time', async (page) => {
    await brings(page, frame([1300]), 200000);
    await page.evaluate(() => (fake.port.openMs = 1300));
    await connect(page);
    await reads(page, '#verdict-text', 'Listening.');
    await reads(page, '#verdict-note', /^Wrong baud rate: .* The page has set it: 200000 baud/);
    await reads(page, '#state', 'Fine');
    const opened = await page.evaluate(() => fake.port.opened.map(({ baudRate }) => baudRate));
    assert.deepEqual(opened, [100000, 200000]);
  });

  await check('another source chosen while a port opens, and then that port again: the page shows the last one, and never hangs', async (page) => {
    await brings(page, frame([1200]));
    await page.evaluate(() => (fake.port.openMs = 1300));
    await page.click('#source-adapter');
    await until('it is not opened', () => page.evaluate(() => fake.port.isOpen));
    await reads(page, '#title', 'Serial adapter, 100000 baud, 8E2, FTDI FT232 (0403:6001) (opening)');
    await page.click('#source-simulated');
    await reads(page, '#title', /^Simulated/);
    await reads(page, '#state', 'Fine');
    await until('the port stays open', async () => !(await page.evaluate(() => fake.port.isOpen)));
    await page.click('#source-adapter');
    await until('it is not opened', () => page.evaluate(() => fake.port.isOpen));
    await page.click('#source-board');
    await page.click('#source-adapter');
    await reads(page, '#title', /^Serial adapter/);
    await raw(page, 1, '1200');
    await reads(page, '#state', 'Fine');
    assert.equal(await page.getAttribute('#source-adapter', 'aria-pressed'), 'true');
  });

  // The running source continues unchanged: its history, its recording, its frames.
  async function untouched(page, act) {
    await page.click('#record');
    await until('no frames come', async () => (await counter(page, 'frames')) > 30);
    const before = await counter(page, 'frames');
    await act();
    assert.ok((await counter(page, 'frames')) >= before);
    assert.equal(await page.getAttribute('#record', 'aria-pressed'), 'true');
    assert.equal(await page.getAttribute('#source-simulated', 'aria-pressed'), 'true');
    await reads(page, '#title', /^Simulated/);
    await reads(page, '#verdict-text', 'Simulation.');
  }

  await check('if no port is chosen, a notice says so, and the simulation, its recording and its verdict continue', async (page) => {
    await untouched(page, async () => {
      await page.evaluate(() => (fake.choose = () => new Promise((resolve) => (fake.choice = resolve))));
      await page.click('#source-adapter');
      await reads(page, '#title', /^Simulated .* \(until the next one is ready\)$/);
      await page.evaluate(() => fake.choice());
      await reads(page, '#notice-text', 'No port was chosen.');
      await reads(page, '#notice-remedy', /^Plug the adapter in/);
      await reads(page, '#title', /^Simulated [^(]*$/);
    });
    await page.click('#notice-close');
    await page.waitForSelector('#notice', { state: 'hidden' });
  });

  await check('if a file cannot be read, a notice says so, and the simulation, its recording and its verdict continue', (page) =>
    untouched(page, async () => {
      await page.setInputFiles('#file', { name: 'x.txt', mimeType: 'text/plain', buffer: Buffer.from('120 0F\n240 XY\n') });
      await reads(page, '#notice-text', /^In line 2 of x\.txt, /);
    }));

  await check('a notice fades by itself', async (page) => {
    await page.evaluate(() => (fake.choose = () => undefined));
    await page.click('#source-adapter');
    await reads(page, '#notice-text', 'No port was chosen.');
    await page.hover('#notice-text');
    const fading = () => page.evaluate(() => document.querySelector('#notice').getAnimations().map((each) => each.effect.getTiming().duration));
    assert.deepEqual(await fading(), []); // it is read
    await page.mouse.move(5, 5);
    assert.deepEqual(await fading(), [20000]);
    await page.evaluate(() => document.querySelector('#notice').getAnimations()[0].finish());
    await page.waitForSelector('#notice', { state: 'hidden' });
  });

  await check('if the browser offers no port, the notice has its message', async (page) => {
    await page.evaluate(() => (navigator.serial.requestPort = () => Promise.reject(new DOMException('Blocked by the user.', 'SecurityError'))));
    await page.click('#source-adapter');
    await reads(page, '#notice-text', 'The browser offers no port: Blocked by the user.');
    await reads(page, '#state', 'Fine');
  });

  await check('without Web Serial the page says which browser has it, and the simulation continues', async (page) => {
    await page.click('#source-adapter');
    await reads(page, '#notice-text', 'This browser has no Web Serial.');
    await reads(page, '#notice-remedy', /Chrome, Edge or Firefox/);
    await reads(page, '#state', 'Fine');
  }, { serial: false });

  await check('without bytes both baud rates are tried, and the verdict is No signal', async (page) => {
    await connect(page);
    await reads(page, '#verdict-text', 'No signal: not a byte with any setting.');
    const opened = () => page.evaluate(() => String(fake.port.opened.map(({ baudRate }) => baudRate)));
    await until('it is not opened again', async () => (await opened()).startsWith('100000,200000,100000'));
  });

  // A row, how many of its numbers are channels, some of them, and the indicators that it lights, of two.
  for (const [row, count, channels, indicators = []] of [
    ['832,626,1811,866', 4, { 1: '832', 4: '866' }],
    ['1000,626,172,866,1,0', 4, { 1: '1000', 3: '172' }, ['failsafe']],
    ['1000,626,172,866,0,1', 4, { 1: '1000', 3: '172' }, ['lost-frame']],
    ['1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,1,1', 16, { 1: '1', 16: '16' }, ['ch17', 'ch18']],
    [Array.from({ length: 24 }, (_, i) => 100 + i).join(','), 24, { 1: '100', 24: '123' }],
    ['0.732,0.469,-0.599,-0.043', 4, { 1: '0.732', 3: '-0.599' }],
    ['throttle:172,roll:992', 2, { 1: '172', 2: '992' }],
  ]) {
    await check(`a board that prints ${row.slice(0, 24)}... is recognised, and has ${count} channels`, async (page) => {
      await brings(page, codes(`${row}\r\n`), 115200, 100);
      await connect(page, 'board');
      for (const [channel, value] of Object.entries(channels)) await raw(page, channel, value);
      for (const indicator of indicators) await lit(page, indicator);
      await reads(page, '#verdict-text', indicators.includes('failsafe') ? /^Failsafe/ : 'Receiving rows from a board.');
      assert.equal(await page.locator('.indicator:visible').count(), indicators.length > 0 ? 2 : 0);
      assert.equal(await page.locator('.indicator[data-on="true"]').count(), indicators.length);
      assert.equal(await page.locator('#bars li:visible').count(), count);
      assert.equal(await page.locator('#lines li:visible').count(), 0);
      await until('text is counted as discarded bytes', async () => !(await page.isVisible('[data-counter="discardedBytes"]')));
      assert.deepEqual((await page.evaluate(() => fake.port.opened))[0], { baudRate: 115200, bufferSize: 4096 });
    });
  }

  await check("the unit of a board's numbers is asked for, not guessed", async (page) => {
    await brings(page, codes('1500,-0.5,988,12\r\n'), 115200, 100);
    await connect(page, 'board');
    await reads(page, '#bars li:nth-child(2) .raw', '-0.5');
    await reads(page, '#bars li:nth-child(1) .us', '–');
    await reads(page, '#bars li:nth-child(1) .percent', '–');
    await page.waitForSelector('#bars li:nth-child(1) .track[aria-valuemax="2000"]');
    await page.selectOption('#unit', 'raw');
    await reads(page, '#bars li:nth-child(1) .us', '1818');
    await page.waitForSelector('#bars li:nth-child(1) .track[aria-valuemax="2047"]');
    await page.selectOption('#unit', 'us');
    await reads(page, '#bars li:nth-child(1) .us', '–');
    await page.waitForSelector('#bars li:nth-child(1) .track[aria-valuemax="2140"]');
    await page.click('#source-simulated');
    await page.waitForSelector('#rows', { state: 'hidden' });
    await reads(page, '#bars li:nth-child(7) .us', '1500');
  });

  await check("Noise is never beside a link that is fine, and another protocol's title and guide say nothing of S.Bus", async (page) => {
    const damaged = frame([1000]).toSpliced(7, 1);
    await page.evaluate(([bytes]) => (fake.port.onOpen = () => (fake.timer = fake.every(45, bytes))), [[...Array(4).fill(frame([1000])).flat(), ...damaged]]);
    await connect(page);
    await reads(page, '#verdict-text', /^Noise/);
    await reads(page, '#state', 'Frames come');
    await page.evaluate(() => clearInterval(fake.timer));
    const crsf = 'C8 18 16 E0 03 DF F7 C0 C7 0A F0 81 0F 7C E0 03 1F F8 C0 07 3E F0 81 0F 7C 41'.split(' ').map((word) => parseInt(word, 16));
    await page.click('#source-simulated');
    await page.evaluate((bytes) => (fake.port.onOpen = () => (fake.timer ??= fake.every(9, bytes))), crsf);
    await page.evaluate(() => (fake.timer = undefined));
    await connect(page);
    await reads(page, '#verdict-text', /^Not S\.Bus: the receiver sends CRSF/);
    assert.match(await page.textContent('#title'), /^Serial adapter, \d+ baud, 8E2/);
    assert.ok(await page.locator('#guide').isHidden());
  });

  await check("an S.BUS2 line and neutral channels tell the scale, which the page suggests; rounded to 0 % there is no -0 %", async (page) => {
    await opensWith(page, [1, 2, 3].map(() => frame(Array(16).fill(1024), { end: 0x04 })));
    await connect(page);
    await reads(page, '#scale-hint-text', "The line looks like a Futaba's: neutral is 1024.");
    await page.click('#scale-use');
    await reads(page, '#bars li:nth-child(5) .percent', '0.0');
    assert.ok(await page.locator('#scale-hint').isHidden());
    await page.click('#source-simulated');
    await reads(page, '#scale-use', "Use FrSky's range");
    await page.click('#scale-use');
    await page.click('#source-adapter');
    await page.evaluate((bytes) => fake.every(9, bytes), frame([991, 991, 992, 991]));
    await reads(page, '#sticks', /aileron 0 %/);
  });

  await check('with the wrong baud rate for a board, the page says what to choose, and then reads it', async (page) => {
    await page.evaluate((row) => {
      fake.port.onOpen = ({ baudRate }) => {
        clearInterval(fake.timer);
        fake.timer = fake.every(100, baudRate === 9600 ? row : [0xfe, 0x80, 0x1e, 0x06, 0xf8, 0x41, 0x9f]);
      };
    }, codes('832,626,1811,866\r\n'));
    await connect(page, 'board');
    await reads(page, '#verdict-text', 'Bytes come, but no rows.');
    await reads(page, '#verdict-remedy', /^Choose the baud rate/);
    await page.selectOption('#baud', '9600');
    await reads(page, '#bars li:nth-child(1) .raw', '832');
    await reads(page, '#title', 'A board that prints numbers, 9600 baud, FTDI FT232 (0403:6001)');
    await reads(page, '#verdict-text', 'Receiving rows from a board.');
    assert.deepEqual(await page.evaluate(() => fake.port.opened.map(({ baudRate }) => baudRate)), [115200, 9600]);
  });

  await check('a slow sketch is not stale before its first row, nor between its rows', async (page) => {
    await connect(page, 'board');
    await page.evaluate(() => fake.skip(3000));
    await page.waitForTimeout(1500);
    await reads(page, '#verdict-text', 'Waiting for rows.');
    await reads(page, '#state', 'Never seen');
    for (let i = 0; i < 4; i++) {
      await page.evaluate((row) => fake.port.feed(row), codes('995,992,172,992,0,0\r\n'));
      await counts(page, 'rows', i);
      await page.evaluate(() => fake.skip(4000));
    }
    await page.waitForTimeout(300);
    await reads(page, '#state', 'Fine');
    await reads(page, '#verdict-text', 'Receiving rows from a board.');
    await page.evaluate(() => fake.skip(9000));
    await reads(page, '#state', 'Stale');
  });

  await check('a board that falls silent is stale; a board that prints text is not taken for one that prints rows', async (page) => {
    await brings(page, codes('995,992,172,992,0,0\r\n'), 115200, 50);
    await connect(page, 'board');
    await reads(page, '#state', 'Fine');
    await page.waitForSelector('#bars li:nth-child(1) .track[title="CH1: lowest 995, highest 995"]');
    await page.evaluate(() => clearInterval(fake.timer));
    await reads(page, '#state', 'Stale');
    await reads(page, '#verdict-text', /^No rows/);
    await brings(page, codes('begin(100000): 0 frames, 0 bytes\r\n'), 115200, 50);
    await page.click('#source-simulated');
    await connect(page, 'board');
    await reads(page, '#verdict-text', /^Text comes, but no rows/);
  });

  await check('S.BUS2 with two sensors after each frame brings every frame after the first dozen', async (page) => {
    const ids = [[0x03, 0x83], [0x13, 0x93], [0x0b, 0x8b], [0x1b, 0x9b]];
    const group = ids.flatMap(([first, second], i) => [
      ...frame([1100 + i], { end: 0x04 + 0x10 * i }), first, 0xc0, 0x2e, second, 0x12, 0x34]);
    await brings(page, group, 100000, 60);
    await connect(page);
    await until('100 frames come', async () => (await counter(page, 'frames')) > 100);
    await reads(page, '#verdict-text', /^All well/);
    await page.evaluate(() => clearInterval(fake.timer));
    const sent = Math.floor((await page.evaluate(() => fake.sent)) / 31);
    await until(async () => `${await counter(page, 'frames')} frames, of ${sent}`, async () => (await counter(page, 'frames')) >= sent - 12);
    await counts(page, 'resyncs', /^0?$/);
  });
}
