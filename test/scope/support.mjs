// What the tests share: the browser, a page in it, and the bytes of frames.
import { createRequire } from 'node:module';
import { readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath, pathToFileURL } from 'node:url';
import path from 'node:path';
import assert from 'node:assert/strict';

const here = path.dirname(fileURLToPath(import.meta.url));
export const root = path.resolve(here, '../..');
export const build = process.env.SCOPE_BUILD ?? path.join(root, 'build/scope');
const require = createRequire(path.join(build, 'npm/package.json'));
const { chromium } = require('playwright-core');
export const axe = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');

const launch = {
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync', '--js-flags=--expose-gc'],
};
export const browser = await chromium.launch(launch);

let failed = 0;

// A page that hangs answers nothing, not even Playwright.
const tooLong = (ms) => new Promise((_, reject) => setTimeout(() => reject(new Error('it hangs')), ms).unref());

// One check: a sentence, and what shows it. It gets a page as new, if it asks for one. ONLY=words runs those whose sentence has them.
export async function check(sentence, show, { patience = 60000, ...options } = {}) {
  if (!sentence.includes(process.env.ONLY ?? '')) {
    return;
  }
  let tab;
  try {
    tab = show.length > 0 ? await open(options) : undefined;
    await Promise.race([show(tab?.page), tooLong(patience)]);
    await tab?.clean();
    assert.deepEqual(tab?.page.complaints ?? [], []);
    console.log(`ok scope: ${sentence}`);
  } catch (error) {
    failed++;
    await tab?.close();
    console.log(`FAILED scope: ${sentence}\n${String(error?.stack ?? error).slice(0, 1500)}`);
  }
}

export async function finish() {
  await browser.close();
  process.exit(failed > 0 ? 1 : 0);
}

// What of a page is gone with its document, or by clean(). On a page of which a check has used anything else, no other check runs.
const passing = new Set(['$$eval', '$eval', 'addInitScript', 'check', 'click', 'complaints', 'evaluate', 'fill', 'focus', 'getAttribute', 'hover',
  'inputValue', 'isVisible', 'keyboard', 'locator', 'mouse', 'reload', 'selectOption', 'setInputFiles', 'tap', 'textContent', 'then', 'uncheck',
  'waitForEvent', 'waitForSelector', 'waitForTimeout', 'workers']);

// A browser's tab. A new one, with a storage and a process of its own, costs five times what its page costs: checks have it one after
// the other, and each finds it as new.
class Tab {
  static kept = new Map(); // by what only a new one can be given
  used = false;
  scripts = [];

  static async for(options) {
    const name = JSON.stringify(options);
    const tab = Tab.kept.get(name) ?? (await new Tab().open(options));
    Tab.kept.delete(name);
    tab.name = name;
    return tab;
  }

  async open(options) {
    this.context = await browser.newContext({ acceptDownloads: true, ...options });
    this.real = await this.context.newPage();
    this.session = await this.context.newCDPSession(this.real);
    const { real } = this;
    real.setDefaultTimeout(20000);
    real.on('pageerror', (error) => real.complaints.push(error.message));
    real.on('console', (message) => ['error', 'warning'].includes(message.type()) && real.complaints.push(message.text()));
    real.on('request', (request) => /^(file|blob|data|about):/.test(request.url()) || real.complaints.push(request.url()));
    this.page = new Proxy(real, {
      get: (_, name) => {
        this.used ||= !passing.has(name);
        const owner = name === 'addInitScript' ? this : real;
        return typeof owner[name] === 'function' ? owner[name].bind(owner) : owner[name];
      },
    });
    return this;
  }

  async addInitScript(...script) {
    this.scripts.push(await this.real.addInitScript(...script));
  }

  // The document and all that it does end, and what it has kept. A key that is held is let go.
  async clean() {
    if (this.used) {
      return this.close();
    }
    await this.real.goto('about:blank');
    await Promise.all(this.scripts.splice(0).map((script) => script.dispose()));
    await this.session.send('Storage.clearDataForOrigin', { origin: 'file://', storageTypes: 'all' });
    for (const key of ['Shift', 'Control', 'Alt', 'Meta']) await this.real.keyboard.up(key);
    await this.real.mouse.up();
    await this.real.mouse.move(-1, -1);
    Tab.kept.set(this.name, this);
  }

