// The built-in receiver: the page works without any hardware.

import type { Core, Setting, Simulation } from '../core';
import type { Source } from './Source';

const longestStepMs = 250; // a page in the background stands still: the time that it missed is left out

export class SimulatedSource implements Source {
  readonly state = 'open';
  readonly title: string;
  readonly settings: readonly Setting[];
  private us = 0;
  private lastMs = performance.now();

  // `port`: the first setting of the port.
  constructor(
    private readonly core: Core,
    simulation: Simulation,
    port: Setting,
  ) {
    this.title = simulation.calibration
      ? 'Simulated FrSky R-XSR, sticks as for a calibration: 15 s whole travel, 7 s at rest, 5 s up and right'
      : simulation.channels === 24
        ? 'Simulated FrSky receiver of 24 channels'
        : simulation.channels === 32
          ? 'Simulated Futaba receiver, FASSTest 26: 32 channels'
          : 'Simulated FrSky R-XSR: every 15 s the radio goes off at 9.5 s, failsafe at 10 s, back at 12.5 s';
    core.openSimulated(simulation);
    core.setPort(0, port);
    const bauds = [port.baud, port.baud === 100000 ? 200000 : 100000];
    const ways = [port.inverted, !port.inverted];
    this.settings = ways.flatMap((inverted) => bauds.map((baud) => ({ baud, inverted })));
  }

  get line(): Core {
    return this.core;
  }

  nowUs(): number {
    const ms = performance.now();
    this.us += Math.min(ms - this.lastMs, longestStepMs) * 1000;
    this.lastMs = ms;
    return this.us;
  }

  async use(setting: Setting): Promise<void> {
    this.core.setPort(this.us, setting);
  }

  close(): void {}
}
