// Looks in a recording for the next moment at which a condition becomes true.

import { Flag } from '../line';
import type { Decoder } from './decoder';

const stepUs = 1000000;
const silentStepUs = 10000; // for a condition that may become true while nothing comes

export class Search {
  found?: number; // us
  private readonly stepUs: number;

  // `decoder`: stands at `fromUs` or before.
  constructor(
    readonly id: number, // of the request
    steps: Uint8Array,
    private readonly decoder: Decoder,
    private readonly fromUs: number,
    private readonly endUs: number,
  ) {
    this.stepUs = decoder.watchFor(steps) ? silentStepUs : stepUs;
  }

  get us(): number {
    return this.decoder.us;
  }

  // Returns true if it has found the moment, or none up to the end; false at the time `hurry`, in ms.
  work(hurry: number): boolean {
    const { decoder } = this;
    while (this.found === undefined && decoder.us < this.endUs) {
      if (performance.now() > hurry) {
        return false;
      }
      decoder.advance(Math.min(decoder.us + this.stepUs, this.endUs), (records) =>
        decoder.reader.each(records, ({ endUs, flags }) => {
          if (flags & Flag.Event && endUs > this.fromUs) {
            this.found ??= endUs;
          }
        }),
      );
    }
    return true;
  }
}
