// What the user keeps of a line: a recording of it, its bookmarks, its values, a picture.

import { Bookmarks } from '../bookmarks';
import { byId, setText } from '../dom';
import { Kind } from '../line';
import { Recorder, saveCsv, savePicture } from '../recorder';
import type { Choice } from '../source/choice';
import { RecordingSource } from '../source/recording';
import type { Source } from '../source/Source';
import { BookmarksView } from '../view/bookmarks';
import type { NoticeView } from '../view/notice';
import type { LineRoom } from './line';

export type KeepRoom = ReturnType<typeof keepRoom>;

// `visit`: goes to a time of the line, in us.
export function keepRoom(choice: Choice<Source>, line: LineRoom, visit: (us: number) => void, notice: NoticeView) {
  const recorder = new Recorder();
  const bookmarks = new Bookmarks();
  // The time that is shown: a recording's position, or the curves' right edge.
  const shownUs = (): number => (choice.current instanceof RecordingSource ? choice.current.positionUs : line.curves.shownUs[1]);
  const list = new BookmarksView(bookmarks, shownUs, visit, (problem) => notice.show(problem));
  // How many bookmarks are lost with the line: the recording that runs, if one does, is saved.
  const lost = (): number => bookmarks.lost(recorder.on ? choice.current?.line.recordingUs : undefined);

  // Saves what was recorded.
  function endRecording(): void {
    if (recorder.on) {
      bookmarks.saved(choice.current?.line.recordingUs);
    }
    recorder.end(bookmarks.all, choice.current?.line.us ?? 0);
  }

  // Asks the user, if bookmarks would be lost with the line.
  function mayLeave(): boolean {
    const count = lost();
    return count === 0 || confirm(`${count === 1 ? 'A bookmark is' : `${count} bookmarks are`} not saved, and will be lost. Go on?`);
  }

  function draw(): void {
    recorder.poll();
    byId('record').setAttribute('aria-pressed', String(recorder.on));
    setText(byId('record-text'), recorder.on ? `Save ${Math.ceil(recorder.bytes / 1000)} kB` : 'Record');
  }

  byId('record').addEventListener('click', () => {
    const { current } = choice;
    if (recorder.on) {
      endRecording();
    } else if (current) {
      recorder.begin(current.line, current.title);
    }
  });
  addEventListener('beforeunload', (event) => (recorder.on || lost() > 0) && event.preventDefault());
  byId('csv').addEventListener('click', () => saveCsv(line.history, line.newest?.channels.length ?? 16, line.newest?.kind === Kind.Row));
  byId('picture').addEventListener('click', () => savePicture(line.curves.svg(choice.current?.title ?? '')));
  return {
    bookmarks, endRecording, mayLeave,
    views: { 'The recorder': draw, 'The view of the bookmarks': () => list.draw() },
    leave: endRecording,
    enter: (source: Source): void => list.enter(source),
  };
}
