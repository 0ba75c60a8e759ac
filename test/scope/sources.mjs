// The page's own sources (extras/scope/src/source) at random clicks, on fake ports that do anything meanwhile, and on a clock
// that the test turns. No browser.
//   node sources.mjs [SEED [COUNT]]
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import vm from 'node:vm';
import { load, random } from './modules.mjs';

const here = path.dirname(fileURLToPath(import.meta.url));
const [firstSeed = 20181, seeds = 400] = process.argv.slice(2).map(Number);
const clicks = 24; // for each seed

// The clock: timers fire in order, and all promises are settled before the next one.
const settled = () => new Promise((resolve) => setImmediate(resolve));
let now = 0;
let order = 0;
let timers = [];
globalThis.setTimeout = (call, ms = 0) => {
  const timer = { at: now + Math.max(ms, 0), order: order++, call };
  timers.push(timer);
  return timer;
};
globalThis.clearTimeout = (timer) => (timers = timers.filter((each) => each !== timer));
globalThis.performance.now = () => now;
async function turnTo(end) {
  await settled();
  for (;;) {
    const next = timers.filter(({ at }) => at <= end).sort((a, b) => a.at - b.at || a.order - b.order)[0];
    if (!next) break;
    clearTimeout(next);
    now = next.at;
    next.call();
    await settled();
  }
  now = end;
}
const later = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

vm.runInThisContext(readFileSync(path.join(here, 'fakeSerial.js'), 'utf8'));
Object.defineProperty(globalThis, 'navigator', { value: { serial: fake.serial }, configurable: true });

const { Choice } = await load('source/choice');
const { PortFeed } = await load('worker/portFeed');
const { pickPort } = await load('source/device');

// One visit to the page: what was chosen when, and what came.
class Visit {
  heard = new Map(); // bytes, by source
  decided = []; // { name, at, end }: a source that was chosen at `at`, and could be there at `end`
  ports = [0, 1].map(() => fake.newPort());
  all = this.ports.map((port) => this.watched(port)); // also those that were plugged in again
  asked = 0;
  used = 0;

  constructor(seed) {
    this.random = random(seed);
    this.choice = new Choice(() => undefined, () => undefined);
  }

  // A port must not be opened while it is open, nor for a source that was left.
  watched(port) {
    const open = port.open;
    port.open = (options) => {
      this.wrong ??= this.choice.current?.port === port ? undefined : 'opened, and no source has it';
      return open.call(port, options).catch((error) => {
        this.wrong ??= error.name === 'InvalidStateError' ? error : undefined;
        throw error;
      });
    };
    return port;
  }

  upTo(most) {
    return Math.floor(this.random() * (most + 1));
  }

  one(list) {
    return list[this.upTo(list.length - 1)];
  }

  source(name, make = () => ({ state: 'open', close() {} })) {
    return () => Object.assign(make(name), { name });
  }

  simulate(name) {
    this.decided.push({ name, at: now, end: now });
    void this.choice.change(async () => this.source(name));
  }

  async drop(name) {
    const ms = this.random() * 3000;
    const good = this.random() < 0.6;
    const decided = { name: good ? name : undefined, at: now, end: now + ms };
    this.decided.push(decided);
    try {
      await this.choice.change(async () => {
        await later(ms);
        if (!good) throw new Error('no recording');
        return this.source(name);
      });
    } catch (error) {
      assert.equal(error.message, 'no recording');
      assert.equal(this.decided.at(-1), decided, 'a notice for a file that is no longer awaited');
    }
  }

  async connect(name) {
    fake.choose = async () => {
      await later(this.upTo(2000));
      return this.random() < 0.3 ? undefined : this.one(this.ports.filter((port) => !port.gone)); // it lists no other
    };
    const asked = ++this.asked;
    try {
      const port = await this.choice.ask(() => pickPort('adapter'));
      if (port) {
        this.decided.push({ name, at: now, end: now });
        await this.choice.change(async () => this.source(name, () => this.portSource(name, port)));
      }
    } catch ({ text }) {
      assert.equal(text, 'No port was chosen.');
      assert.equal(this.asked, asked, 'a chooser that has gone is complained of');
    }
  }

