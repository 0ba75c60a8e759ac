// Lets something happen not too often: numbers that change faster than ten times a second cannot be read.

export class Throttle {
  private lastMs = -Infinity;

  // `restMs`: from one time to the next.
  constructor(private readonly restMs: number) {}

  // Returns true if it may happen now.
  get due(): boolean {
    const now = performance.now();
    const isDue = now - this.lastMs >= this.restMs;
    this.lastMs = isDue ? now : this.lastMs;
    return isDue;
  }

  // Makes it happen as soon as it is asked for.
  reset(): void {
    this.lastMs = -Infinity;
  }
}
