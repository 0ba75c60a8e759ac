// Says what is wrong with the line, at all times; and where no frame comes, tries the other settings of the port.

import { Finding, type Core, type Setting } from './core';
import { Flag, LinkState, type Status, type Stretch } from './line';
import type { Problem, Source } from './source/Source';

const trialMs = 500; // half a second has 12 frames of the slowest receiver known
const patienceMs = 1000; // without a frame, until others are tried
const pauseMs = 2000; // until they are tried again

export type Severity = 'good' | 'note' | 'warning' | 'alarm';

export interface Verdict extends Problem {
  severity: Severity;
}

// Of what is not well.
const severities: Partial<Record<Finding, Severity>> = {
  [Finding.NoSignal]: 'alarm',
  [Finding.NoFrames]: 'alarm',
  [Finding.Channels24]: 'note',
  [Finding.WrongPolarity]: 'alarm',
  [Finding.WrongBaud]: 'alarm',
  [Finding.WrongPolarityAndBaud]: 'alarm',
  [Finding.PolledTooSeldom]: 'warning',
  [Finding.Noise]: 'warning',
  [Finding.Failsafe]: 'alarm',
  [Finding.NoRadio]: 'alarm',
  [Finding.Lossy]: 'warning',
};

export const words = (setting: Setting): string =>
  `${setting.baud} baud${setting.inverted ? ', inverted' : ', not inverted'}`;

export class Doctor {
  private found = ''; // by trying: the port is open so now
  private trying?: Setting;
  private trial = 0; // of the round
  private sinceMs: number; // the trial's, or the watch's
  private seen = false; // frames, since the source was opened
  private pausedUntilMs = 0;
  private finding?: Finding; // of the last watch
  private round?: Finding; // of the last round
  private characters = 0; // when the watch began

  constructor(
    private readonly core: Core,
    private readonly source: Source,
    private readonly lineSettings: readonly Setting[] = source.settings,
  ) {
    this.sinceMs = performance.now();
    core.mark();
  }

  // What is being tried, or was found.
  get note(): string {
    return this.trying ? `Trying ${words(this.trying)}.` : this.found;
  }

  // Call it for each picture.
  async tick(status: Status): Promise<void> {
    const ms = performance.now();
    const elapsed = ms - this.sinceMs;
    if (this.trying) {
      if (elapsed >= trialMs) {
        await this.endTrial();
      }
      return;
    }
    if (this.source.state !== 'open') {
      this.watch(status);
      return;
    }
    this.seen ||= status.frames > 0 || status.rows > 0;
    if (elapsed >= patienceMs) {
      this.finding = this.core.verdict;
      this.watch(status);
      const mayTry = this.lineSettings.length > 1 && !this.source.problem && ms >= this.pausedUntilMs;
      if (!this.seen && mayTry && status.otherLines === 0) {
        this.core.beginRound();
        await this.beginTrial(0);
      }
    }
  }

  verdict(status: Status, newest?: Stretch): Verdict {
    if (this.source.problem) {
      return { ...this.source.problem, severity: 'alarm' };
    }
    if (status.rows > 0 || (status.otherLines > 0 && status.frames === 0)) {
      return ofBoard(status, this.of(Finding.Failsafe));
    }
    if (this.source.isBoard && status.state === LinkState.NeverSeen) {
      return 4 * status.garbled <= status.characters ? awaited : noText;
    }
    switch (status.state) {
      case LinkState.Failsafe:
        return this.of((newest?.flags ?? 0) & Flag.Failsafe ? Finding.Failsafe : Finding.NoRadio);
      case LinkState.Stale:
        return status.characters > this.characters
          ? this.of(Finding.NoFrames)
          : { ...this.of(Finding.NoSignal), text: 'No signal any more: frames have come, now not a byte does.' };
      case LinkState.NeverSeen: {
        const finding = this.lineSettings.length > 1 ? this.round : this.finding;
        return finding === undefined
          ? { text: 'LISTENING.', remedy: 'The first frame is awaited.', severity: 'note' }
          : this.of(finding);
      }
      default:
        return this.finding === undefined || this.finding <= Finding.NoFrames
          ? { text: 'Frames come.', remedy: 'A verdict needs a second of them.', severity: 'good' }
          : this.of(this.finding);
    }
  }

  private watch(status: Status): void {
    this.sinceMs = performance.now();
    this.characters = status.characters;
    this.core.mark();
  }

  private async beginTrial(trial: number): Promise<void> {
    this.trial = trial;
    this.trying = this.lineSettings[trial];
    this.sinceMs = Infinity; // until the port is open
    await this.source.use(this.trying);
    this.sinceMs = performance.now();
  }

  private async endTrial(): Promise<void> {
    this.sinceMs = Infinity; // until the next one has begun
    this.core.addTrial();
    if (this.trial + 1 < this.lineSettings.length) {
      await this.beginTrial(this.trial + 1);
      return;
    }
    const { finding, best } = this.core.endRound();
    const chosen = this.lineSettings[best];
    this.round = finding;
    if (finding > Finding.NoFrames && best > 0) {
      this.found = `${this.core.findingText(finding)} ${this.core.findingRemedy(finding)} Done: ${words(chosen)}.`;
    }
    await this.source.use(chosen);
    this.trying = undefined;
    this.sinceMs = performance.now();
    this.pausedUntilMs = this.sinceMs + pauseMs;
    this.characters = 0;
    this.core.mark();
  }

  private of(finding: Finding): Verdict {
    return {
      text: this.core.findingText(finding),
      remedy: this.core.findingRemedy(finding),
      severity: this.core.isWell(finding) ? 'good' : (severities[finding] ?? 'alarm'),
    };
  }
}

const awaited: Verdict = {
  text: 'Waiting for rows.',
  remedy: 'A board may restart when its port is opened, and a slow sketch is waited for.',
  severity: 'note',
};

const noText: Verdict = {
  text: 'Bytes come, but no rows.',
  remedy: 'Choose the baud rate that the sketch gives to Serial.begin().',
  severity: 'warning',
};

function ofBoard(status: Status, failsafe: Verdict): Verdict {
  if (status.rows === 0) {
    return {
      text: 'TEXT COMES, but no rows of numbers.',
      remedy: 'Upload a sketch that prints 2 to 32 of them, with commas, tabs or blanks: DecodeSBus, AllChannels, Channels24.',
      severity: 'warning',
    };
  }
  if (status.state === LinkState.Stale) {
    return {
      text: 'No rows: the board prints nothing.',
      remedy: 'Its sketch prints while frames come: check the wire to the receiver, or upload Diagnose.',
      severity: 'alarm',
    };
  }
  return status.state === LinkState.Failsafe
    ? failsafe
    : { text: 'Rows come from a board.', remedy: 'Its sketch decodes the line.', severity: 'good' };
}
