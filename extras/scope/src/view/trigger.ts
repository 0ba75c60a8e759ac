// The trigger: stops curves and bytes once a condition becomes true, with that moment in the middle. In a recording it also goes to the
// next event.

import { Flag, Kind } from '../border';
import { secondsText } from '../clock';
import type { Core } from '../core';
import { byId, setText } from '../dom';
import type { Stretch } from '../native';
import { RecordingSource } from '../source/recording';
import type { Source } from '../source/Source';
import { keep, recall } from '../storage';
import type { Curves } from './curves';
import type { FramesView } from './frames';

const key = 'trigger';
const stallUs = 100000; // a read as late as this is the PC's or the adapter's (SilenceUs in extras/line/Silence.h)
const help = 'ch5 > 1500, in raw, us or %; failsafe, nopulses, lostframe, rejected, jump, lossy, stale, age > 50 ms, quality < 80; with &&, ||, !.';

export class TriggerView {
  private readonly panel = byId<HTMLFormElement>('trigger');
  private readonly input = byId<HTMLInputElement>('trigger-condition');
  private readonly button = byId('trigger-arm');
  private readonly next = byId('trigger-next');
  private steps?: Uint8Array; // the condition while it is armed
  private eventUs?: number;
  private isSilent = false; // the event came while the line said nothing
  private readyUs?: number; // when the picture stops; Infinity: once it is full
  private atUs?: number; // of a recording: the position at which the event is shown
  private source?: Source;

  constructor(
    private readonly core: Core,
    private readonly curves: Curves,
    private readonly frames: FramesView,
    private readonly newest: () => Stretch | undefined,
  ) {
    byId('trigger-open').addEventListener('click', () => this.turn(this.panel.hidden === true));
    this.panel.addEventListener('keydown', ({ key: pressed }) => pressed === 'Escape' && this.turn(false));
    this.input.value = recall(key) ?? '';
    this.input.addEventListener('input', () => {
      this.disarm();
      this.say(help);
    });
    this.panel.addEventListener('submit', (event) => {
      event.preventDefault();
      this.press();
    });
    this.next.addEventListener('click', () => this.seek());
    this.say(help);
  }

  private turn(isOpen: boolean): void {
    const button = byId('trigger-open');
    this.panel.hidden = !isOpen;
    button.setAttribute('aria-expanded', String(isOpen));
    if (!isOpen) {
      this.disarm();
    }
    (isOpen ? this.input : button).focus();
  }

  enter(source: Source): void {
    this.source = source;
    this.disarm();
    this.eventUs = this.atUs = undefined;
    this.say(help);
    this.next.hidden = !(source instanceof RecordingSource);
  }

  // Takes the next stretch of the line.
  take(stretch: Stretch): void {
    const { eventUs, readyUs } = this;
    if (readyUs === Infinity && this.isSilent && stretch.lateUs >= stallUs && stretch.endUs - stretch.lateUs <= Number(eventUs)) {
      this.readyUs = undefined;
      this.release(); // the line was not silent: the PC or the adapter held its bytes back
    }
    if (this.steps && stretch.flags & Flag.Event) {
      this.isSilent = stretch.kind === Kind.Silence;
      this.fire(stretch.endUs);
    }
  }

  // The line has jumped: what was before is another place.
  jump(): void {
    if (this.readyUs === Infinity) {
      this.readyUs = undefined;
    }
  }

  // Call it for each picture, after the curves.
  draw(nowUs: number): void {
    const { readyUs } = this;
    const missedUs = this.source?.line.picture.missedUs;
    if (this.steps && missedUs !== undefined) {
      this.miss(missedUs);
    }
    const isFull = readyUs === Infinity && (nowUs >= Number(this.eventUs) + this.afterUs || this.source?.stands);
    if (isFull || (readyUs !== undefined && nowUs >= readyUs)) {
      this.stop();
    } else if (readyUs === undefined && this.eventUs !== undefined && !this.curves.paused) {
      this.release();
    }
  }

  private get afterUs(): number {
    return (1e6 * this.curves.seconds) / 2;
  }

  private fire(us: number): void {
    if (this.readyUs === undefined) {
      this.eventUs = us;
      this.readyUs = Infinity;
      this.frames.stopAt(us);
      this.curves.mark(us);
      this.say(`Event at ${secondsText(us)}; the picture is filling.`);
    }
  }

  // Its picture is not kept.
  private miss(us: number): void {
    this.disarm();
    this.say(`Event at ${secondsText(us)}, which the curves do not reach: the page was in the background.`);
  }

  private stop(): void {
    const { source } = this;
    this.readyUs = undefined;
    this.curves.stop();
    this.arm();
    if (source instanceof RecordingSource) {
      source.playing = false;
      this.atUs = source.positionUs;
    }
    this.say(`Event at ${secondsText(this.eventUs as number)}.`);
  }

  // The curves go on, and so do the bytes, and a recording that still stands where the trigger has stopped it.
  private release(): void {
    const { source } = this;
    if (this.eventUs !== undefined && source instanceof RecordingSource && source.positionUs === this.atUs) {
      source.playing = true;
    }
    this.eventUs = undefined;
    this.frames.stopAt();
    this.curves.mark();
    this.say(this.steps ? 'Armed.' : help);
  }

  private press(): void {
    if (this.steps) {
      this.disarm();
      this.say(help);
      return;
    }
    const steps = this.condition();
    if (steps) {
      this.release();
      this.curves.pause(false);
      this.arm(steps);
      this.say('Armed.');
    }
  }

  private disarm(): void {
    this.readyUs = undefined;
    this.arm();
  }

  // Arms the trigger, or without a condition disarms it.
  private arm(steps?: Uint8Array): void {
    this.steps = steps;
    this.source?.line.ask({ kind: 'watch', steps });
    this.button.setAttribute('aria-pressed', String(steps !== undefined));
    setText(this.button, steps ? 'Disarm' : 'Arm');
  }

  // Goes to the next event of the recording.
  private seek(): void {
    const { source } = this;
    const steps = this.condition();
    if (!steps || !(source instanceof RecordingSource)) {
      return;
    }
    this.disarm();
    const fromUs = source.positionUs === this.atUs && this.eventUs !== undefined ? this.eventUs : source.positionUs;
    this.say('Searching for the next event.');
    source.seekEvent(fromUs, steps, this.afterUs, (us, event) => {
      if (event === null) {
        this.say(`No event after ${secondsText(fromUs)}.`);
        return;
      }
      this.eventUs = event;
      this.readyUs = us;
      this.frames.stopAt(event);
      this.curves.mark(event);
    });
  }

  // Returns the condition, or says what is wrong with it.
  private condition(): Uint8Array | undefined {
    const newest = this.newest();
    const isBoard = newest ? newest.kind === Kind.Row : this.source?.line.flight ? false : this.source?.isBoard;
    const { steps, error, from, to } = this.core.condition(this.input.value, isBoard);
    if (error === '') {
      this.input.removeAttribute('aria-invalid');
      keep(key, this.input.value);
      return steps;
    }
    this.input.setAttribute('aria-invalid', 'true');
    this.input.focus();
    this.input.setSelectionRange(from, to);
    this.say(`Character ${from + 1}: ${error}.`);
    return undefined;
  }

  private say(text: string): void {
    setText(byId('trigger-text'), text);
  }
}
