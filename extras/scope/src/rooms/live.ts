// A live line: the simulation with its choices, an adapter, or a board.

import type { Core } from '../core';
import { byId } from '../dom';
import type { Problem } from '../messages';
import type { Choice } from '../source/choice';
import { pickPort, type PortKind } from '../source/device';
import { PortSource } from '../source/port';
import { SimulatedSource } from '../source/simulated';
import type { Source } from '../source/Source';
import { keep, recall } from '../storage';
import { KnownPorts } from '../view/knownPorts';
import type { NoticeView } from '../view/notice';
import type { Room } from './Room';

// What it returns begins the simulation.
export function liveRoom(core: Core, choice: Choice<Source>, notice: NoticeView): Room & { simulate(): Promise<void> } {
  const known = new KnownPorts(byId('known'), (port, kind) => void open(port, kind));
  const [receiver, fault, baud] = ['receiver', 'fault', 'baud'].map((id) => byId<HTMLSelectElement>(id));

  async function simulate(): Promise<void> {
    const [receives, fails] = [receiver.value, fault.value];
    const port = { baud: fails === 'baud' ? 200000 : 100000, inverted: fails !== 'inversion' };
    const simulation = {
      calibration: receives === 'calibration',
      channels: receives === '24' ? 24 : receives === '32' ? 32 : 16,
      noise: { noise: 30, storm: 300 }[fails] ?? 0,
      line: { baud: 100000, inverted: true },
    } as const;
    await choice.change(async (signal) => {
      const make = await SimulatedSource.open(core, simulation, port, signal);
      return () => {
        const source = make();
        cut(source, fails === 'silent');
        return source;
      };
    });
  }

  function cut(source: SimulatedSource, isCut: boolean): void {
    byId('cut').setAttribute('aria-pressed', String(isCut));
    source.cutWire(isCut);
  }

  async function connect(kind: PortKind): Promise<void> {
    notice.hide();
    try {
      const port = await choice.ask(() => pickPort(kind));
      if (port) {
        await open(port, kind);
      }
    } catch (problem) {
      notice.show(problem as Problem);
    }
  }

  async function open(port: SerialPort, kind: PortKind): Promise<void> {
    notice.hide();
    const { current } = choice;
    if (current instanceof PortSource && current.isUnplugged && current.isBoard === (kind === 'board') && current.has(port)) {
      await current.replug(port);
      return;
    }
    try {
      await choice.change((signal) => PortSource.open(core, port, kind, Number(baud.value), signal));
      known.remember(port, kind);
    } catch (error) {
      notice.show({ text: `The port cannot be read: ${(error as Error).message}.`, remedy: 'Reload the page, and choose the port again.' });
    }
  }

  byId('source-simulated').addEventListener('click', simulate);
  byId('source-adapter').addEventListener('click', () => connect('adapter'));
  byId('source-board').addEventListener('click', () => connect('board'));
  receiver.addEventListener('change', simulate);
  fault.addEventListener('change', simulate);
  byId('cut').addEventListener('click', () => {
    if (choice.current instanceof SimulatedSource) {
      cut(choice.current, byId('cut').getAttribute('aria-pressed') !== 'true');
    }
  });
  baud.value = [...baud.options].find(({ value }) => value === recall('baud'))?.value ?? '115200';
  baud.addEventListener('change', () => {
    keep('baud', baud.value);
    if (choice.current instanceof PortSource) {
      choice.current.use(Number(baud.value));
    }
  });
  const draw: Room['views'][string] = ({ source }) => known.draw((port) => source instanceof PortSource && source.has(port));
  return { views: { 'The list of ports': draw }, simulate };
}
