// The built-in receiver: the page works without any hardware.

import type { Core } from '../core';
import type { Setting, Simulation } from '../messages';
import { Remote } from './remote';
import type { Source } from './Source';

const longestStepMs = 250; // a page in the background stands still: the time that it missed is left out

export class SimulatedSource implements Source {
  readonly state = 'open';
  readonly isSimulated = true;
  private us = 0;
  private lastMs = performance.now();

  private constructor(
    readonly line: Remote,
    readonly title: string,
  ) {}

  // `port`: the first setting of the port. Returns a function that begins.
  static async open(core: Core, simulation: Simulation, port: Setting, signal: AbortSignal): Promise<() => SimulatedSource> {
    const line = await Remote.live(core, { kind: 'simulated', simulation, port }, signal);
    return () => new SimulatedSource(line, titleOf(simulation));
  }

  nowUs(): number {
    const ms = performance.now();
    this.us += Math.min(ms - this.lastMs, longestStepMs) * 1000;
    this.lastMs = ms;
    this.line.wantedUs = this.us;
    return this.line.us;
  }

  cutWire(cut: boolean): void {
    this.line.ask({ kind: 'cutWire', cut });
  }

  close(): void {
    this.line.close();
  }
}

function titleOf({ calibration, channels }: Simulation): string {
  return calibration
    ? 'Simulated FrSky R-XSR, sticks move for a calibration: 15 s full travel, 7 s at rest, 5 s up and right'
    : channels === 24
      ? 'Simulated FrSky receiver with 24 channels'
      : channels === 32
        ? 'Simulated Futaba receiver, FASSTest 26: 32 channels'
        : 'Simulated FrSky R-XSR: every 15 s: radio off at 9.5 s, failsafe at 10 s, back at 12.5 s';
}
