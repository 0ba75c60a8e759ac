// A serial port, through Web Serial: an adapter that receives S.Bus itself, or a board that prints numbers.

import type { Core, Setting } from '../core';
import type { Sink } from '../line';
import { Connection, type State } from './connection';
import { deviceName } from './device';
import type { Problem, Source } from './Source';

export type PortKind = 'adapter' | 'board';

const bufferSize = 4096; // bytes: more than a second of S.Bus

// Web Serial's names of errors that leave the port open.
const lineErrors: Record<string, string> = {
  ParityError: 'parity errors',
  FramingError: 'framing errors',
  BreakError: 'breaks',
  BufferOverrunError: 'overruns',
};

export class PortSource implements Source {
  readonly settings: readonly Setting[];
  readonly isBoard: boolean;
  readonly events = new Map<string, number>();
  private setting: Setting;
  private readonly connection: Connection;
  private readonly info: ReturnType<SerialPort['getInfo']>;
  private readonly zeroMs = performance.now();

  constructor(
    private readonly core: Core,
    private port: SerialPort,
    kind: PortKind,
    private readonly sink: Sink,
    boardBaud = 115200,
  ) {
    this.isBoard = kind === 'board';
    // The adapter inverts, or a part before it: the page cannot.
    const bauds = this.isBoard ? [boardBaud] : [100000, 200000];
    this.settings = bauds.map((baud) => ({ baud, inverted: !this.isBoard }));
    this.setting = this.settings[0];
    this.info = port.getInfo();
    navigator.serial?.addEventListener('connect', this.connected);
    navigator.serial?.addEventListener('disconnect', this.disconnected);
    this.begin();
    this.connection = new Connection(port, this.options(), {
      opened: () => this.events.has('unplugged') && this.count('reopened'),
      bytes: (bytes) => this.received(bytes),
      disturbed: (error) => this.disturbed(error),
      unplugged: () => this.count('unplugged'),
    });
  }

  get line(): Core {
    return this.core;
  }

  get title(): string {
    return this.isBoard ? `A board that prints numbers, ${this.setting.baud} baud` : 'S.Bus at a serial adapter, 8E2';
  }

  get device(): string {
    return deviceName(this.info);
  }

  has(port: SerialPort): boolean {
    return port === this.port;
  }

  get state(): State {
    return this.connection.state;
  }

  get problem(): Problem | undefined {
    return this.connection.isUnplugged ? unplugged : this.state === 'failed' ? notOpened : undefined;
  }

  nowUs(): number {
    return (performance.now() - this.zeroMs) * 1000;
  }

  async use(setting: Setting): Promise<void> {
    if (setting !== this.setting) {
      this.setting = setting;
      await this.connection.reopen(this.options());
    }
    if (this.state !== 'closed') {
      this.begin();
    }
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

  private received(bytes: Uint8Array): void {
    this.core.received(bytes, this.nowUs());
    this.core.advance(this.nowUs(), this.sink);
  }

  private disturbed(error: string): void {
    this.count(lineErrors[error] ?? 'system errors');
    this.core.receivedBad(this.nowUs());
  }

  // A device that is plugged in again is another SerialPort.
  private readonly connected = (event: Event): void => {
    const port = event.target as SerialPort;
    const { usbVendorId, usbProductId } = port.getInfo();
    if (this.connection.isUnplugged && usbVendorId === this.info.usbVendorId && usbProductId === this.info.usbProductId) {
      this.port = port;
      this.connection.replugged(port);
    }
  };

  private readonly disconnected = (event: Event): void => {
    if (event.target === this.port) {
      this.connection.unplugged();
    }
  };

  private count(what: string): void {
    this.events.set(what, (this.events.get(what) ?? 0) + 1);
  }
}

const unplugged: Problem = {
  text: 'The port has gone.',
  remedy: 'Plug the adapter or the board in again: the page goes on by itself.',
};

// Chromium gives the same text for every cause, which says no more than this.
const notOpened: Problem = {
  text: 'The port cannot be opened.',
  remedy: 'Close the other program that has it open, such as a Serial Monitor or another page. On Linux, add yourself to the group dialout. The page tries again every second.',
};

const noWebSerial: Problem = {
  text: 'This browser has no Web Serial.',
  remedy: 'To read a port, open this page in Chrome, Edge or Firefox (from 151 on) on a computer; or let sbus record it, and drop the file here.',
};

// Returns the port that the user picks. Throws a Problem without one.
export async function pickPort(kind: PortKind): Promise<SerialPort> {
  if (!navigator.serial) {
    throw noWebSerial;
  }
  try {
    return await navigator.serial.requestPort();
  } catch (error) {
    throw whyNoPort(error as DOMException, kind);
  }
}

function whyNoPort({ name, message }: DOMException, kind: PortKind): Problem {
  if (name === 'NotFoundError') {
    return { text: 'No port was chosen.', remedy: `Plug the ${kind} in, press the button again, and choose it in the list.` };
  }
  return {
    text: `The browser offers no port: ${message}`,
    remedy: 'Allow this page to use one. If the page was opened from disk and the browser rejects it, make scope serves it.',
  };
}
