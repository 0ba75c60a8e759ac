// The part of the time that is shown: some seconds up to an edge, which follows the newest or stands still. It knows no page.

const windows = [0.5, 1, 2, 5, 10, 20, 30, 60, 120, 240]; // s
const usual = 10; // s
const least = 0.1; // s: eleven frames

export class Viewport {
  seconds = usual;
  private right?: number; // the edge while it stands still, in s
  private now = 0;
  private oldest = 0;

  // Call it for each picture: the times of now and of the oldest sample, in s.
  follow(now: number, oldest: number): void {
    this.now = now;
    this.oldest = oldest;
  }

  get edge(): number {
    return this.right ?? this.now;
  }

  get begin(): number {
    return this.edge - this.seconds;
  }

  get paused(): boolean {
    return this.right !== undefined;
  }

  pause(on: boolean): void {
    this.right = on ? this.edge : undefined;
  }

  // Zooms to the next of the round widths; the right edge stays. +1 zooms in.
  step(steps: number): void {
    const at = steps > 0 ? windows.filter((each) => each < this.seconds).length : windows.findIndex((each) => each > this.seconds);
    const next = steps > 0 ? Math.max(at - 1, 0) : at < 0 ? windows.length - 1 : at;
    this.seconds = windows[next];
  }

  // Shows `factor` times as much, and this part of the width (0..1) stays where it is. The edge follows on as long as it can.
  zoom(factor: number, part: number): void {
    const seconds = Math.min(Math.max(factor * this.seconds, least), windows[windows.length - 1]);
    const right = this.edge + (1 - part) * (seconds - this.seconds);
    this.seconds = seconds;
    if (this.paused || right < this.now) {
      this.hold(right);
    }
  }

  // Shows the newest again, as wide as at first.
  reset(): void {
    this.seconds = usual;
    this.right = undefined;
  }

  // Scrolls by a part of the width, and stands still then.
  scroll(part: number): void {
    this.hold(this.edge + part * this.seconds);
  }

  // Shows a selected part, in the round width that fits it best.
  show(from: number, to: number): void {
    this.seconds = windows.find((seconds) => seconds >= to - from) ?? windows[windows.length - 1];
    this.hold(to + (this.seconds - (to - from)) / 2);
  }

  // Shows a time at a part of the width (0..1), and stops there.
  place(time: number, part: number): void {
    this.hold(time + (1 - part) * this.seconds);
  }

  // Scrolls as far as it must to show this time.
  reveal(time: number): void {
    if (time < this.begin || time > this.edge) {
      this.hold(time + this.seconds / 2);
    }
  }

  private hold(right: number): void {
    this.right = Math.min(Math.max(right, this.oldest + 0.1 * this.seconds), this.now);
  }
}
