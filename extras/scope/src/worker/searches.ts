// What a recording is searched for: the history before a place, the next event, and where a fault shows.

import { Flag, Kind, LinkState, type RecordReader, type Status } from '../border';
import { History, isSample, samplesOf } from '../history';
import { Fault, type Found, type Samples } from '../messages';
import type { Stretch } from '../native';
import type { Decoder } from './decoder';

const stepUs = 1000000;
const silentStepUs = 10000; // for a condition that may become true while nothing comes
const longestLookUs = 3000000; // from where a fault begins to where the page shows it

// Decodes the history before a place.
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

// Looks for the next moment at which a condition becomes true.
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

// Goes on from where a fault begins to where the page shows it: what a byte belongs to is known some bytes later.
export function advanceTo(found: Found, player: Decoder, lastUs: number, records: Uint8Array[]): void {
  const shows = (part: Uint8Array): boolean => {
    let isIn = false;
    player.reader.each(part, (sample) => (isIn ||= sample.endUs >= found.fromUs && hasFault(sample, found.fault)));
    return isIn;
  };
  let isShown = records.some(shows);
  for (const endUs = Math.min(found.fromUs + longestLookUs, lastUs); !isShown && player.us < endUs; ) {
    player.advance(player.us + 1000, (part) => {
      records.push(part);
      isShown ||= shows(part);
    });
    isShown ||= found.fault >= Fault.NoFrames && isSilent(player.reader.status(player.us), found.fault);
  }
}

const isSilent = (status: Status, fault: Fault): boolean => (fault === Fault.Late ? status.lateUs > 0 : status.state === LinkState.Stale);

function hasFault({ kind, flags }: RecordReader, fault: Fault): boolean {
  const isFrame = kind !== Kind.NoFrame;
  switch (fault) {
    case Fault.Failsafe: return isFrame && (flags & Flag.Failsafe) !== 0;
    case Fault.NoPulses: return kind === Kind.Frame && (flags & Flag.NoPulses) !== 0;
    case Fault.LostFrame: return isFrame && (flags & Flag.LostFrame) !== 0;
    case Fault.Damage: return !isFrame;
    default: return false; // time passes until it is seen
  }
}
