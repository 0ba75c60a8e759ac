// A recording's time line.

import { byId, setText } from '../dom';
import type { RecordingSource } from '../source/recording';

const clock = (us: number): string => {
  const tenths = Math.floor(us / 1e5);
  return `${Math.floor(tenths / 600)}:${((tenths % 600) / 10).toFixed(1).padStart(4, '0')}`;
};

export class Timeline {
  private source?: RecordingSource;
  private readonly panel = byId('timeline');
  private readonly play = byId('play');
  private readonly position = byId<HTMLInputElement>('position');
  private readonly text = byId('position-text');
  private readonly speed = byId<HTMLSelectElement>('speed');
  private readonly loop = byId<HTMLInputElement>('loop');

  // `leaving`: called before another place of the recording is sought.
  constructor(private readonly leaving: () => void) {
    this.play.addEventListener('click', () => this.toggle());
    this.position.addEventListener('input', () => this.seek(Number(this.position.value) * 1000));
    this.speed.addEventListener('change', () => this.apply());
    this.loop.addEventListener('change', () => this.apply());
  }

  show(source: RecordingSource | undefined): void {
    this.source = source;
    this.panel.hidden = !source;
    if (source) {
      this.position.max = String(Math.ceil(source.lengthUs / 1000));
      this.apply();
    }
  }

  draw(): void {
    const source = this.source;
    if (!source) {
      return;
    }
    if (source.atEnd && source.playing) {
      if (source.loop) {
        this.seek(0);
      } else {
        source.playing = false;
      }
    }
    setText(this.play, source.playing ? 'Pause' : 'Play');
    this.play.setAttribute('aria-pressed', String(source.playing));
    this.position.value = String(Math.floor(source.positionUs / 1000));
    this.position.setAttribute('aria-valuetext', `${clock(source.positionUs)} of ${clock(source.lengthUs)}`);
    setText(this.text, `${clock(source.positionUs)} / ${clock(source.lengthUs)}`);
  }

  private toggle(): void {
    const source = this.source;
    if (source) {
      if (source.atEnd) {
        this.seek(0);
      }
      source.playing = !source.playing;
    }
  }

  private seek(us: number): void {
    if (this.source) {
      this.leaving();
      this.source.seek(us);
    }
  }

  private apply(): void {
    if (this.source) {
      this.source.speed = Number(this.speed.value);
      this.source.loop = this.loop.checked;
    }
  }
}
