// Ties the rooms of the page to the source that is chosen, and draws them sixty times a second.

import { Finding, Flag, Kind, LinkState } from './border';
import { setZero } from './clock';
import type { Core } from './core';
import { byId, setText } from './dom';
import type { State } from './messages';
import { channelsRoom } from './rooms/channels';
import { keepRoom } from './rooms/keep';
import { lineRoom } from './rooms/line';
import { liveRoom } from './rooms/live';
import { recordingRoom } from './rooms/recording';
import type { Room, Shown } from './rooms/Room';
import { verdictRoom } from './rooms/verdict';
import { Choice } from './source/choice';
import { PortSource } from './source/port';
import { RecordingSource } from './source/recording';
import type { Source } from './source/Source';
import type { NoticeView } from './view/notice';

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

// `failed`: called once for each view that throws: it is not drawn any more; the others are.
export function scopeOf(core: Core, notice: NoticeView, failed: (view: string, error: Error) => void) {
  const choice = new Choice<Source>(
    () => rooms.forEach((room) => room.leave?.()),
    (source) => {
      setZero(source.line.file.zeroUs ?? 0);
      rooms.forEach((room) => room.enter?.(source));
    },
  );
  const line = lineRoom(core, choice);
  const live = liveRoom(core, choice, notice);
  const rooms: Room[] = [sourceRoom(choice), verdictRoom(core, choice, line), line, channelsRoom(core, choice, line), keepRoom(choice, line), recordingRoom(core, choice, line, notice), live];
  const broken = new Set<string>(); // views

  function draw(): void {
    const source = choice.current;
    if (!source) {
      return;
    }
    const shown = line.show(source);
    for (const [view, draw] of rooms.flatMap(({ views }) => Object.entries(views)).filter(([view]) => !broken.has(view))) {
      try {
        draw(shown);
      } catch (error) {
        broken.add(view);
        failed(view, error as Error);
      }
    }
  }

  return { begin: live.simulate, draw, repaint: () => rooms.forEach((room) => room.repaint?.()) };
}

// Which source it is: its button, its choices and its title. A board shows what it has, and a line that never brought a frame how to
// bring one.
function sourceRoom(choice: Choice<Source>): Room {
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
    const { round = Finding.NoSignal } = source.line.picture.live ?? {};
    guide.hidden = !never || (round >= Finding.IBus && round <= Finding.IdleLevel); // its wires are right
  }

  return { views: { 'The choice of views': draw }, enter };
}
