// The part of the time that is shown: some seconds up to an edge, which follows the newest or stands still. A line begins at the left.
// It knows no page.

import { keptSeconds } from '../history';

const windows = [0.5, 1, 2, 5, 10, 20, 30, 60, 120, keptSeconds]; // s
const usual = 10; // s
const least = 0.1; // s: eleven frames

export class Viewport {
  seconds = usual;
  private first = usual; // of the line
  private right?: number; // the edge while it stands still, in s
  stoodS = Infinity; // when it was paused: what comes later is not shown, until the user scrolls
  private now = 0;
  private oldest = 0;
  private whole = 0;

  // Another line: shows its beginning. `length`, in s: of a recording; 0 of a live line.
  enter(length: number): void {
    this.first = length > 0 ? Math.min(Math.max(length, least), usual) : usual;
    this.whole = 0;
    this.reset();
  }

  // Call it for each picture: the times of now and of the oldest sample, in s. `whole`: the length of a recording that can be shown from
  // end to end; 0 of any other line.
  follow(now: number, oldest: number, whole = 0): void {
    this.now = now;
    this.oldest = oldest;
    this.whole = whole;
  }

  get edge(): number {
    return this.right ?? Math.max(this.now, this.seconds);
  }

  // True if it shows a time that has not come yet.
  get isAhead(): boolean {
    return this.edge > this.now + 0.001;
  }

  // True if it is longer than the samples that are kept.
  get isWide(): boolean {
    return this.seconds > keptSeconds;
  }

  // True if its edge is where no samples are kept.
  get isAway(): boolean {
    return this.whole > 0 && this.right !== undefined && (this.isAhead || this.right < this.oldest);
  }

  get begin(): number {
    return this.edge - this.seconds;
  }

  get paused(): boolean {
    return this.right !== undefined;
  }

  pause(on: boolean): void {
    this.stoodS = on ? this.now : Infinity;
    this.right = on ? this.edge : undefined;
  }

  // Zooms to the next of the round widths; the right edge stays. +1 zooms in.
  step(steps: number): void {
    const { windows } = this;
    const at = steps > 0 ? windows.filter((each) => each < this.seconds).length : windows.findIndex((each) => each > this.seconds);
    const next = steps > 0 ? Math.max(at - 1, 0) : at < 0 ? windows.length - 1 : at;
    this.seconds = windows[next];
  }

  // Shows `factor` times as much, and this part of the width (0..1) stays where it is. The edge follows on as long as it can.
  zoom(factor: number, part: number): void {
    const seconds = Math.min(Math.max(factor * this.seconds, least), this.windows[this.windows.length - 1]);
    const right = this.edge + (1 - part) * (seconds - this.seconds);
    const leavesWhole = this.isWide && factor < 1;
    this.seconds = seconds;
    if (this.paused || right < this.now || leavesWhole) {
      this.hold(right);
    }
  }

  // Shows the newest again, as wide as at first.
  reset(): void {
    this.seconds = this.first;
    this.pause(false);
  }

  // Scrolls by a part of the width, and stands still then.
  scroll(part: number): void {
    this.hold(this.edge + part * this.seconds);
  }

  // Shows a selected part, in the round width that fits it best.
  show(from: number, to: number): void {
    this.seconds = this.windows.find((seconds) => seconds >= to - from) ?? this.windows[this.windows.length - 1];
    this.hold(to + (this.seconds - (to - from)) / 2);
  }

  // Shows a time in the middle, and stops there.
  centre(time: number): void {
    this.hold(time + this.seconds / 2);
  }

  // Scrolls as far as it must to show this time.
  reveal(time: number): void {
    if (time < this.begin || time > this.edge) {
      this.centre(time);
    }
  }

  private hold(right: number): void {
    this.stoodS = Infinity;
    const first = this.isWide ? this.seconds : (this.whole > 0 ? 0 : this.oldest) + 0.1 * this.seconds;
    this.right = Math.min(Math.max(right, first), Math.max(this.now, this.whole));
  }

  private get windows(): number[] {
    const wider = this.whole > keptSeconds ? [this.whole] : [];
    for (let seconds = 2 * keptSeconds; seconds < 0.75 * this.whole; seconds *= 2) wider.splice(-1, 0, seconds);
    return [...windows, ...wider];
  }
}
