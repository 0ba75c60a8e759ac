// A serial port, through Web Serial: an adapter that receives S.Bus itself, or a board that prints numbers.

import type { Core, Setting, Stretch } from '../core';
import type { Problem, Source } from './Source';

export type PortKind = 'adapter' | 'board';

const bufferSize = 4096; // bytes: more than a second of S.Bus
const retryMs = 1000;

// Web Serial's names of errors that leave the port open: a character, or some, were lost.
const lineErrors: Record<string, string> = {
  ParityError: 'parity errors',
  FramingError: 'framing errors',
  BreakError: 'breaks',
  BufferOverrunError: 'overruns',
};

export class PortSource implements Source {
  readonly title: string;
  readonly settings: readonly Setting[];
  readonly events = new Map<string, number>();
  problem?: Problem;
  private wanted = true;
  private setting: Setting;
  private reader?: ReadableStreamDefaultReader<Uint8Array>;
  private done: Promise<void>;
  private readonly zeroMs = performance.now();
  private wake?: () => void;

  constructor(
    private readonly core: Core,
    private port: SerialPort,
    readonly kind: PortKind,
    private readonly take: (stretch: Stretch) => void,
  ) {
    // What inverts is the adapter, or a part before it: the page cannot.
    const bauds = kind === 'adapter' ? [100000, 200000] : [115200];
    this.settings = bauds.map((baud) => ({ baud, inverted: kind === 'adapter' }));
    this.setting = this.settings[0];
    this.title = kind === 'adapter' ? 'S.Bus at a serial adapter, 8E2' : 'A board that prints numbers, 115200 baud';
    navigator.serial?.addEventListener('connect', this.connected);
    this.begin();
    this.done = this.run();
  }

  nowUs(): number {
    return (performance.now() - this.zeroMs) * 1000;
  }

  async use(setting: Setting): Promise<void> {
    if (setting !== this.setting) {
      this.setting = setting;
      await this.stopReading(); // run() opens it again
    }
    if (this.wanted) {
      this.begin();
    }
  }

  async close(): Promise<void> {
    this.wanted = false;
    navigator.serial?.removeEventListener('connect', this.connected);
    this.wake?.();
    await this.stopReading();
    await this.done;
  }

  private begin(): void {
    this.core.openPort(this.nowUs(), this.setting.baud, this.kind === 'board');
  }

  private async run(): Promise<void> {
    while (this.wanted) {
      try {
        await this.port.open(this.options());
      } catch (error) {
        this.problem = whyNotOpen(error);
        await this.sleep();
        continue;
      }
      if (this.problem === gone) {
        this.count('reopened');
      }
      this.problem = undefined;
      await this.readAll();
      try {
        await this.port.close();
      } catch {
        // It has gone.
      }
      if (this.problem) {
        await this.sleep();
      }
    }
  }

  private options(): SerialOptions {
    const baudRate = this.setting.baud;
    return this.kind === 'board' ? { baudRate, bufferSize } : { baudRate, dataBits: 8, parity: 'even', stopBits: 2, bufferSize };
  }

  // Until somebody stops it, or the port has gone.
  private async readAll(): Promise<void> {
    const opened = this.setting;
    let ended = false;
    while (!ended && this.port.readable) {
      this.reader = this.port.readable.getReader();
      try {
        for (let part = await this.reader.read(); !part.done; part = await this.reader.read()) {
          this.core.received(part.value, this.nowUs());
          this.core.advance(this.nowUs(), this.take);
        }
        ended = true;
      } catch (error) {
        this.broken(error as DOMException);
      } finally {
        this.reader.releaseLock();
        this.reader = undefined;
      }
    }
    if (this.wanted && this.setting === opened) {
      this.problem ??= gone;
    }
  }

  private broken(error: DOMException): void {
    const what = lineErrors[error.name];
    if (what) {
      this.count(what);
      this.core.receivedBad(this.nowUs());
    } else {
      this.count('unplugged');
      this.problem = gone;
    }
  }

  private async stopReading(): Promise<void> {
    try {
      await this.reader?.cancel();
    } catch {
      // It has broken meanwhile.
    }
  }

  private readonly connected = (event: Event): void => {
    const port = event.target as SerialPort;
    const { usbVendorId, usbProductId } = this.port.getInfo();
    const info = port.getInfo?.();
    if (info && info.usbVendorId === usbVendorId && info.usbProductId === usbProductId && !this.port.readable) {
      this.port = port;
      this.wake?.();
    }
  };

  private sleep(): Promise<void> {
    return new Promise((resolve) => {
      const timer = setTimeout(resolve, retryMs);
      this.wake = () => {
        clearTimeout(timer);
        resolve();
      };
    });
  }

  private count(what: string): void {
    this.events.set(what, (this.events.get(what) ?? 0) + 1);
  }
}

const gone: Problem = {
  text: 'THE PORT HAS GONE.',
  cure: 'Plug the adapter or the board in again: the page goes on by itself.',
};

function whyNotOpen(error: unknown): Problem {
  const message = error instanceof Error ? error.message : String(error);
  if (/no longer|lost|disconnected|NotFound/i.test(message)) {
    return gone;
  }
  return {
    text: `THE PORT CANNOT BE OPENED: ${message}`,
    cure: 'Close the other program that has it open: a Serial Monitor, or another page. On Linux you must be in the group dialout.',
  };
}

export const noWebSerial: Problem = {
  text: 'THIS BROWSER HAS NO WEB SERIAL.',
  cure: 'To read a port, open this page in Chrome, Edge or Firefox (from 151 on) on a computer; or let sbus record it, and drop the file here.',
};

// The port that the user picks; a Problem if none.
export async function pickPort(kind: PortKind): Promise<SerialPort | Problem> {
  if (!navigator.serial) {
    return noWebSerial;
  }
  try {
    return await navigator.serial.requestPort();
  } catch (error) {
    const what = kind === 'adapter' ? 'adapter' : 'board';
    const { name, message } = error as DOMException;
    if (name !== 'NotFoundError') {
      return { text: `THE BROWSER GIVES NO PORT: ${message}`, cure: 'Allow this page to use one. From disk it may reject: make scope serves the page.' };
    }
    return { text: 'NO PORT WAS CHOSEN.', cure: `Plug the ${what} in, press the button again, and choose it in the list.` };
  }
}
