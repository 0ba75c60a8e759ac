// What the user keeps of a line: a recording of it in the project's format, or its values as CSV.

import { clock, shownSeconds } from '../clock';
import { byId, download, setText } from '../dom';
import type { History } from '../history';
import type { Choice } from '../source/choice';
import type { Remote } from '../source/remote';
import type { Source } from '../source/Source';
import type { LineRoom } from './line';
import type { Room } from './Room';

const blobSize = 1 << 20; // characters; a browser may put a Blob on the disk

const stamp = (): string => new Date().toISOString().slice(0, 19).replace(/[-:]/g, '').replace('T', '-');

class Recorder {
  bytes = 0;
  private text = '';
  private parts: Blob[] = [];
  private readonly awake = new Awake();
  private line?: Remote; // that is recorded

  get on(): boolean {
    return this.line !== undefined;
  }

  // `title`: what is recorded, for the first line.
  begin(line: Remote, title: string): void {
    this.line = line;
    this.text = `# ${title}\n# ${new Date().toISOString()}\n`;
    this.parts = [];
    this.bytes = this.text.length;
    line.ask({ kind: 'record', on: true });
    line.leaving = (): void => this.end();
    this.awake.want(true);
  }

  // Takes what was recorded. Call it for each picture, and also while none is drawn.
  poll(): void {
    const text = this.line?.takeRecorded() ?? '';
    this.text += text;
    this.bytes += text.length;
    if (this.text.length > blobSize) {
      this.parts.push(new Blob([this.text]));
      this.text = '';
    }
  }

  // Saves the file once the line has handed over the rest.
  end(): void {
    const { line } = this;
    if (!line) {
      return;
    }
    this.line = undefined;
    line.leaving = (): void => undefined;
    this.awake.want(false);
    const parts = [...this.parts, this.text];
    this.parts = [];
    this.text = '';
    void line.endRecorded().then((rest) => download(`sbus-${stamp()}.txt`, [...parts, rest], 'text/plain'));
  }
}

export function keepRoom(choice: Choice<Source>, line: LineRoom): Room {
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
  byId('csv').addEventListener('click', () => saveCsv(line.history, line.newest?.channels.length ?? 16));
  return { views: { 'The recorder': draw }, leave: () => recorder.end() };
}

// Saves all that the history holds, of which the file's name has begin and end, with the names that `sbus csv` writes and reads.
function saveCsv(history: History, channels: number): void {
  const numbers = Array.from({ length: channels }, (_, i) => i);
  const switches = channels <= 16 ? ['CH17', 'CH18'] : channels === 32 ? ['DG1', 'DG2'] : [];
  const lines = [['time', ...numbers.map((i) => `CH${i + 1}`), ...switches, 'failsafe', 'lostframe'].join(',')];
  for (let sample = history.begin; sample < history.end; sample++) {
    const values = numbers.map((i) => {
      const value = history.value(sample, i);
      return Number.isNaN(value) ? '' : +value.toPrecision(7);
    });
    const flags = [...history.switches(sample).slice(0, switches.length), Number(history.failsafe(sample)), Number(history.lost(sample))];
    lines.push([shownSeconds(history.time(sample)).toFixed(6), ...values, ...flags].join(','));
  }
  const shortOf = (sample: number): string => clock(1e6 * history.time(sample)).replace(/:(\d+)\..*/, 'm$1s');
  const ends = history.end > history.begin ? [shortOf(history.begin), shortOf(history.end - 1)] : [];
  download(`${['sbus', stamp(), ...ends].join('-')}.csv`, [lines.join('\n'), '\n'], 'text/csv');
}

// Keeps the screen on, and thereby the PC awake, while that is wanted. A browser releases the lock of a hidden page, and may
// reject it (low battery, no such feature): then the PC goes to sleep as usual.
class Awake {
  private wanted = false;
  private lock?: WakeLockSentinel;
  private turn = Promise.resolve(); // one request after the other

  constructor() {
    document.addEventListener('visibilitychange', () => this.settle());
  }

  want(on: boolean): void {
    this.wanted = on;
    this.settle();
  }

  private settle(): void {
    this.turn = this.turn.then(() => this.ask()).catch(() => undefined);
  }

  private async ask(): Promise<void> {
    if (!this.wanted) {
      await this.lock?.release();
    } else if (document.visibilityState === 'visible' && this.lock?.released !== false) {
      this.lock = await navigator.wakeLock?.request('screen');
    }
  }
}
