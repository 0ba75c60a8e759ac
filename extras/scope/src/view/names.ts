// The channels' names, and which channels are hidden: the browser stores both. The panel replaces the bars while it is open.

import { byId, make, setText } from '../dom';
import { keep, recallObject } from '../storage';

const key = 'channels';
const longest = 12; // characters

export class Names {
  private kept: Record<string, unknown> = {}; // by channel, from 0 on: its name; hidden-0: true
  private readonly button = byId('names-open');
  private readonly panel = byId('names');
  private readonly note = byId('hidden-note');
  private count = 0;

  constructor() {
    this.button.addEventListener('click', () => this.turn(this.panel.hidden === true));
    byId('names-close').addEventListener('click', () => this.turn(false));
    byId('names-clear').addEventListener('click', () => {
      keep(key);
      this.build();
    });
    this.panel.addEventListener('keydown', (event) => {
      if (event.key === 'Escape' || (event.key === 'Enter' && event.target instanceof HTMLInputElement)) {
        event.preventDefault(); // Enter would press the button that gets the focus
        this.turn(false);
      }
    });
    this.build();
  }

  // Returns CH1, or "Throttle".
  of(channel: number): string {
    return this.given(channel) || `CH${channel + 1}`;
  }

  // Returns CH1, or "CH3 Throttle".
  inFull(channel: number): string {
    return `CH${channel + 1} ${this.given(channel)}`.trim();
  }

  isHidden(channel: number): boolean {
    return this.kept[`hidden-${channel}`] === true;
  }

  get any(): boolean {
    return Object.keys(this.kept).some((each) => this.given(Number(each)) !== '');
  }

  // `count`: of the line's channels.
  draw(count: number): void {
    if (count !== this.count) {
      this.count = count;
      this.build();
    }
    const hidden = Array.from({ length: count }, (_, i) => i).filter((i) => this.isHidden(i)).length;
    setText(this.note, hidden > 0 ? `${hidden} hidden` : '');
  }

  private given(channel: number): string {
    const name = this.kept[channel];
    return typeof name === 'string' ? name.replace(/[\s\p{Cc}]+/gu, ' ').trim().slice(0, longest) : '';
  }

  private turn(open: boolean): void {
    this.panel.hidden = !open;
    byId('bars').hidden = open;
    this.button.setAttribute('aria-expanded', String(open));
    (open ? this.panel.querySelector<HTMLElement>('[type="text"]') : this.button)?.focus();
  }

  // Takes what is stored, which another tab may have changed, with this change.
  private store(change: Record<string, unknown>): void {
    this.kept = { ...recallObject(key), ...change };
    keep(key, JSON.stringify(this.kept));
  }

  private build(): void {
    this.kept = recallObject(key) ?? {};
    byId('names-list').replaceChildren(...Array.from({ length: this.count }, (_, channel) => {
      const number = `CH${channel + 1}`;
      const shown = make('input', { type: 'checkbox', 'aria-label': `Show ${number}` });
      shown.checked = !this.isHidden(channel);
      shown.addEventListener('change', () => this.store({ [`hidden-${channel}`]: !shown.checked }));
      const name = make('input', { type: 'text', maxlength: longest, placeholder: number, 'aria-label': `Name of ${number}`, autocomplete: 'off', spellcheck: 'false' });
      name.value = this.given(channel);
      name.addEventListener('input', () => this.store({ [channel]: name.value }));
      return make('li', {}, make('label', {}, shown, number), name);
    }));
  }
}
