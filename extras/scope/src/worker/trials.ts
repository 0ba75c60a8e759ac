// While no frame comes, tries the other settings of a live line's port.

import { Finding, type Status } from '../border';
import type { Problem, Setting, State } from '../messages';
import type { Native } from '../native';

const trialMs = 500; // half a second has 12 frames of the slowest receiver known
const patienceMs = 1000; // without a frame, until other settings are tried
const pauseMs = 2000; // from one round of trials to the next

// What has the port.
export interface Tried {
  // The settings that its port can have, the expected one first; one if there is nothing to try.
  readonly settings: readonly Setting[];
  // Bytes come only while it is open.
  readonly state: State;
  readonly problem?: Problem;
  // Sets the port. Resolves once it has that setting.
  use(setting: Setting): Promise<void>;
}

const words = (setting: Setting): string => `${setting.baud} baud${setting.inverted ? ', inverted' : ', not inverted'}`;

export class Trials {
  round?: Finding; // of the last round
  private found = ''; // by trying: the port now has that setting
  private trying?: Setting;
  private trial = 0; // of the round
  private sinceMs = performance.now(); // when the trial began, or the port was opened
  private seen = false; // a frame or a row, since the source was opened
  private pausedUntilMs = 0;

  constructor(
    private readonly native: Native,
    private readonly source: Tried,
  ) {}

  // The setting that is being tried, or what the trials found.
  get note(): string {
    return this.trying ? `Trying ${words(this.trying)}.` : this.found;
  }

  // Call it some times a second.
  async tick(status: Status): Promise<void> {
    const ms = performance.now();
    if (this.trying) {
      if (ms - this.sinceMs >= trialMs) {
        await this.endTrial();
      }
      return;
    }
    if (this.source.state !== 'open') {
      this.sinceMs = ms;
      this.native.calls.mark();
      return;
    }
    this.seen ||= status.frames > 0 || status.rows > 0;
    const mayTry = this.source.settings.length > 1 && !this.source.problem && ms >= this.pausedUntilMs;
    if (!this.seen && mayTry && status.otherLines === 0 && ms - this.sinceMs >= patienceMs) {
      this.native.calls.beginRound();
      await this.beginTrial(0);
    }
  }

  private async beginTrial(trial: number): Promise<void> {
    this.trial = trial;
    this.trying = this.source.settings[trial];
    this.sinceMs = Infinity; // until the port is open
    await this.source.use(this.trying);
    this.sinceMs = performance.now();
  }

  private async endTrial(): Promise<void> {
    this.sinceMs = Infinity; // until the next one has begun
    const { calls } = this.native;
    calls.addTrial();
    if (this.trial + 1 < this.source.settings.length) {
      await this.beginTrial(this.trial + 1);
      return;
    }
    const [finding, best]: [Finding, number] = [calls.roundFinding(), calls.roundBest()];
    const chosen = this.source.settings[best];
    this.round = finding;
    if (finding > Finding.NoFrames && best > 0) {
      this.found = `${this.native.findingText(finding)} The page has set it: ${words(chosen)}.`;
    }
    await this.source.use(chosen);
    this.trying = undefined;
    this.sinceMs = performance.now();
    this.pausedUntilMs = this.sinceMs + pauseMs;
  }
}
