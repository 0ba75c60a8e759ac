// Ties the rooms of the page to the source that is chosen, and draws them sixty times a second.

import { setZero } from './clock';
import type { Core } from './core';
import { keepRoom } from './rooms/keep';
import { lineRoom } from './rooms/line';
import { liveRoom } from './rooms/live';
import { recordingRoom } from './rooms/recording';
import type { Room } from './rooms/Room';
import { sourceRoom } from './rooms/source';
import { Choice } from './source/choice';
import type { Source } from './source/Source';
import type { NoticeView } from './view/notice';

// `failed`: called once for each view that throws: it is not drawn any more; the others are.
export function scopeOf(core: Core, notice: NoticeView, failed: (view: string, error: Error) => void) {
  const choice = new Choice<Source>(
    () => rooms.forEach((room) => room.leave?.()),
    (source) => {
      setZero(source.line.file.zeroUs ?? 0);
      rooms.forEach((room) => room.enter?.(source));
    },
  );
  const seeking = (): void => keep.endRecording();
  const line = lineRoom(core, choice, (us) => recording.visit(us), seeking);
  const keep = keepRoom(choice, line);
  const recording = recordingRoom(core, choice, line, seeking, notice);
  const live = liveRoom(core, choice, notice);
  const rooms: Room[] = [sourceRoom(choice), line, keep, recording, live];
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
