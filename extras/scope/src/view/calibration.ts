// The range behind µs and %: FrSky's, Futaba's, or that of the radio that was calibrated here, which the browser stores. Guides the
// user through a calibration: sbus/Calibrator decides, this only asks and shows.

import { Kind } from '../border';
import { CalibrationError, type Core, Scale } from '../core';
import { Announcer, byId, setText } from '../dom';
import type { Stretch } from '../native';
import { keep, recall } from '../storage';

const key = 'calibration'; // its value: when, and the bytes in hexadecimal
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
  private readonly scale: ScaleView;

  constructor(private readonly core: Core) {
    this.scale = new ScaleView(core);
    this.open.addEventListener('click', () => this.go(this.step === 0 ? 1 : 0));
    this.next.addEventListener('click', () => (this.step === 3 ? this.finish() : this.go(this.step + 1)));
    byId('calibration-cancel').addEventListener('click', () => this.go(0));
  }

  draw(newest?: Stretch): void {
    this.scale.draw(newest);
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
      this.scale.calibrated();
    } else {
      this.go(1);
      this.textAt = performance.now() + 4000; // let it be read
      setText(this.text, `Not accepted: ${rejected}. Start again. ${steps[1]}`);
    }
  }
}

const neutral = { [Scale.FrSky]: 992, [Scale.Futaba]: 1024 };
const enough = 4; // channels at neutral
const makes = ["FrSky's", "a Futaba's"];

// Returns the scale that a frame tells: only Futaba's lines have other end bytes than 00 or frames with header 2F, only FrSky's 24 channels.
function scaleOf({ kind, bytes, channels }: Stretch): Scale.FrSky | Scale.Futaba | undefined {
  const [frsky, futaba] = [Scale.FrSky, Scale.Futaba].map((scale) => channels.filter((raw) => raw === neutral[scale as 0 | 1]).length);
  if (kind === Kind.Extra || (kind === Kind.Frame && (bytes.at(-1) !== 0 || (futaba >= enough && frsky === 0)))) {
    return Scale.Futaba;
  }
  return kind === Kind.Frame24 || (kind === Kind.Frame && frsky >= enough && futaba === 0) ? Scale.FrSky : undefined;
}

class ScaleView {
  private told?: Scale.FrSky | Scale.Futaba; // by the line
  private readonly select = byId<HTMLSelectElement>('scale');
  private readonly note = byId('calibrated');
  private readonly hint = byId('scale-hint');
  private readonly other = byId('scale-use');

  constructor(private readonly core: Core) {
    this.select.addEventListener('change', () => this.use(Number(this.select.value)));
    byId('calibration-drop').addEventListener('click', () => this.drop());
    this.other.addEventListener('click', () => this.use(this.told ?? Scale.FrSky));
    this.restore();
  }

  // Suggests the scale that the line tells.
  draw(newest?: Stretch): void {
    this.told = newest && (scaleOf(newest) ?? this.told);
    const other = this.told === Number(this.select.value) || Number(this.select.value) === Scale.Calibrated ? undefined : this.told;
    this.hint.hidden = other === undefined;
    if (other !== undefined) {
      setText(byId('scale-hint-text'), `The line looks like ${makes[other]}: neutral is ${neutral[other]}.`);
      setText(this.other, `Use ${makes[other].replace('a ', '')} range`);
    }
  }

  // Stores the new calibration and uses it.
  calibrated(): void {
    const now = new Date().toISOString();
    const hex = Array.from(this.core.calibration, (byte) => byte.toString(16).padStart(2, '0')).join('');
    keep(key, `${now} ${hex}`);
    this.useCalibration(now);
  }

  private restore(): void {
    const [when, hex = ''] = recall(key)?.split(' ') ?? [''];
    if (this.core.restoreCalibration(Uint8Array.from(hex.match(/../g) ?? [], (pair) => parseInt(pair, 16)))) {
      this.useCalibration(when);
    } else {
      this.use(Scale.FrSky);
    }
  }

  private drop(): void {
    keep(key);
    this.select.options[Scale.Calibrated].disabled = true;
    this.use(Scale.FrSky);
    this.select.focus(); // the button has gone
  }

  private useCalibration(when: string): void {
    setText(byId('calibrated-text'), `Calibrated on ${new Date(when).toLocaleDateString()}.`);
    this.select.options[Scale.Calibrated].disabled = false;
    this.use(Scale.Calibrated);
  }

  private use(scale: Scale): void {
    this.select.value = String(scale);
    this.core.setScale(scale);
    this.note.hidden = scale !== Scale.Calibrated;
  }
}
