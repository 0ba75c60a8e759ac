// The verdict's strip: what is wrong, and what to do. Screen readers hear it when it changes.

import type { Verdict } from '../doctor';
import { byId, setAttribute, setText } from '../dom';
import { Announcer } from './announcer';

export class VerdictView {
  private readonly strip = byId('verdict');
  private readonly text = byId('verdict-text');
  private readonly remedy = byId('verdict-remedy');
  private readonly note = byId('verdict-note');
  private readonly announcer = new Announcer(byId('announcement'));

  draw(verdict: Verdict, note: string): void {
    setAttribute(this.strip, 'data-severity', verdict.severity);
    setText(this.text, verdict.text);
    setText(this.remedy, verdict.remedy);
    this.note.hidden = note === '';
    setText(this.note, note);
    this.announcer.say(`${verdict.text} ${verdict.remedy}`);
  }
}