  close() {
    Tab.kept.delete(this.name);
    return Promise.race([this.context.close(), new Promise((resolve) => setTimeout(resolve, 5000).unref())]);
  }
}

// The page, as it stands in its file, with a fake navigator.serial. It must not complain, nor ask the network for anything.
async function open({ size = { width: 1440, height: 900 }, serial = true, colorScheme = 'light', forcedColors = 'none', ...others }) {
  const tab = await Tab.for(others);
  tab.real.complaints = [];
  await tab.real.setViewportSize(size);
  await tab.real.emulateMedia({ colorScheme, forcedColors });
  if (serial) {
    await tab.addInitScript({ path: path.join(here, 'fakeSerial.js') });
    await tab.addInitScript({ path: path.join(here, 'fakePage.js') });
  } else {
    await tab.addInitScript(() => Object.defineProperty(Navigator.prototype, 'serial', { get: () => undefined }));
  }
  await tab.real.goto(pathToFileURL(path.join(build, 'index.html')).href);
  await begun(tab.real);
  return tab;
}

// Before its first picture the page takes no clicks and no files: its WebAssembly comes after it has been loaded.
const begun = (page) => until('the page does not begin', () => page.evaluate(() => ['#title', '#verdict-text'].some((where) => document.querySelector(where).textContent !== '')));

// Waits until that is so. (Not by Playwright's waitForFunction(), which the page's policy rejects.)
export async function until(what, isSo, patience = 20000) {
  const end = Date.now() + patience;
  while (!(await isSo())) {
    assert.ok(Date.now() < end, typeof what === 'string' ? what : await what());
    await new Promise((resolve) => setTimeout(resolve, 30));
  }
}

// Waits until the page has drawn what it shows now: words are there before the curves.
export const drawn = (page) => page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => resolve()))));

// Waits until the element's text is such.
export async function reads(page, selector, expected) {
  const text = () => page.evaluate((where) => document.querySelector(where)?.textContent ?? '', selector);
  await until(async () => `${selector} reads "${await text()}", not ${expected}`,
    async () => (expected instanceof RegExp ? expected.test(await text()) : expected === (await text())));
}

export const counter = (page, name) => page.textContent(`[data-counter="${name}"]`).then((text) => Number(text.replace(/\D/g, '')));
export const counts = (page, name, value) => reads(page, `[data-counter="${name}"]`, typeof value === 'number' ? String(value) : value);
export const raw = (page, channel, value) => reads(page, `#bars li:nth-child(${channel}) .raw`, value);
export const lit = (page, indicator) => page.waitForSelector(`#indicator-${indicator}[data-on="true"]`);

// The port brings these frames as soon as it is open. Without any for a second, the page tries another baud rate, and what a test on
// a busy PC feeds is lost.
export const opensWith = (page, frames) =>
  page.evaluate((bytes) => (fake.port.onOpen = () => fake.port.feed(bytes)), frames.flat());

// Opens the page again, with a port that its workers also have, as in Chromium: it is theirs, and goes on while the page is busy.
// `act` runs in each worker.
export async function inWorkers(page, act, argument) {
  const text = `${readFileSync(path.join(here, 'fakeSerial.js'), 'utf8')}\nfake.port.permitted = true;\n(${act})(${JSON.stringify(argument)});\n`;
  await page.addInitScript((fakeOfWorkers) => Object.assign(globalThis, { fakeOfWorkers }), text);
  await page.reload();
  await begun(page);
}

// Until the page shows the port, which is read.
export async function connect(page, kind = 'adapter') {
  await page.click(`#source-${kind}`);
  await page.waitForSelector(`#source-${kind}[aria-pressed="true"]`);
  await until('the port is not read', () => page.evaluate(() => fake.port.isLocked));
}

