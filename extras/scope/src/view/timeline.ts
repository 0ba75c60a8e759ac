// A recording's time line.

import { clock } from '../clock';
import { byId, setAttribute, setText } from '../dom';
import type { RecordingSource } from '../source/recording';
import { Throttle } from '../throttle';
import { ReportView } from './report';
import { namesOf, Strip } from './strip';

const stepUs = 1000000; // of an arrow key
const leastSteps = 100; // from end to end
const toldMs = 1000; // from one text for screen readers to the next, while it plays

export class Timeline {
  private source?: RecordingSource;
  private readonly telling = new Throttle(toldMs);
  private readonly strip = new Strip();
  private readonly report = new ReportView((us) => this.source?.visit(us));
  private readonly panel = byId('timeline');
  private readonly play = byId('play');
  private readonly position = byId<HTMLInputElement>('position');
  private readonly text = byId('position-text');
  private readonly speed = byId<HTMLSelectElement>('speed');
  private readonly loop = byId<HTMLInputElement>('loop');

  constructor() {
    this.play.addEventListener('click', () => this.toggle());
    this.position.addEventListener('input', () => this.source?.seek(Number(this.position.value) * 1000));
    this.position.addEventListener('keydown', (event) => this.step(event));
    this.speed.addEventListener('change', () => this.apply());
    this.loop.addEventListener('change', () => this.apply());
    byId('fault-back').addEventListener('click', () => this.seekFault(true));
    byId('fault-next').addEventListener('click', () => this.seekFault(false));
    for (const root of [byId('plot'), this.panel]) {
      root.addEventListener('keydown', (event) => this.key(event));
    }
  }

  show(source: RecordingSource | undefined): void {
    this.source = source;
    this.panel.hidden = !source;
    this.strip.filter();
    this.report.draw(source);
    if (source) {
      this.position.max = String(Math.ceil(source.endUs / 1000));
      this.apply();
    }
  }

  // `from`, `to`: what the curves show, in us.
  draw(from: number, to: number): void {
    const source = this.source;
    if (!source) {
      return;
    }
    if (source.atEnd && source.playing) {
      if (source.loop) {
        source.seek(0);
      } else {
        source.playing = false;
      }
    }
    setText(this.play, source.playing ? 'Pause' : 'Play');
    this.play.setAttribute('aria-pressed', String(source.playing));
    this.position.value = String(Math.floor(source.positionUs / 1000));
    this.tell(source);
    setText(this.text, `${clock(source.positionUs, 1)} / ${clock(source.lengthUs, 1)}`);
    this.strip.draw(source, from, to);
    this.report.draw(source);
  }

  private tell(source: RecordingSource): void {
    if (!source.playing || this.telling.due) {
      const names = namesOf(source.line.picture.faults);
      setAttribute(this.position, 'aria-valuetext', `${clock(source.positionUs, 1)} of ${clock(source.lengthUs, 1)}${names && `, ${names}`}`);
    }
  }

  private toggle(): void {
    const source = this.source;
    if (source) {
      if (source.atEnd) {
        source.seek(0);
      }
      source.playing = !source.playing;
    }
  }

  private seekFault(back: boolean): void {
    this.source?.seekFault(back, this.strip.only);
  }

  // N goes to the next fault; P, or Shift and N, to the one before; but not in a list, where a letter chooses.
  private key(event: KeyboardEvent): void {
    const key = event.key.toLowerCase();
    const isPlain = !event.ctrlKey && !event.metaKey && !event.altKey && !(event.target instanceof HTMLSelectElement);
    if (isPlain && this.source && (key === 'n' || key === 'p')) {
      event.preventDefault();
      this.seekFault(key === 'p' || event.shiftKey);
    }
  }

  // Seeks by an arrow key of the slider; the browser handles PageUp, Home and so on.
  private step(event: KeyboardEvent): void {
    const steps = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
    if (steps !== undefined && this.source) {
      event.preventDefault();
      const { positionUs, lengthUs } = this.source;
      this.source.seek(Math.max(positionUs + steps * Math.min(stepUs, lengthUs / leastSteps), 0));
    }
  }

  private apply(): void {
    if (this.source) {
      this.source.speed = Number(this.speed.value);
      this.source.loop = this.loop.checked;
    }
  }
}
