// A recording's places: the decoder's states, some seconds apart, and the line's faults. It is decoded once, whenever there is time.

import type { FaultMap } from '../messages';
import { Throttle } from '../throttle';
import type { Decoder, Image } from './decoder';
import { FaultIndex } from './faultIndex';

const progressMs = 100;
const spacing = 25000; // characters from one image to the next: ten seconds of S.Bus, which are decoded in 6 ms
const mostImages = 1024; // of 80 kB each

export class TapeIndex {
  private readonly images: Image[];
  readonly faults: FaultIndex;
  private readonly apart: number;
  private readonly telling = new Throttle(progressMs);

  constructor(
    private readonly decoder: Decoder,
    size: number,
    readonly endUs: number,
    private readonly tell: (map: FaultMap) => void,
  ) {
    this.images = [decoder.image()];
    this.apart = Math.max(spacing, size / mostImages);
    this.faults = new FaultIndex(endUs, decoder.calls.gapOf);
  }

  get us(): number {
    return this.decoder.us;
  }

  get isComplete(): boolean {
    return this.us >= this.endUs;
  }

  // Decodes up to the time `hurry`, in ms, or to the end, and tells of the faults.
  work(hurry: number): void {
    const { decoder, faults } = this;
    const take = (records: Uint8Array): void => decoder.reader.eachSample(records, (sample) => faults.take(sample));
    while (!this.isComplete && performance.now() < hurry) {
      decoder.advance(Math.min(decoder.us + 1000000, this.endUs), take);
      if (decoder.next - (this.images.at(-1) as Image).next >= this.apart) {
        this.images.push(decoder.image());
      }
    }
    if (this.isComplete) {
      faults.finish(this.endUs);
    }
    if (this.isComplete || this.telling.due) {
      this.tell({ us: this.us, isComplete: this.isComplete, bins: faults.bins, counts: faults.counts() });
    }
  }

  // Returns the newest image that is not later.
  before(us: number): Image {
    let newest = 0;
    for (let i = 0; i < this.images.length && this.images[i].us <= us; i++) {
      newest = i;
    }
    return this.images[newest];
  }
}
