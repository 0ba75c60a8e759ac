// What the user keeps: a recording in the project's format, the numbers as CSV, or a picture.

import { Awake } from './awake';
import type { Core } from './core';
import { download } from './dom';
import { History } from './history';

const blobSize = 1 << 20; // characters; a browser may put a Blob on the disk

const stamp = (): string => new Date().toISOString().slice(0, 19).replace(/[-:]/g, '').replace('T', '-');

export class Recorder {
  on = false;
  bytes = 0;
  private text = '';
  private parts: Blob[] = [];
  private readonly awake = new Awake();

  constructor(private readonly core: Core) {}

  // `title`: what is recorded, for the first line.
  begin(title: string): void {
    this.on = true;
    this.text = `# ${title}\n# ${new Date().toISOString()}\n`;
    this.parts = [];
    this.bytes = this.text.length;
    this.core.record(true);
    this.awake.want(true);
  }

  // Call it often enough: for each picture, and each time that bytes have come.
  poll(): void {
    if (this.on) {
      this.append(this.core.takeRecorded());
    }
  }

  // Hands the file over.
  end(): void {
    if (!this.on) {
      return;
    }
    this.core.record(false);
    this.append(this.core.takeRecorded());
    this.on = false;
    this.awake.want(false);
    download(`sbus-${stamp()}.txt`, [...this.parts, this.text], 'text/plain');
    this.parts = [];
    this.text = '';
  }

  private append(text: string): void {
    this.text += text;
    this.bytes += text.length;
    if (this.text.length > blobSize) {
      this.parts.push(new Blob([this.text]));
      this.text = '';
    }
  }
}

// All that the history holds.
export function saveCsv(history: History, channels: number): void {
  const numbers = Array.from({ length: channels }, (_, i) => i);
  const lines = [['seconds', ...numbers.map((i) => `CH${i + 1}`), 'switch17', 'switch18', 'failsafe', 'lostFrame'].join(',')];
  for (let sample = history.begin; sample < history.end; sample++) {
    const values = numbers.map((i) => {
      const value = history.value(sample, i);
      return Number.isNaN(value) ? '' : +value.toPrecision(7);
    });
    const flags = [...history.switches(sample), Number(history.failsafe(sample)), Number(history.lost(sample))];
    lines.push([history.time(sample).toFixed(6), ...values, ...flags].join(','));
  }
  download(`sbus-${stamp()}.csv`, [lines.join('\n'), '\n'], 'text/csv');
}

export function savePicture(svg: string): void {
  download(`sbus-${stamp()}.svg`, [svg], 'image/svg+xml');
}
