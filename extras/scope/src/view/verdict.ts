// The verdict's strip: what is wrong, and what to do. Screen readers hear it when it changes.

import type { Verdict } from '../doctor';
import { byId, setAttribute, setText } from '../dom';

export class VerdictView {
  private readonly strip = byId('verdict');
  private readonly text = byId('verdict-text');
  private readonly cure = byId('verdict-cure');
  private readonly note = byId('verdict-note');
  private readonly announcement = byId('announcement');
  private sinceMs = 0;

  draw(verdict: Verdict, note: string): void {
    if (this.text.textContent !== verdict.text) {
      this.sinceMs = performance.now();
    }
    setAttribute(this.strip, 'data-severity', verdict.severity);
    setText(this.text, verdict.text);
    setText(this.cure, verdict.cure);
    this.note.hidden = note === '';
    setText(this.note, note);
    // A link that flickers is not read out each time.
    if (performance.now() - this.sinceMs > 700) {
      setText(this.announcement, `${verdict.text} ${verdict.cure}`);
    }
  }
}
