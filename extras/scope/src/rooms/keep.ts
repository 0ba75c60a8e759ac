// What the user keeps of a line: a recording of it, or its values.

import { byId, setText } from '../dom';
import { Kind } from '../line';
import { Recorder, saveCsv } from '../recorder';
import type { Choice } from '../source/choice';
import type { Source } from '../source/Source';
import type { LineRoom } from './line';

export function keepRoom(choice: Choice<Source>, line: LineRoom) {
  const recorder = new Recorder();

  function draw(): void {
    recorder.poll();
    byId('record').setAttribute('aria-pressed', String(recorder.on));
    setText(byId('record-text'), recorder.on ? `Save ${Math.ceil(recorder.bytes / 1000)} kB` : 'Record');
  }

  byId('record').addEventListener('click', () => {
    const { current } = choice;
    if (recorder.on) {
      recorder.end();
    } else if (current) {
      recorder.begin(current.line, current.title);
    }
  });
  addEventListener('beforeunload', (event) => recorder.on && event.preventDefault());
  byId('csv').addEventListener('click', () => saveCsv(line.history, line.newest?.channels.length ?? 16, line.newest?.kind === Kind.Row));
  return {
    // Saves what was recorded.
    endRecording: () => recorder.end(),
    views: { 'The recorder': draw },
    leave: () => recorder.end(),
  };
}
