// Says what has failed, and what to do. It says nothing about the line, and fades; the verdict stays.

import { byId, setText } from '../dom';
import type { Problem } from '../messages';

const shownMs = 20000;

export class NoticeView {
  private readonly box = byId('notice');
  private timer?: number;
  private stays = false;

  constructor() {
    byId('notice-close').addEventListener('click', () => this.hide());
    for (const event of ['pointerenter', 'focusin']) {
      this.box.addEventListener(event, () => clearTimeout(this.timer)); // it is being read
    }
    for (const event of ['pointerleave', 'focusout']) {
      this.box.addEventListener(event, () => this.fade());
    }
  }

  // `stays`: until it is closed, or another one is shown.
  show({ text, remedy }: Problem, stays = false): void {
    this.stays = stays;
    setText(byId('notice-text'), text);
    setText(byId('notice-remedy'), remedy);
    this.box.hidden = false;
    this.fade();
  }

  hide(): void {
    clearTimeout(this.timer);
    this.box.hidden = true;
  }

  private fade(): void {
    clearTimeout(this.timer);
    if (this.stays) {
      return;
    }
    this.timer = setTimeout(() => this.hide(), shownMs);
  }
}
