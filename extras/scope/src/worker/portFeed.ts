// A serial port, through Web Serial: an adapter that receives S.Bus itself, or a board that prints numbers.

import type { PortPlace, Problem, Setting, State } from '../messages';
import type { Native } from '../native';
import { idsOf } from '../source/device';
import { Connection } from './connection';

const patienceMs = 3000; // until a port that does not open is a problem: an FTDI adapter takes 60 to 1300 ms
const bufferSize = 4096; // bytes: more than a second of S.Bus

// Web Serial's names of errors that leave the port open.
const lineErrors: Record<string, string> = {
  ParityError: 'parity errors',
  FramingError: 'framing errors',
  BreakError: 'breaks',
  BufferOverrunError: 'overruns',
};

export type FindPort = (place: PortPlace) => Promise<SerialPort | undefined>;

// Finds a port that the page has, by its place among those that it may use: in page and worker alike, the browser's order.
export const findPort: FindPort = async ({ index, count, ids }) => {
  const ports = (await navigator.serial?.getPorts().catch(() => [])) ?? [];
  const port = ports[index];
  return port && ports.length === count && idsOf(port.getInfo()) === ids ? port : undefined;
};

export class PortFeed {
  readonly settings: readonly Setting[];
  readonly events = new Map<string, number>();
  private setting: Setting;
  private waits = false; // for the device, which was unplugged
  private readonly connection: Connection;
  private readonly info: ReturnType<SerialPort['getInfo']>;
  private readonly zeroMs = performance.now();

  constructor(
    private readonly core: Pick<Native, 'openPort' | 'received' | 'receivedBad'>,
    private port: SerialPort,
    private readonly isBoard: boolean,
    boardBaud: number,
  ) {
    // The adapter inverts, or a part before it: the page cannot.
    const bauds = isBoard ? [boardBaud] : [100000, 200000];
    this.settings = bauds.map((baud) => ({ baud, inverted: !isBoard }));
    this.setting = this.settings[0];
    this.info = port.getInfo();
    navigator.serial?.addEventListener('connect', this.connected);
    navigator.serial?.addEventListener('disconnect', this.disconnected);
    this.begin();
    this.connection = new Connection(port, this.options(), {
      opened: () => this.events.has('unplugged') && this.count('reopened'),
      bytes: (bytes) => this.core.received(bytes, this.nowUs()),
      disturbed: (error) => this.disturbed(error),
      unplugged: () => {
        this.waits = true;
        this.count('unplugged');
      },
    });
  }

  get title(): string {
    return this.isBoard ? `A board that prints numbers, ${this.setting.baud} baud` : `Serial adapter, ${this.setting.baud} baud, 8E2`;
  }

  get state(): State {
    return this.connection.state;
  }

  get isUnplugged(): boolean {
    return this.connection.isUnplugged;
  }

  get problem(): Problem | undefined {
    const isSlow = this.state !== 'open' && performance.now() - this.connection.sinceMs > patienceMs;
    return this.isUnplugged ? unplugged : this.state === 'failed' ? notOpened : isSlow ? notOpening : undefined;
  }

  nowUs(): number {
    return (performance.now() - this.zeroMs) * 1000;
  }

  async use(setting: Setting): Promise<void> {
    if (setting.baud !== this.setting.baud) {
      this.setting = setting;
      await this.connection.reopen(this.options());
    }
    if (this.state !== 'closed') {
      this.begin();
    }
  }

  // The device is there again, as `port`.
  replugged(port: SerialPort): void {
    this.waits = false;
    this.port = port;
    this.connection.replugged(port);
  }

  close(): void {
    navigator.serial?.removeEventListener('connect', this.connected);
    navigator.serial?.removeEventListener('disconnect', this.disconnected);
    this.connection.close();
  }

  private begin(): void {
    this.core.openPort(this.nowUs(), this.setting.baud, this.isBoard);
  }

  private options(): SerialOptions {
    const baudRate = this.setting.baud;
    return this.isBoard ? { baudRate, bufferSize } : { baudRate, dataBits: 8, parity: 'even', stopBits: 2, bufferSize };
  }

  private disturbed(error: string): void {
    this.count(lineErrors[error] ?? 'system errors');
    this.core.receivedBad(this.nowUs());
  }

  // A device that is plugged in again is another SerialPort.
  private readonly connected = (event: Event): void => {
    const port = event.target as SerialPort;
    if (this.waits && idsOf(port.getInfo()) === idsOf(this.info)) {
      this.replugged(port);
    }
  };

  private readonly disconnected = (event: Event): void => {
    if (event.target === this.port) {
      this.waits = true; // also if it has not been opened again
      this.connection.unplugged();
    }
  };

  private count(what: string): void {
    this.events.set(what, (this.events.get(what) ?? 0) + 1);
  }
}

const unplugged: Problem = {
  text: 'The port is gone.',
  remedy: 'Plug the adapter or the board in again, and the page goes on by itself. For a device without a serial number (most CH340) the browser does not report this: press Adapter… or Board… and choose it, and the page goes on where it stopped.',
};

const notOpening: Problem = {
  text: 'The port does not respond.',
  remedy: 'The system has not answered for 3 s. Unplug the adapter or the board and plug it in again; if that does not help, restart the browser.',
};

// Chromium gives the same text for every cause, which says no more than this.
const notOpened: Problem = {
  text: 'The port cannot be opened.',
  remedy: 'Close the program that has it open, for example a Serial Monitor or another page. On Linux, add yourself to the group dialout. The page tries again every second.',
};
