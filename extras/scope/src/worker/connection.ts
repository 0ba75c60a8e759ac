// One serial port, held open whatever happens to it. It knows no page and no decoder.
//
//   closed      the port is not used any more; reached from any state, by close()
//   opening     for the first time, which may take more than a second
//   open        bytes come
//   reopening   closed, and opened again: with other options, or because the device has gone
//   failed      the browser does not open it; it is tried again each second
//
// `choosing` is added by Choice (source/choice.ts): it waits for the user, or for a file.

import type { State } from '../messages';

interface Listener {
  opened(): void;
  bytes(bytes: Uint8Array): void;
  // Bytes were lost; `error` is its name. The port stays open.
  disturbed(error: string): void;
  unplugged(): void;
}

type Port = Pick<SerialPort, 'open' | 'close' | 'readable'>;

const retryMs = 1000;

export class Connection {
  sinceMs = performance.now(); // of the state
  private now: State = 'opening';
  private gone = false;
  private turn = new AbortController(); // from one opening to the next
  private readonly waiters: (() => void)[] = [];

  constructor(
    private port: Port,
    private options: SerialOptions,
    private readonly listener: Listener,
  ) {
    void this.run();
  }

  get state(): State {
    return this.now;
  }

  // True from when the device is unplugged until it is open again.
  get isUnplugged(): boolean {
    return this.gone;
  }

  // Opens the port with other options. Resolves once it is open, has failed or is closed.
  reopen(options: SerialOptions): Promise<void> {
    if (this.now === 'closed') {
      return Promise.resolve();
    }
    this.options = options;
    this.enter('reopening');
    this.turn.abort();
    return new Promise((resolve) => this.waiters.push(resolve));
  }

  // The device has gone: the browser said so, or a read failed.
  unplugged(): void {
    if (!this.gone && this.now !== 'closed') {
      this.gone = true;
      this.enter('reopening');
      this.listener.unplugged();
    }
  }

  // The device is there again, as `port`.
  replugged(port: Port): void {
    this.port = port;
    this.turn.abort();
  }

  // Returns at once; the state is closed. The browser closes the port as soon as it can.
  close(): void {
    this.enter('closed');
    this.turn.abort();
  }

  private enter(state: State): void {
    this.sinceMs = state === this.now ? this.sinceMs : performance.now();
    this.now = state;
    if (state !== 'reopening') {
      this.waiters.splice(0).forEach((resolve) => resolve());
    }
  }

  private get isClosed(): boolean {
    return this.now === 'closed';
  }

  private async run(): Promise<void> {
    while (!this.isClosed) {
      const { port } = this;
      const { signal } = (this.turn = new AbortController());
      const release = await claim(port);
      if (!signal.aborted) {
        await this.hold(port, signal);
      }
      release();
      await pause(retryMs, signal);
    }
  }

  // Opens the port, reads it and closes it. open() cannot be cancelled.
  private async hold(port: Port, signal: AbortSignal): Promise<void> {
    try {
      await port.open(this.options);
    } catch {
      if (!signal.aborted) {
        this.enter(this.gone ? 'reopening' : 'failed');
      }
      return;
    }
    if (!signal.aborted) {
      this.gone = false;
      this.enter('open');
      this.listener.opened();
      await this.readAll(port, signal);
    }
    await port.close().catch(() => undefined); // it is closed if the browser has lost it
  }

  private async readAll(port: Port, signal: AbortSignal): Promise<void> {
    while (!signal.aborted) {
      if (!port.readable) {
        this.unplugged();
        return;
      }
      const error = await this.read(port.readable.getReader(), signal);
      if (!signal.aborted && port.readable) {
        this.listener.disturbed(error);
      }
    }
  }

  // Reads until it is stopped, or the stream breaks. Returns the error's name.
  private async read(reader: ReadableStreamDefaultReader<Uint8Array>, signal: AbortSignal): Promise<string> {
    const stop = (): void => void reader.cancel().catch(() => undefined);
    signal.addEventListener('abort', stop, { once: true });
    try {
      for (let part = await reader.read(); !part.done; part = await reader.read()) {
        this.listener.bytes(part.value);
      }
      return '';
    } catch (error) {
      return (error as DOMException).name;
    } finally {
      signal.removeEventListener('abort', stop);
      reader.releaseLock();
    }
  }
}

// For each port a promise, which resolves once its last connection has closed it.
const free = new WeakMap<Port, Promise<void>>();

// Waits until no other connection has the port. Call what it returns once the port is closed.
async function claim(port: Port): Promise<() => void> {
  const before = free.get(port);
  let release = (): void => undefined;
  free.set(port, new Promise((resolve) => (release = resolve)));
  await before;
  return release;
}

function pause(ms: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve) => {
    setTimeout(resolve, signal.aborted ? 0 : ms);
    signal.addEventListener('abort', () => resolve(), { once: true });
  });
}
