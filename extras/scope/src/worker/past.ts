// Decodes the history before a place.

import { History, isSample, samplesOf } from '../history';
import type { Stretch } from '../line';
import type { Samples } from '../messages';
import type { Decoder } from './decoder';

export class Past {
  private readonly stretches: Stretch[] = [];

  constructor(
    readonly id: number, // of the request
    private readonly decoder: Decoder,
    private readonly endUs: number,
  ) {}

  // Returns the history once it is all there; undefined at the time `hurry`, in ms.
  work(hurry: number): Samples | undefined {
    const { decoder } = this;
    const isThere = decoder.advance(
      this.endUs,
      (records) => decoder.reader.stretchesIn(records).forEach((stretch) => isSample(stretch) && this.stretches.push(stretch)),
      hurry,
    );
    return isThere ? samplesOf(this.stretches.slice(-History.capacity)) : undefined;
  }
}
