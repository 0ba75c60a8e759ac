// Panes whose size the user changes, by a pointer or by keys, and which the browser stores.

import { byId } from '../dom';
import { keep, recall } from '../storage';

const step = 16; // px, of an arrow key

interface Pane {
  splitter: string; // its id
  pane: string; // of what has the size
  property: string; // CSS, in px
  across: boolean; // its width; otherwise its height
  least: number;
  most: number;
}

const panes: Pane[] = [
  { splitter: 'split-curves', pane: 'plot', property: '--curves', across: false, least: 160, most: 1200 },
  { splitter: 'split-channels', pane: 'channels', property: '--left', across: true, least: 340, most: 900 },
];

export function splitPanes(): void {
  panes.forEach((pane) => new Splitter(pane));
}

class Splitter {
  private readonly handle: HTMLElement;
  private readonly pane: HTMLElement;
  private from?: { at: number; size: number }; // where a drag began

  constructor(private readonly of: Pane) {
    this.handle = byId(of.splitter);
    this.pane = byId(of.pane);
    this.handle.setAttribute('aria-valuemin', String(of.least));
    this.handle.setAttribute('aria-valuemax', String(of.most));
    const kept = Number(recall(of.property.slice(2)));
    if (kept > 0) {
      this.set(kept);
    }
    new ResizeObserver(() => this.handle.setAttribute('aria-valuenow', String(Math.round(this.size)))).observe(this.pane);
    this.handle.addEventListener('pointerdown', (event) => {
      this.handle.setPointerCapture(event.pointerId);
      this.from = { at: this.place(event), size: this.size };
    });
    this.handle.addEventListener('pointermove', (event) => this.from && this.set(this.from.size + this.place(event) - this.from.at));
    for (const end of ['pointerup', 'pointercancel']) {
      this.handle.addEventListener(end, () => (this.from = undefined));
    }
    this.handle.addEventListener('dblclick', () => this.reset());
    this.handle.addEventListener('keydown', (event) => this.key(event));
  }

  private get size(): number {
    const { width, height } = this.pane.getBoundingClientRect();
    return this.of.across ? width : height;
  }

  private place({ clientX, clientY }: PointerEvent): number {
    return this.of.across ? clientX : clientY;
  }

  private key(event: KeyboardEvent): void {
    const { across, least, most } = this.of;
    const steps: Record<string, number> = across ? { ArrowLeft: -1, ArrowRight: 1 } : { ArrowUp: -1, ArrowDown: 1 };
    const by = steps[event.key];
    if (by !== undefined) {
      this.set(this.size + by * step);
    } else if (event.key === 'Home' || event.key === 'End') {
      this.set(event.key === 'Home' ? least : most);
    } else if (event.key === 'Enter') {
      this.reset();
    } else {
      return;
    }
    event.preventDefault();
  }

  private set(size: number): void {
    const { property, least, most } = this.of;
    const px = Math.round(Math.min(Math.max(size, least), most));
    document.documentElement.style.setProperty(property, `${px}px`);
    keep(property.slice(2), String(px));
  }

  // As wide or high as at first.
  private reset(): void {
    document.documentElement.style.removeProperty(this.of.property);
    keep(this.of.property.slice(2));
  }
}
