// The range behind µs and %: FrSky's, Futaba's, or that of the radio that was calibrated here, which the browser stores.

import { Scale, type Core } from '../core';
import { byId, setText } from '../dom';
import { keep, recall } from '../storage';

const key = 'calibration'; // its value: when, and the bytes in hexadecimal

export class ScaleView {
  private readonly select = byId<HTMLSelectElement>('scale');
  private readonly note = byId('calibrated');

  constructor(private readonly core: Core) {
    this.select.addEventListener('change', () => this.use(Number(this.select.value)));
    byId('calibration-drop').addEventListener('click', () => this.drop());
    this.restore();
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
