// A file that is played: chosen, dropped, or another signal of the same capture; its time line and its wire.

import type { Core } from '../core';
import { byId } from '../dom';
import type { Problem } from '../messages';
import type { Choice } from '../source/choice';
import { RecordingSource } from '../source/recording';
import type { Source } from '../source/Source';
import type { NoticeView } from '../view/notice';
import { Timeline } from '../view/timeline';
import { WireView } from '../view/wire';
import type { LineRoom } from './line';
import type { Room } from './Room';

// `seeking`: called before another place is sought. `visit` of what it returns goes to a time, in us, and stops there.
export function recordingRoom(core: Core, choice: Choice<Source>, { curves }: LineRoom, seeking: () => void, notice: NoticeView): Room & { visit(us: number): void } {
  const timeline = new Timeline(seeking);
  const wire = new WireView();
  const signal = byId<HTMLSelectElement>('wire-signal');
  const playing = (): RecordingSource | undefined => (choice.current instanceof RecordingSource ? choice.current : undefined);

  async function play(file: File, ofCapture?: string, before?: RecordingSource): Promise<void> {
    notice.hide();
    try {
      const read = (part: number): void => void (choice.doing = `reading ${file.name}: ${Math.floor(100 * part)} %`);
      await choice.change((abort) => RecordingSource.read(core, file, abort, read, ofCapture, before));
    } catch (error) {
      notice.show(unreadable(error));
    } finally {
      choice.doing = '';
    }
  }

  const input = byId<HTMLInputElement>('file');
  byId('source-recording').addEventListener('click', () => input.click());
  input.addEventListener('change', () => {
    const [file] = input.files ?? [];
    if (file) {
      void play(file);
    }
    input.value = '';
  });
  onDrop(play, notice);
  signal.addEventListener('change', () => {
    const source = playing();
    return source && play(source.file, signal.value, source);
  });
  return {
    views: {
      'The view of the wire': () => wire.draw(),
      'The time line': () => timeline.draw(...curves.shownUs),
    },
    enter: () => {
      wire.show(playing());
      timeline.show(playing());
    },
    repaint: () => wire.repaint(),
    visit: (us) => timeline.visit(us),
  };
}

// Calls `take` with a file that is dropped on the page.
function onDrop(take: (file: File) => Promise<void>, notice: NoticeView): void {
  const curtain = byId('drop');
  const hasFile = ({ dataTransfer }: DragEvent): boolean => dataTransfer?.types.includes('Files') ?? false;
  addEventListener('dragover', (event) => {
    if (hasFile(event)) {
      event.preventDefault();
      curtain.hidden = false;
    }
  });
  addEventListener('dragleave', (event) => (curtain.hidden ||= event.relatedTarget === null));
  addEventListener('drop', (event) => {
    curtain.hidden = true;
    const [item] = event.dataTransfer?.items ?? [];
    const [file, other] = event.dataTransfer?.files ?? [];
    if (file) {
      event.preventDefault();
    }
    if (item?.webkitGetAsEntry?.()?.isDirectory) {
      notice.show({ text: `${file.name} is a folder.`, remedy: 'Drop a recording or a capture that is in it.' });
    } else if (file) {
      void take(file);
      if (other) {
        notice.show({ text: `Only ${file.name} is played.`, remedy: 'Drop one file at a time.' });
      }
    }
  });
}

// Returns what is wrong with a file, from what its reader throws.
const unreadable = (error: unknown): Problem =>
  !(error instanceof Error) ? (error as Problem) : {
    text: `This cannot be played: ${error.message}.`,
    remedy: 'A line of a recording holds a time in microseconds, then bytes in hexadecimal: 120 0F E5 03 ... A capture of the wire is VCD, a session of PulseView (.sr), or CSV of Saleae, PulseView, DSView or an oscilloscope; sbus decode also takes options.',
  };