// Plays a file of the disk, or a text as a file of that name.
export async function play(page, file, text) {
  const running = /^(Recording|Capture)/.test(await page.textContent('#title')) ? page.workers().at(-1) : undefined;
  const whole = text === undefined ? file : path.join(build, file);
  if (text !== undefined) {
    writeFileSync(whole, text);
  }
  await page.setInputFiles('#file', whole);
  await until('the recording before it goes on', () => !running || !page.workers().includes(running));
  await reads(page, '#title', new RegExp(`^(Recording|Capture) ${path.basename(file)}(, [^(]*)?$`));
}

// A short one may have ended by then: Play would begin it again.
export async function playPaused(page, ...file) {
  await play(page, ...file);
  await page.evaluate(() => {
    const button = document.querySelector('#play');
    if (button.textContent === 'Pause') {
      button.click();
    }
  });
}

export async function playToEnd(page, ...file) {
  await play(page, ...file);
  await toEnd(page);
}

// To this time in the recording.
export const seek = (page, ms) => page.evaluate((to) => {
  const position = document.querySelector('#position');
  position.value = to;
  position.dispatchEvent(new Event('input'));
}, ms);

// To the recording's end.
export async function toEnd(page) {
  await seek(page, 1e9);
  await reads(page, '#play', 'Play');
}

// A recording whose channels rise and fall by its frame's number, played to its end.
export const ramp = {
  count: 400,
  lengthS: 4.003,
  timeS: (i) => 0.01 * (i + 1) + 0.00288, // of its last byte
  channels: (i) => [500 + i, 1500 - 2 * i, 992, i % 2 === 0 ? 172 : 1811],
};
export async function playRamp(page) {
  const file = path.join(build, 'ramp.txt');
  const hex = (i) => frame(ramp.channels(i)).map((byte) => byte.toString(16).padStart(2, '0')).join(' ');
  writeFileSync(file, Array.from({ length: ramp.count }, (_, i) => `${10000 * (i + 1)} ${hex(i)}\n`).join(''));
  await play(page, file);
  await toEnd(page);
  await counts(page, 'frames', ramp.count);
}
// Where its frame number i is on the curves, while they show its end.
export async function placeOf(page, i) {
  await drawn(page);
  const box = await page.locator('#plot .u-over').boundingBox();
  const seconds = parseFloat(await page.textContent('#window'));
  return [box.x + box.width * (1 - (ramp.lengthS - ramp.timeS(i)) / seconds), box.y + box.height / 2];
}

export async function downloaded(page, selector) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.click(selector)]);
  return { name: download.suggestedFilename(), text: readFileSync(await download.path(), 'utf8'), path: await download.path() };
}

// Fingers, by the debugger's protocol.
export async function fingers(page) {
  const session = await page.context().newCDPSession(page);
  const send = (type, ...points) => session.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  return { put: (...points) => send('touchStart', ...points), move: (...points) => send('touchMove', ...points), lift: () => send('touchEnd') };
}

// The 25 bytes of a frame: bit k of channel c is bit 11c+k of the payload.
export function frame(channels, { flags = 0, end = 0, header = 0x0f } = {}) {
  const bytes = new Array(25).fill(0);
  bytes[0] = header;
  for (let channel = 0; channel < 16; channel++) {
    for (let bit = 0; bit < 11; bit++) {
      const at = 11 * channel + bit;
      bytes[1 + (at >> 3)] |= (((channels[channel] ?? 992) >> bit) & 1) << (at & 7);
    }
  }
  bytes[23] = flags;
  bytes[24] = end;
  return bytes;
}

// The line of a recording that holds these bytes.
export const recorded = (us, bytes) => `${us} ${bytes.map((byte) => byte.toString(16).padStart(2, '0')).join(' ')}\n`;

// The bytes of a text.
export const codes = (text) => [...text].map((letter) => letter.charCodeAt(0));

export const bytesOf = (recording) =>
  readFileSync(path.join(root, 'test/recordings', recording), 'utf8').split('\n')
    .filter((line) => /^\d/.test(line))
    .flatMap((line) => line.trim().split(/\s+/).slice(1).map((word) => parseInt(word, 16)));
