// The channels' names, which channels are hidden, and which have a curve. The browser stores the names and the hidden channels.

import { History } from './history';
import { keep, recallObject } from './storage';
import { tidied } from './text';

const key = 'channels';
export const longestName = 16; // characters

export class Channels {
  readonly curves = new Set([0, 1, 2, 3]);
  private readonly names = new Map<number, string>();
  private readonly hidden = new Set<number>();

  constructor() {
    this.recall();
  }

  // Takes what is stored: another tab may have stored more.
  private recall(): void {
    const kept = recallObject(key);
    if (!kept) {
      return;
    }
    this.names.clear();
    this.hidden.clear();
    const names = typeof kept.names === 'object' && kept.names ? kept.names : {};
    const known = (channel: unknown): boolean => Number.isInteger(channel) && Number(channel) >= 0 && Number(channel) < History.channels;
    for (const [channel, name] of Object.entries(names)) {
      if (known(Number(channel)) && typeof name === 'string') {
        this.set(Number(channel), name);
      }
    }
    for (const channel of Array.isArray(kept.hidden) ? kept.hidden.filter(known) : []) {
      this.hidden.add(channel as number);
    }
  }

  // Returns its name, or CH1.
  name(channel: number): string {
    return this.names.get(channel) ?? `CH${channel + 1}`;
  }

  // Returns '' if it has no name.
  givenName(channel: number): string {
    return this.names.get(channel) ?? '';
  }

  // Returns CH1, or "Throttle (CH3)".
  fullName(channel: number): string {
    const name = this.names.get(channel);
    return name ? `${name} (CH${channel + 1})` : `CH${channel + 1}`;
  }

  get anyNamed(): boolean {
    return this.names.size > 0;
  }

  // Names a channel; '' removes its name.
  rename(channel: number, name: string): void {
    this.recall();
    this.set(channel, name);
    this.keep();
  }

  isHidden(channel: number): boolean {
    return this.hidden.has(channel);
  }

  hide(channel: number, hidden: boolean): void {
    this.recall();
    this.hidden[hidden ? 'add' : 'delete'](channel);
    this.keep();
  }

  forget(): void {
    this.names.clear();
    this.hidden.clear();
    keep(key);
  }

  // Returns which of the first `count` channels have a visible curve, in ascending order.
  drawn(count: number): number[] {
    return [...this.curves].filter((channel) => channel < count && !this.isHidden(channel)).sort((a, b) => a - b);
  }

  private set(channel: number, name: string): void {
    const short = tidied(name, longestName);
    if (short === '' || short === `CH${channel + 1}`) {
      this.names.delete(channel);
    } else {
      this.names.set(channel, short);
    }
  }

  private keep(): void {
    keep(key, JSON.stringify({ names: Object.fromEntries(this.names), hidden: [...this.hidden] }));
  }
}
