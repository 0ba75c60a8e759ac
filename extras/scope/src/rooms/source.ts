// Which source it is: its button, its choices and its title. A board shows what it has, and a line that never brought a frame how to
// bring one.

import { byId, setText } from '../dom';
import { Flag, Kind, LinkState } from '../line';
import type { State } from '../messages';
import type { Choice } from '../source/choice';
import { PortSource } from '../source/port';
import { RecordingSource } from '../source/recording';
import type { Source } from '../source/Source';
import type { Room, Shown } from './Room';

const patienceMs = 1500; // until a frame is missed; in a recording, up to its end

// Follows the title: what the source is doing.
const asides: Partial<Record<State, string>> = {
  choosing: ' (until the next one is ready)',
  opening: ' (opening)',
  reopening: ' (opening again)',
  failed: ' (not open)',
};

const nameOf = (source: Source): string =>
  source instanceof RecordingSource ? 'recording' : !(source instanceof PortSource) ? 'simulated' : source.isBoard ? 'board' : 'adapter';

export function sourceRoom(choice: Choice<Source>): Room {
  const guide = byId('guide');
  let enteredMs = 0;

  function enter(source: Source): void {
    enteredMs = performance.now();
    const name = nameOf(source);
    for (const each of ['simulated', 'adapter', 'board', 'recording']) {
      byId(`source-${each}`).setAttribute('aria-pressed', String(each === name));
    }
    byId('simulation').hidden = name !== 'simulated';
    byId('board').hidden = name !== 'board';
    guide.querySelectorAll<HTMLElement>('[data-for]').forEach((each) => (each.hidden = each.dataset.for !== name));
  }

  function draw({ source, status: { state, rows }, newest }: Shown): void {
    const doing = choice.doing || source.progress;
    setText(byId('title'), source.title + (source.device ? `, ${source.device}` : '') + (doing ? ` (${doing})` : (asides[choice.state] ?? '')));
    const isLate = source instanceof RecordingSource ? source.atEnd : performance.now() - enteredMs > patienceMs;
    const never = state === LinkState.NeverSeen && newest === undefined && rows === 0 && isLate;
    const { kind, flags } = newest ?? { kind: Kind.Frame, flags: 0 };
    const line = never ? 'none' : kind !== Kind.Row ? 'frames' : flags & Flag.HasFlags ? 'flagged-rows' : 'rows';
    if (document.body.dataset.line !== line) {
      document.body.dataset.line = line;
    }
    guide.hidden = !never;
  }

  return { views: { 'The choice of views': draw }, enter };
}
