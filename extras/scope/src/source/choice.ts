// The source that the page shows: always the one that was chosen last. The running source continues until the next one is ready,
// and also if that one fails.

import type { State } from '../messages';

interface Chosen {
  readonly state: State;
  close(): void;
}

export class Choice<Source extends Chosen> {
  current?: Source;
  private asking?: symbol;
  private preparing?: { abort: AbortController; doing: string };

  // `leaving`: called before the running source is closed. `entered`: called with each new one.
  constructor(
    private readonly leaving: () => void,
    private readonly entered: (source: Source) => void,
  ) {}

  // What is done until the next source is ready, or ''.
  get doing(): string {
    return this.preparing?.doing ?? '';
  }

  get state(): State {
    return this.asking || this.preparing ? 'choosing' : (this.current?.state ?? 'closed');
  }

  // Asks the user by a dialog of the browser. Throws what `question` throws; returns undefined instead if a later question or source
  // has replaced this one: a dialog may stay without an answer.
  async ask<Answer>(question: () => Promise<Answer>): Promise<Answer | undefined> {
    const asking = (this.asking = Symbol());
    try {
      return await question();
    } catch (error) {
      if (this.asking === asking) {
        throw error;
      }
      return undefined;
    } finally {
      this.asking = this.asking === asking ? undefined : this.asking;
    }
  }

  // Changes to another source. `prepare` does what takes time, may throw, and tells what it is doing; `signal` aborts when a later
  // source is chosen. The function that it returns makes the source, once the running one is closed.
  async change(prepare: (signal: AbortSignal, tell: (doing: string) => void) => Promise<() => Source>): Promise<void> {
    this.preparing?.abort.abort();
    const mine = { abort: new AbortController(), doing: '' };
    const { signal } = mine.abort;
    this.preparing = mine;
    this.asking = undefined;
    try {
      const make = await prepare(signal, (doing) => void (mine.doing = doing));
      if (!signal.aborted) {
        this.replace(make);
      }
    } catch (error) {
      if (!signal.aborted) {
        throw error;
      }
    } finally {
      this.preparing = mine === this.preparing ? undefined : this.preparing;
    }
  }

  private replace(make: () => Source): void {
    this.leaving();
    this.current?.close();
    this.current = undefined;
    this.current = make();
    this.entered(this.current);
  }
}
