// A file that is played: chosen, dropped, or another signal of the same capture; its time line and its wire.

import { Kind } from '../border';
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

export function recordingRoom(core: Core, choice: Choice<Source>, { curves }: LineRoom, notice: NoticeView): Room {
  const timeline = new Timeline();
  const wire = new WireView();
  const signal = byId<HTMLSelectElement>('wire-signal');
  const playing = (): RecordingSource | undefined => (choice.current instanceof RecordingSource ? choice.current : undefined);

  async function play(file: File, ofCapture?: string, before?: RecordingSource): Promise<void> {
    notice.hide();
    try {
      await choice.change((abort, tell) =>
        RecordingSource.read(core, file, abort, (part) => tell(`reading ${file.name}: ${Math.floor(100 * part)} %`), ofCapture, before));
    } catch (error) {
      notice.show(unreadable(error));
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
      'The view of the wire': ({ newest }) => wire.draw(newest?.kind === Kind.Row ? undefined : newest),
      'The time line': () => timeline.draw(...curves.shownUs),
    },
    enter: () => {
      wire.show(playing());
      timeline.show(playing());
    },
    repaint: () => wire.repaint(),
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
    const entry = item?.webkitGetAsEntry?.();
    if (file) {
      event.preventDefault();
    }
    if (entry?.isDirectory) {
      void only(entry as FileSystemDirectoryEntry).then((found) =>
        found ? take(found) : notice.show({ text: `${file.name} is a folder.`, remedy: 'Drop one of the files that are in it.' }));
    } else if (file) {
      void take(file);
      if (other) {
        notice.show({ text: `Only ${file.name} is played.`, remedy: 'Drop one file at a time.' });
      }
    }
  });
}

// Returns the only file in a folder. Those that the system hides do not count.
async function only(folder: FileSystemDirectoryEntry): Promise<File | undefined> {
  const entries = await new Promise<FileSystemEntry[]>((resolve) => folder.createReader().readEntries(resolve, () => resolve([])));
  const [entry, ...others] = entries.filter(({ name }) => !name.startsWith('.'));
  return entry?.isFile && others.length === 0 ? new Promise((resolve) => (entry as FileSystemFileEntry).file(resolve, () => resolve(undefined))) : undefined;
}

// Returns what is wrong with a file, from what its reader throws: "NAME: line 3: ...", "NAME:3: ..." or "NAME: is empty".
function unreadable(error: unknown): Problem {
  if (!(error instanceof Error)) {
    return error as Problem;
  }
  const text = error.message.replace(/^(.*?):(?: line )?(\d+): /, 'In line $2 of $1, ').replace(/^([^:]*): (is|has|ends|cannot) /, '$1 $2 ').replace(/; sbus decode [^;]*$/, '');
  return { text: text.replace(/[^?.]$/, '$&.'), remedy: /^[^:]* is (a picture|no)/.test(text) ? forms : '' };
}

const forms = 'The page plays recordings (a time in microseconds, then bytes in hexadecimal: 120 0F E5 03), bytes as text, JSON lines, CSV, and captures of the wire: VCD, a session of PulseView (.sr), or CSV of Saleae, PulseView, DSView or an oscilloscope.';
