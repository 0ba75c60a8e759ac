// Tells screen readers a text: once it has stood for a moment, and never several in a row, however often it changes.

import { setText } from '../dom';

const standsMs = 700;
const restMs = 5000;

export class Announcer {
  private text = '';
  private sinceMs = 0;
  private saidMs = -restMs;

  constructor(private readonly region: HTMLElement) {}

  // Call it for each picture.
  say(text: string): void {
    const now = performance.now();
    if (text !== this.text) {
      this.text = text;
      this.sinceMs = now;
    }
    if (text !== this.region.textContent && now - this.sinceMs > standsMs && now - this.saidMs > restMs) {
      this.saidMs = now;
      setText(this.region, text);
    }
  }
}