  portSource(name, port) {
    const core = {
      openPort() {},
      receivedBad: () => assert.equal(this.choice.current.name, name, 'an error of a source that was left'),
      received: (bytes) => {
        assert.equal(this.choice.current.name, name, 'bytes of a source that was left');
        this.heard.set(name, (this.heard.get(name) ?? 0) + bytes.length);
      },
    };
    return new PortFeed(core, port, false, 0);
  }

  // The doctor tries another baud rate.
  async use(source, setting) {
    const used = ++this.used;
    await source.use(setting);
    if (used === this.used && source.state === 'open') {
      assert.equal(source.port.opened.at(-1).baudRate, setting.baud, 'the port is open otherwise');
    }
  }

  // Does what ports do by themselves.
  mishap() {
    const i = this.upTo(this.ports.length - 1);
    const port = this.ports[i];
    const { current } = this.choice;
    [
      () => (port.busy = !port.busy),
      () => !port.gone && port.unplug({ bound: this.random() < 0.5 }),
      () => port.gone && this.plug(i),
      () => port.fail(this.one(['ParityError', 'FramingError', 'BreakError', 'BufferOverrunError', 'UnknownError'])),
      () => port.feed(new Array(62).fill(0x0f)),
      () => current instanceof PortFeed && this.use(current, this.one(current.settings)),
    ][this.upTo(5)]();
  }

  plug(i) {
    this.ports[i] = this.ports[i].plug();
    this.all.push(this.watched(this.ports[i]));
  }

  async play() {
    for (let click = 0; click < clicks; click++) {
      for (const port of this.ports) {
        [port.openMs, port.closeMs] = [this.upTo(1300), this.upTo(50)];
      }
      const act = this.one(['simulate', 'drop', 'connect', 'connect', 'mishap', 'mishap', 'mishap']);
      void this[act](`${act} ${click}`);
      await turnTo(now + this.one([0, 0, 10, 100, 1000, 5000]));
    }
  }

  // Plugs everything in, and clicks nothing for ten seconds.
  async rest() {
    this.ports.forEach((port, i) => {
      port.busy = false;
      if (port.gone) this.plug(i);
    });
    await turnTo(now + 10000);
  }

  // Returns the last source that was open before another one was chosen.
  get expected() {
    return this.decided.filter(({ name, end }, i) => name && (i + 1 === this.decided.length || this.decided[i + 1].at >= end)).at(-1)?.name;
  }

  async judge() {
    const { current } = this.choice;
    assert.equal(this.wrong, undefined);
    assert.equal(current?.name, this.expected, 'another source was chosen last');
    assert.equal(this.choice.state, current ? 'open' : 'closed');
    const held = this.all.filter((port) => port.isOpen || port.isLocked);
    assert.equal(held.length, current instanceof PortFeed ? 1 : 0, 'ports are open');
    if (current instanceof PortFeed) {
      const before = this.heard.get(current.name) ?? 0;
      held[0].feed([1, 2, 3]);
      await settled();
      assert.equal(this.heard.get(current.name), before + 3, 'it does not read');
    }
    return current instanceof PortFeed;
  }

  async leave() {
    const { current } = this.choice;
    current?.close();
    void current?.use?.(current.settings[1]);
    await turnTo(now + 5000);
    assert.ok(this.all.every((port) => !port.isOpen && !port.isLocked), 'a port stays open');
  }
}

const sentence = `${seeds * clicks} random clicks from seed ${firstSeed} on: never stuck, always the source that was chosen last, no port left open`;
process.on('unhandledRejection', (error) => {
  console.log(`FAILED scope: ${sentence}: not caught: ${error?.stack ?? JSON.stringify(error)}`);
  process.exit(1);
});
let onPorts = 0;
for (let seed = firstSeed; seed < firstSeed + seeds; seed++) {
  const visit = new Visit(seed);
  try {
    await visit.play();
    await visit.rest();
    onPorts += await visit.judge();
    await visit.leave();
  } catch (error) {
    console.log(`FAILED scope: ${sentence}\n   seed ${seed}: ${error.stack}`);
    process.exit(1);
  }
}
assert.ok(onPorts > seeds / 4, `${onPorts} of ${seeds} visits ended at a port`);
console.log(`ok scope: ${sentence}; ${onPorts} of ${seeds} visits ended at a port`);
process.exit();
