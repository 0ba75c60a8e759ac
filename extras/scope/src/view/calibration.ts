// Guides the user through a calibration: sbus/Calibrator decides, this only asks and shows.

import { CalibrationError, type Core } from '../core';
import { byId, setText } from '../dom';
import { Announcer } from './announcer';

const steps = [
  '',
  '1 of 3: Move all sticks, sliders and switches to all their ends.',
  '2 of 3: Centre the sticks, throttle low, and let go.',
  '3 of 3: Push both sticks up and right, and hold them there.',
];
// The error that the next step removes: nothing is left to do in this one.
const doneBy = [undefined, CalibrationError.NotRested, CalibrationError.NotPushed];
const sticks = 4; // CH1..CH4 must be good
const wanted = (1 << sticks) - 1;

export class CalibrationView {
  private step = 0;
  private textAt = 0;
  private readonly panel = byId('calibration');
  private readonly open = byId<HTMLButtonElement>('calibrate');
  private readonly text = byId('calibration-text');
  private readonly announcer = new Announcer(byId('calibration-announcement'));
  private readonly next = byId<HTMLButtonElement>('calibration-next');

  // `done`: called once there is a calibration.
  constructor(
    private readonly core: Core,
    private readonly done: () => void,
  ) {
    this.open.addEventListener('click', () => this.go(this.step === 0 ? 1 : 0));
    this.next.addEventListener('click', () => (this.step === 3 ? this.finish() : this.go(this.step + 1)));
    byId('calibration-cancel').addEventListener('click', () => this.go(0));
  }

  draw(): void {
    this.announcer.say(this.text.textContent ?? '');
    const now = performance.now();
    if (this.step === 0 || now - this.textAt < 500) {
      return;
    }
    this.textAt = now;
    const todo = Array.from({ length: sticks }, (_, i) => [i, this.core.calibrationError(i)] as const)
      .filter(([, error]) => error !== CalibrationError.None && error !== doneBy[this.step])
      .map(([i, error]) => `CH${i + 1}${this.core.calibrationErrorText(error)}.`);
    setText(this.text, `${steps[this.step]} ${todo.join(' ') || 'CH1 to CH4 are done.'}`);
  }

  private go(step: number): void {
    this.step = step;
    this.core.calibrate(step);
    this.textAt = 0;
    this.panel.hidden = step === 0;
    this.open.setAttribute('aria-expanded', String(step !== 0));
    setText(this.text, steps[step]);
    setText(this.next, step === 3 ? 'Finish' : 'Next');
  }

  private finish(): void {
    const rejected = this.core.finishCalibration(wanted);
    if (rejected === '') {
      this.go(0);
      this.done();
    } else {
      this.go(1);
      this.textAt = performance.now() + 4000; // let it be read
      setText(this.text, `Not accepted: ${rejected}. Start again. ${steps[1]}`);
    }
  }
}
