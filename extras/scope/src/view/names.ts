// The panel that names and hides channels: it replaces the bars while it is open.

import { longestName, type Channels } from '../channels';
import { byId, make, setText } from '../dom';

export class NamesView {
  private readonly button = byId('names-open');
  private readonly panel = byId('names');
  private readonly list = byId('names-list');
  private readonly note = byId('hidden-note');
  private count = 0;

  constructor(private readonly channels: Channels) {
    this.button.addEventListener('click', () => this.turn(this.panel.hidden !== false));
    byId('names-close').addEventListener('click', () => this.turn(false));
    byId('names-clear').addEventListener('click', () => {
      channels.forget();
      this.build();
    });
    this.panel.addEventListener('keydown', (event) => {
      if (event.key === 'Escape' || (event.key === 'Enter' && event.target instanceof HTMLInputElement)) {
        event.preventDefault(); // Enter would press the button that gets the focus
        this.turn(false);
      }
    });
  }

  draw(count: number): void {
    if (count !== this.count) {
      this.count = count;
      this.build();
    }
    const hidden = Array.from({ length: count }, (_, i) => i).filter((i) => this.channels.isHidden(i)).length;
    this.note.hidden = hidden === 0;
    setText(this.note, hidden === 1 ? '1 channel is hidden.' : `${hidden} channels are hidden.`);
  }

  private turn(open: boolean): void {
    this.panel.hidden = !open;
    byId('bars').hidden = open;
    this.button.setAttribute('aria-expanded', String(open));
    if (open) {
      this.list.querySelector<HTMLInputElement>('input[type="text"]')?.focus();
    } else {
      this.button.focus();
    }
  }

  private build(): void {
    this.list.replaceChildren(...Array.from({ length: this.count }, (_, channel) => this.row(channel)));
  }

  private row(channel: number): HTMLElement {
    const number = `CH${channel + 1}`;
    const shown = make('input', { type: 'checkbox', 'aria-label': `Show ${number}` });
    shown.checked = !this.channels.isHidden(channel);
    shown.addEventListener('change', () => this.channels.hide(channel, !shown.checked));
    const name = make('input', {
      type: 'text', maxlength: longestName, placeholder: number, 'aria-label': `Name of ${number}`, autocomplete: 'off', spellcheck: 'false',
    });
    name.value = this.channels.givenName(channel);
    name.addEventListener('input', () => this.channels.rename(channel, name.value));
    return make('li', {}, make('label', { class: 'check' }, shown, number), name);
  }
}
