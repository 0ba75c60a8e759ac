// The counters, by cause. Those at 0 are not shown.

import type { Status } from '../border';
import { byId, make, setText } from '../dom';
import type { Picture } from '../messages';
import { Throttle } from '../throttle';

const rows: [keyof Status, string, string][] = [
  ['frames', 'frames', 'delivered'],
  ['lostFrames', 'lost frames', 'frames with the lost-frame flag'],
  ['failsafeFrames', 'failsafe frames', 'with the failsafe flag'],
  ['extraFrames', '2F frames', 'with CH17..CH32'],
  ['rejectedByEnd', 'rejected: end', 'no end byte at the end'],
  ['rejectedByFlags', 'rejected: flags', 'unused bits of the flags set'],
  ['rejectedByLength', 'rejected: size', 'more bytes follow directly, or there is a gap inside'],
  ['discardedBytes', 'discarded bytes', 'bytes that belong to neither a frame nor telemetry'],
  ['resyncs', 'resyncs', 'frames were found again after some were missed'],
  ['characterErrors', 'character errors', 'wrong parity or stop bit, or a break'],
  ['lateReads', 'late reads', 'port reads that came 0.1 s or more late, because the PC was busy. What the line did then is not known'],
  ['rows', 'rows', 'rows of numbers that a board printed'],
  ['otherLines', 'other lines', 'lines of text that a board printed'],
];

export class CountersView {
  private readonly list = byId('counters');
  private readonly values = new Map<string, HTMLElement>();
  private readonly text = new Throttle(200);

  constructor() {
    rows.forEach(([key, name, title]) => this.add(key, name, title));
  }

  draw({ status, live }: Picture): void {
    if (!this.text.due) {
      return;
    }
    const events = live?.events;
    this.list.classList.toggle('board', status.rows > 0 && status.frames === 0);
    const ofPort = [...this.values.keys()].filter((key) => key.startsWith('port ') && !events?.has(key.slice(5)));
    ofPort.forEach((key) => this.set(key, 0));
    rows.forEach(([key]) => this.set(key, status[key]));
    events?.forEach((count, what) => {
      const key = `port ${what}`;
      if (!this.values.has(key)) {
        this.add(key, what, 'reported by the port');
      }
      this.set(key, count);
    });
  }

  private add(key: string, name: string, title: string): void {
    const value = make('dd', { 'data-counter': key }, '0');
    this.list.append(make('div', { title, class: key === 'rows' || key === 'otherLines' || key.startsWith('port ') ? '' : 'sbus' }, make('dt', {}, name), value));
    this.values.set(key, value);
  }

  private set(key: string, count: number): void {
    const value = this.values.get(key) as HTMLElement;
    setText(value, count.toLocaleString('en').replaceAll(',', '\u202f'));
    const row = value.parentElement as HTMLElement;
    row.hidden = count === 0 && key !== 'frames';
  }
}
