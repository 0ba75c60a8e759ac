// Says what has failed, and what to do. It says nothing about the line, and fades by its style, but not while it is read; the verdict stays.

import { byId, setText } from '../dom';
import type { Problem } from '../messages';

export class NoticeView {
  private readonly box = byId('notice');

  constructor() {
    byId('notice-close').addEventListener('click', () => this.hide());
    this.box.addEventListener('animationend', () => this.hide());
  }

  // `stays`: until it is closed, or another one is shown.
  show({ text, remedy }: Problem, stays = false): void {
    this.box.classList.toggle('stays', stays);
    setText(byId('notice-text'), text);
    setText(byId('notice-remedy'), remedy);
    this.box.hidden = false;
    for (const fading of this.box.getAnimations()) {
      fading.currentTime = 0;
    }
  }

  hide(): void {
    this.box.hidden = true;
  }
}
