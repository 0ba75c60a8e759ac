// A recording's places: the decoder's states, some seconds apart, the line's faults, the flight's figures, and its values' envelope. It is decoded once, whenever there is time.

import type { Answer } from '../messages';
import { firstFrom } from '../numbers';
import { Throttle } from '../throttle';
import type { Decoder, Image } from './decoder';
import { EnvelopeIndex } from './envelope';
import { FaultIndex } from './faultIndex';
import type { Tape } from './tape';

const progressMs = 100;
const spacing = 25000; // characters from one image to the next: ten seconds of S.Bus, which are decoded in 6 ms
const mostImages = 1024; // of 80 kB each

export class TapeIndex {
  private readonly images: Image[];
  readonly faults: FaultIndex;
  private envelope?: EnvelopeIndex; // until it is told
  private readonly apart: number;
  private readonly telling = new Throttle(progressMs);

  constructor(
    private readonly decoder: Decoder,
    private readonly tape: Tape,
    readonly endUs: number,
    private readonly tell: (message: Answer) => void,
  ) {
    this.images = [decoder.image()];
    this.apart = Math.max(spacing, tape.size / mostImages);
    tape.beginFlight();
    this.envelope = new EnvelopeIndex(endUs);
    this.faults = new FaultIndex(endUs, decoder.calls.gapOf, tape.carrier ? 0 : undefined); // a capture begins at its time 0
  }

  get us(): number {
    return this.decoder.us;
  }

  get isComplete(): boolean {
    return this.us >= this.endUs;
  }

  // Decodes up to the time `hurry`, in ms, or to the end, and tells of the faults.
  work(hurry: number): void {
    const { decoder, faults, envelope, tape } = this;
    const take = (records: Uint8Array): void => {
      tape.flightRecords(records);
      decoder.reader.each(records, (record) => {
        faults.take(record);
        envelope?.take(record);
      });
    };
    while (!this.isComplete && performance.now() < hurry) {
      decoder.advance(Math.min(decoder.us + 1000000, this.endUs), take);
      if (decoder.next - (this.images.at(-1) as Image).next >= this.apart) {
        this.images.push(decoder.image());
      }
    }
    if (this.isComplete) {
      faults.finish(this.endUs);
      if (envelope) {
        this.tell({ kind: 'envelope', envelope: envelope.finish() });
        this.envelope = undefined;
      }
    }
    if (this.isComplete || this.telling.due) {
      this.tell({ kind: 'faults', map: { us: this.us, isComplete: this.isComplete, bins: faults.bins, damaged: faults.damaged, counts: faults.counts() } });
    }
    const flight = this.isComplete ? tape.flight(decoder.reader.status(this.endUs)) : undefined;
    if (flight) {
      this.tell({ kind: 'flight', flight });
    }
  }

  // Returns the newest image that is not later.
  before(us: number): Image {
    return this.images[Math.max(firstFrom(0, this.images.length, (image) => this.images[image].us <= us) - 1, 0)];
  }
}
