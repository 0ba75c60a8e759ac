// Tells screen readers a text once it has not changed for a moment, and not too soon after the last one.

import { setText } from '../dom';

const standsMs = 700;

export class Announcer {
  private text = '';
  private sinceMs = 0;
  private saidMs = -Infinity;

  constructor(
    private readonly region: HTMLElement,
    private readonly restMs = 5000,
  ) {}

  // Call it for each picture.
  say(text: string): void {
    const now = performance.now();
    if (text !== this.text) {
      this.text = text;
      this.sinceMs = now;
    }
    if (text !== this.region.textContent && now - this.sinceMs > standsMs && now - this.saidMs > this.restMs) {
      this.saidMs = now;
      setText(this.region, text);
    }
  }
}
