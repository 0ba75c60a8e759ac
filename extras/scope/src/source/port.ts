// A serial port, through Web Serial: an adapter that receives S.Bus itself, or a board that prints numbers.

import type { Core } from '../core';
import type { PortPlace, State } from '../messages';
import { deviceName, idsOf, type PortKind } from './device';
import { Remote } from './remote';
import type { Source } from './Source';

export class PortSource implements Source {
  private constructor(
    readonly line: Remote,
    private readonly port: SerialPort,
    readonly isBoard: boolean,
  ) {}

  // Returns a function that begins. `baud`: of a board.
  static async open(core: Core, port: SerialPort, kind: PortKind, baud: number, signal: AbortSignal): Promise<() => PortSource> {
    const isBoard = kind === 'board';
    const line = await Remote.live(core, { kind: 'port', place: await placeOf(port), isBoard, baud }, signal, port);
    return () => new PortSource(line, port, isBoard);
  }

  get title(): string {
    return this.line.picture.live?.title ?? '';
  }

  get device(): string {
    return deviceName(this.port.getInfo());
  }

  get state(): State {
    return this.line.picture.live?.state ?? 'opening';
  }

  // Returns true for this device, or for a like one once it was unplugged: plugged in again it is another SerialPort.
  has(port: SerialPort): boolean {
    return port === this.port || (idsOf(port.getInfo()) === idsOf(this.port.getInfo()) && (this.line.picture.live?.events?.has('unplugged') ?? false));
  }

  nowUs(): number {
    this.line.wantedUs = Infinity; // all that has come
    return this.line.us;
  }

  get isUnplugged(): boolean {
    return this.line.picture.live?.isUnplugged ?? false;
  }

  // Goes on with a device that is plugged in again, as `port`, of which the browser has not told.
  async replug(port: SerialPort): Promise<void> {
    this.line.ask({ kind: 'replugged', place: await placeOf(port) });
  }

  // Sets a board's baud rate.
  use(baud: number): void {
    this.line.ask({ kind: 'use', setting: { baud, inverted: false } });
  }

  close(): void {
    this.line.close();
  }
}

async function placeOf(port: SerialPort): Promise<PortPlace> {
  const ports = (await navigator.serial?.getPorts().catch(() => [])) ?? [];
  return { index: ports.indexOf(port), count: ports.length, ids: idsOf(port.getInfo()) };
}
