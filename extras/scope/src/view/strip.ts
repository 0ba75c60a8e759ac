// The whole recording as a strip, under the slider that seeks in it: its faults, how far it is decoded, and what the curves show.
// Each fault has a height of its own, so that they can be told apart without colours; losses and damage are as high as they are many.

import { clock } from '../clock';
import { Announcer, byId, make, setAttribute, setText, svg } from '../dom';
import { binCount, Fault, type FaultMap, faultNames, faults, type Flight, type Span } from '../messages';
import type { RecordingSource } from '../source/recording';

const restMs = 1000; // from one announced fault to the next
const tall = 8;
const lossTall = 5.5; // all frames of a second lost
const [damageLeast, damageTall] = [0.5, 3]; // one byte; nothing but damage

// Top and height, of `tall`, by Fault. Lost frames are a thin line until it is known how many they are.
const bands: [number, number][] = [[0, 8], [0, 8], [7.5, 0.5], [0, damageTall], [3.5, 1], [6.5, 1.5]];
const classes = ['failsafe', 'failsafe', 'lost', 'damage', 'silence', 'late'];

const textOf = ({ fault, fromUs, toUs }: Span): string => `${faultNames[fault]}, ${clock(fromUs)}${toUs > fromUs ? ` to ${clock(toUs)}` : ''}`;

export const namesOf = (mask: number): string => faults.filter((fault) => mask & (1 << fault)).map((fault) => faultNames[fault]).join(', ');

const boxOf = (fault: Fault, from: number, to: number): string => {
  const [top, height] = bands[fault];
  return `M${from} ${top}h${to - from}v${height}h${from - to}z`;
};

// Returns the bins that have a fault, as the outlines of boxes.
function outline(fault: Fault, bins: Uint8Array): string {
  let path = '';
  for (let from = 0; from < bins.length; from++) {
    if (bins[from] & (1 << fault)) {
      let to = from + 1;
      while (to < bins.length && bins[to] & (1 << fault)) to++;
      path += boxOf(fault, from, to);
      from = to;
    }
  }
  return path;
}

// Returns the damage of each bin, from the top down, as high as the root of its share of the time.
const damage = ({ bins, damaged }: FaultMap, lengthUs: number): string =>
  Array.from(bins, (mask, bin) => {
    const height = damageLeast + (damageTall - damageLeast) * Math.sqrt(Math.min((damaged[bin] * binCount) / lengthUs, 1));
    return mask & (1 << Fault.Damage) ? `M${bin} 0h1v${height.toFixed(2)}h-1z` : '';
  }).join('');

// Returns the losses of each part, as high as the root of their share: 0.3 % and 40 % can be told apart.
const losses = ({ strip }: Flight, lengthUs: number): string =>
  strip.filter(([, , lost]) => lost > 0).map(([fromUs, toUs, lost]) => {
    const from = (binCount * fromUs) / lengthUs;
    const height = lossTall * Math.sqrt(lost);
    return `M${from.toFixed(2)} ${tall}h${Math.max((binCount * toUs) / lengthUs - from, 1).toFixed(2)}v${(-height).toFixed(2)}H${from.toFixed(2)}z`;
  }).join('');

export class Strip {
  only?: Fault; // the kind that is shown, and to which N goes; all without one
  private shown?: FaultMap;
  private shownFlight?: Flight;
  private readonly decoded = svg('rect', { class: 'decoded', height: tall });
  private readonly window = svg('rect', { class: 'window', height: tall });
  private readonly paths = faults.map((fault) => svg('path', { class: classes[fault] }));
  private readonly counts = faults.map(() => make('span'));
  private readonly buttons = faults.map(() => make('button', { 'aria-pressed': 'false', title: 'Show only these, and go only to these. Damage less than a second apart counts as one.' }));
  private readonly state = make('li');
  private readonly announcer = new Announcer(byId('fault-announcement'), restMs);

  constructor() {
    byId('strip').append(this.decoded, this.window, ...this.paths);
    const rows = faults.map((fault) => {
      const sample = svg('svg', { viewBox: `0 0 8 ${tall}`, 'aria-hidden': 'true' }, svg('path', { class: classes[fault], d: boxOf(fault, 0, 8) }));
      const button = this.buttons[fault];
      button.append(sample, this.counts[fault]);
      button.addEventListener('click', () => this.filter(this.only === fault ? undefined : fault));
      return make('li', {}, button);
    });
    byId('fault-counts').append(this.state, ...rows);
  }

  // `from`, `to`: what the curves show, in us. Call it for each picture.
  draw({ line: { faults: map, flight }, lengthUs, found, isLast }: RecordingSource, from: number, to: number): void {
    if (map !== this.shown || flight !== this.shownFlight) {
      this.shown = map;
      this.shownFlight = flight;
      this.drawMap(map ?? { us: 0, isComplete: false, bins: new Uint8Array(binCount), damaged: new Float32Array(binCount), counts: faults.map(() => 0) }, lengthUs, flight);
      if (flight) {
        setAttribute(this.paths[Fault.LostFrame], 'd', losses(flight, lengthUs));
      }
    }
    const place = (us: number): number => Math.min(Math.max((binCount * us) / lengthUs, 0), binCount);
    setAttribute(this.window, 'x', place(from).toFixed(1));
    setAttribute(this.window, 'width', (place(to) - place(from)).toFixed(1));
    const all = map?.isComplete ? ` of ${this.counted(map)}` : '';
    const kind = this.only === undefined ? 'fault' : `fault "${faultNames[this.only]}"`;
    const text = isLast ? `There is no other ${kind} in this direction.` : found ? `Fault ${found.number}${all}: ${textOf(found)}.` : '';
    setText(byId('fault-text'), text);
    this.announcer.say(text);
  }

  // Shows one kind of fault, or all.
  filter(only?: Fault): void {
    this.only = only;
    faults.forEach((fault) => {
      this.buttons[fault].setAttribute('aria-pressed', String(fault === only));
      this.paths[fault].style.display = only === undefined || fault === only ? '' : 'none';
    });
  }

  private counted({ counts }: FaultMap): number {
    return this.only === undefined ? counts.reduce((sum, count) => sum + count) : counts[this.only];
  }

  private drawMap(map: FaultMap, lengthUs: number, flight?: Flight): void {
    const { us, isComplete, bins, counts } = map;
    setAttribute(this.decoded, 'width', String(Math.min((binCount * us) / lengthUs, binCount)));
    faults.forEach((fault) => {
      setAttribute(this.paths[fault], 'd', fault === Fault.Damage ? damage(map, lengthUs) : outline(fault, bins));
      const isMissing = fault === Fault.LostFrame && counts[fault] === 0 && flight?.strip.some(([, , lost]) => lost > 0) === true; // its band has them, too
      setText(this.counts[fault], isMissing ? 'missing frames' : `${faultNames[fault]}: ${counts[fault]} ×`);
      (this.buttons[fault].parentElement as HTMLElement).hidden = counts[fault] === 0 && !isMissing;
    });
    const all = counts.reduce((sum, count) => sum + count);
    setText(this.state, isComplete ? `whole recording: ${all || 'no'} fault${all === 1 ? '' : 's'}` : `${Math.floor((100 * us) / lengthUs)} % decoded`);
  }
}
