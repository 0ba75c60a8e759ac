// Looks in a recording for the next moment at which a condition becomes true.

import { type Condition, has, Trigger } from '../trigger';
import type { Decoder } from './decoder';

const stepUs = 1000000;
const silentStepUs = 10000; // where the state of the link matters, which also changes while nothing comes

export class Search {
  found?: number; // us
  private readonly trigger: Trigger;
  private readonly needsState: boolean;

  // `decoder`: stands at `fromUs` or before.
  constructor(
    readonly id: number, // of the request
    condition: Condition,
    private readonly decoder: Decoder,
    private readonly fromUs: number,
    private readonly endUs: number,
  ) {
    this.trigger = new Trigger(condition, decoder.us > 0);
    this.needsState = has(condition, ({ is }) => is === 'state');
  }

  get us(): number {
    return this.decoder.us;
  }

  // Returns true if it has found the moment, or none up to the end; false at the time `hurry`, in ms.
  work(hurry: number): boolean {
    const { decoder, trigger } = this;
    while (this.found === undefined && decoder.us < this.endUs) {
      if (performance.now() > hurry) {
        return false;
      }
      decoder.advance(Math.min(decoder.us + (this.needsState ? silentStepUs : stepUs), this.endUs), (records) =>
        decoder.reader.eachMoment(records, (moment, us) => this.take(trigger.take(moment), us)),
      );
      if (this.needsState) {
        this.take(trigger.silent(decoder.calls.linkState(decoder.us)), decoder.us);
      }
    }
    return true;
  }

  private take(fires: boolean, us: number): void {
    if (fires && us > this.fromUs) {
      this.found ??= us;
    }
  }
}
