// A second line beside the one that is shown: a recording beside a recording, a port beside a port.

import type { Core } from '../core';
import { byId, onFile } from '../dom';
import type { Problem } from '../messages';
import type { Choice } from '../source/choice';
import { pickPort } from '../source/pick';
import { PortSource } from '../source/port';
import { RecordingSource } from '../source/recording';
import { type Second, SecondPort, SecondRecording } from '../source/second';
import type { Source } from '../source/Source';
import type { NoticeView } from '../view/notice';
import { SecondView } from '../view/second';
import type { LineRoom } from './line';
import { unreadable } from './recording';
import type { Room } from './Room';

// `visit`: goes to a time of the line, in us.
export function compareRoom(core: Core, choice: Choice<Source>, { curves }: LineRoom, visit: (us: number) => void, notice: NoticeView): Room {
  const view = new SecondView(visit, () => end());
  let second: Second | undefined;
  let asking: AbortController | undefined;

  function end(): void {
    asking?.abort();
    second?.close();
    second = undefined;
    view.show(undefined);
  }

  async function begin(read: (signal: AbortSignal) => Promise<Second>): Promise<void> {
    end();
    const { signal } = (asking = new AbortController());
    try {
      second = await read(signal);
      view.show(second);
    } catch (error) {
      if (!signal.aborted) {
        notice.show(unreadable(error));
      }
    }
  }

  byId('compare').addEventListener('click', async () => {
    const { current } = choice;
    notice.hide();
    if (current instanceof PortSource) {
      const port = await pickPort('adapter').catch((problem: Problem) => notice.show(problem));
      if (port && choice.current === current) {
        await begin((signal) => SecondPort.open(core, port, current, signal));
      }
    } else {
      byId('second-file').click();
    }
  });
  onFile('second-file', async (file) => {
    const { current } = choice;
    notice.hide();
    if (current instanceof RecordingSource) {
      await begin((signal) => SecondRecording.read(core, file, current, signal));
    }
  });
  const draw: Room['views'][string] = () => {
    second?.follow();
    view.draw(curves.shownAs);
  };
  return { views: { 'The comparison': draw }, leave: end, repaint: () => view.repaint() };
}
