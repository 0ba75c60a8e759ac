// What there is room for: a board shows what it has, and a line that never brought a frame how to bring one.

import { byId } from '../dom';
import { Flag, Kind, LinkState, type Status, type Stretch } from '../line';
import { PortSource } from '../source/port';
import { RecordingSource } from '../source/recording';
import type { Source } from '../source/Source';

const patienceMs = 1500; // until a frame is missed; in a recording, up to its end

export class Room {
  private enteredMs = 0;
  private readonly guide = byId('guide');
  private readonly guides = [...this.guide.querySelectorAll<HTMLElement>('[data-for]')];

  // Another source.
  enter(): void {
    this.enteredMs = performance.now();
  }

  draw(source: Source, { state, rows }: Status, newest: Stretch | undefined): void {
    const isLate = source instanceof RecordingSource ? source.atEnd : performance.now() - this.enteredMs > patienceMs;
    const never = state === LinkState.NeverSeen && newest === undefined && rows === 0 && isLate;
    const { kind, flags } = newest ?? { kind: Kind.Frame, flags: 0 };
    const line = never ? 'none' : kind !== Kind.Row ? 'frames' : flags & Flag.HasFlags ? 'flagged-rows' : 'rows';
    if (document.body.dataset.line !== line) {
      document.body.dataset.line = line;
    }
    this.guide.hidden = !never;
    const name = source instanceof RecordingSource ? 'recording' : !(source instanceof PortSource) ? 'simulated' : source.isBoard ? 'board' : 'adapter';
    this.guides.forEach((each) => (each.hidden = each.dataset.for !== name));
  }
}
