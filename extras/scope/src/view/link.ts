// The link at a glance: its state, the flags, age, quality, rate and gaps.

import { Flag, Kind, LinkState, type Status } from '../border';
import { byId, make, setAttribute, setText } from '../dom';
import type { Stretch } from '../native';
import { Throttle } from '../throttle';

// Name and severity.
const states: Record<LinkState, [string, string]> = {
  [LinkState.NeverSeen]: ['Never seen', 'note'],
  [LinkState.Ok]: ['Fine', 'good'],
  [LinkState.Lossy]: ['Lossy', 'warning'],
  [LinkState.Failsafe]: ['Failsafe', 'alarm'],
  [LinkState.Stale]: ['Stale', 'alarm'],
};

// Of frames, of rows.
const labels = [['Newest frame', 'Rate', 'Frame interval'], ['Newest row', 'Rate', 'Row interval']];

const ms = (us: number, digits = 1): string => (us / 1000).toFixed(digits);

function ageText(us: number): string {
  return us < 1e6 ? `${ms(us, 0)} ms` : us < 1e8 ? `${(us / 1e6).toFixed(1)} s` : `${(us / 1e6).toFixed(0)} s`;
}

export class LinkView {
  private readonly state = make('strong', { id: 'state' });
  private readonly age = make('strong', { id: 'age' });
  private readonly quality = make('small', { id: 'quality' });
  private readonly rate = make('strong', { id: 'rate' });
  private readonly gap = make('strong', { id: 'gap' });
  private readonly gapEnds = make('small', { id: 'gap-ends' });
  private readonly rateUnit = make('small');
  private readonly tiles: HTMLElement[]; // labels
  private readonly stateTile: HTMLElement;
  private readonly indicators = new Map<number, HTMLElement>();
  private readonly text = new Throttle(100);

  constructor() {
    const root = byId('link');
    const tile = (label: string, ...content: HTMLElement[]): HTMLElement =>
      make('div', { class: 'tile' }, make('span', { class: 'label' }, label), make('div', {}, ...content));
    this.stateTile = tile('Link', this.state, this.quality);
    this.stateTile.classList.add('state');
    const indicators = make('div', { class: 'indicators' });
    for (const [flag, name, color] of [
      [Flag.LostFrame, 'Lost frame', 'warning'],
      [Flag.Failsafe, 'Failsafe', 'alarm'],
      [Flag.Channel17, 'CH17', 'good'],
      [Flag.Channel18, 'CH18', 'good'],
    ] as const) {
      const indicator = make('div', { class: 'indicator', 'data-on': 'false', 'data-color': color }, make('i', { 'aria-hidden': true }), make('span', {}, name), make('span', { class: 'value' }, 'off'));
      indicator.id = `indicator-${name.toLowerCase().replace(' ', '-')}`;
      this.indicators.set(flag, indicator);
      indicators.append(indicator);
    }
    root.append(
      this.stateTile,
      indicators,
      ...[this.age, this.rate, this.gap].map((value, i) => tile('', value, ...[[], [this.rateUnit], [this.gapEnds]][i])),
    );
    this.tiles = [...root.querySelectorAll<HTMLElement>('.tile .label')].slice(1);
  }

  // Shows the two switches that come with 16 channels, CH17 and CH18. With 32 channels, where CH17 and CH18 are channels, Futaba
  // calls the switches DG1 and DG2. A line of 24 channels has none.
  // A board has the indicators for which it prints columns.
  private choose(newest: Stretch | undefined): void {
    const isRow = newest?.kind === Kind.Row;
    const flags = newest?.flags ?? 0;
    for (const flag of [Flag.LostFrame, Flag.Failsafe]) {
      (this.indicators.get(flag) as HTMLElement).hidden = isRow && (flags & Flag.HasFlags) === 0;
    }
    const count = newest?.channels.length ?? 16;
    const more = count === 32 && !isRow;
    for (const [flag, name, other] of [[Flag.Channel17, 'CH17', 'DG1'], [Flag.Channel18, 'CH18', 'DG2']] as const) {
      const indicator = this.indicators.get(flag) as HTMLElement;
      indicator.hidden = isRow ? (flags & Flag.HasSwitches) === 0 : count !== 16 && !more;
      setText(indicator.children[1] as HTMLElement, more ? other : name);
    }
  }

  // `hasFault`: the verdict names one. `frames`: of the whole recording; `hasTimes`: see Tape.
  draw(status: Status, newest: Stretch | undefined, hasFault: boolean, frames?: number, hasTimes = true): void {
    const state = status.state as LinkState;
    const [name, severity] = state === LinkState.Ok && hasFault ? ['Frames come', 'note'] : states[state];
    setText(this.state, name);
    setAttribute(this.stateTile, 'data-severity', severity);
    this.indicators.forEach((indicator, flag) => {
      const flags = newest?.flags ?? 0;
      const on = flag === Flag.LostFrame ? status.showsLostFrame > 0 : flag === Flag.Failsafe ? status.showsFailsafe > 0 : (flags & flag) !== 0;
      setAttribute(indicator, 'data-on', String(on));
      setText(indicator.lastElementChild as HTMLElement, !on ? 'off' : flag === Flag.Failsafe && flags & Flag.ByLosses ? 'by losses' : 'on');
    });
    this.choose(newest);
    if (!this.text.due) {
      return;
    }
    const age = status.state === LinkState.NeverSeen || !hasTimes ? '' : ageText(status.ageUs);
    setText(this.age, frames ? `${status.frames} of ${frames}` : age || '–');
    this.tiles.forEach((label, i) => setText(label, i === 0 && frames ? `Frame${age && `, ${age} ago`}` : labels[Number(status.rows > 0)][i]));
    setText(this.quality, status.rows > 0 || status.state === LinkState.NeverSeen ? '' : `quality\u00a0${status.linkQuality}\u00a0%`);
    setText(this.rate, hasTimes ? String(status.framesPerSecond) : '–');
    setText(this.rateUnit, status.rows > 0 ? 'rows/s' : 'frames/s');
    const hasGaps = status.gapMeanUs > 0 && hasTimes;
    setText(this.gap, hasGaps ? `${ms(status.gapMeanUs)} ms` : '–');
    setText(this.gapEnds, hasGaps ? `${ms(status.gapMinUs)} to ${ms(status.gapMaxUs)}` : '');
  }
}
