// Fingers on the curves: one scrolls, two zoom. A tap is the mouse's, and reads the values.

const slopPx = 8; // a tap may tremble
const pinch = 1.5; // as far apart, or as near, for one step

export class Touch {
  private readonly fingers = new Map<number, number>(); // x, by pointer
  private scrolls = false;
  private begun = 0; // x of one finger, or how far apart two are

  // `scroll`: by this part of the width. `zoom`: +1 is nearer.
  constructor(
    private readonly element: HTMLElement,
    private readonly scroll: (part: number) => void,
    private readonly zoom: (steps: number) => void,
  ) {
    element.addEventListener('pointerdown', (event) => this.put(event));
    element.addEventListener('pointermove', (event) => this.move(event));
    for (const end of ['pointerup', 'pointercancel'] as const) {
      addEventListener(end, (event) => {
        if (this.fingers.delete(event.pointerId)) {
          this.begin();
        }
      });
    }
  }

  private put(event: PointerEvent): void {
    if (event.pointerType === 'touch') {
      this.fingers.set(event.pointerId, event.clientX);
      this.begin();
    }
  }

  private begin(): void {
    this.scrolls = false;
    this.begun = this.spread;
  }

  private get spread(): number {
    const [first = 0, second] = this.fingers.values();
    return second === undefined ? first : Math.abs(second - first);
  }

  private move(event: PointerEvent): void {
    if (!this.fingers.has(event.pointerId)) {
      return;
    }
    this.fingers.set(event.pointerId, event.clientX);
    const now = this.spread;
    if (this.fingers.size === 1 && (this.scrolls || Math.abs(now - this.begun) > slopPx)) {
      this.scrolls = true;
      this.scroll((this.begun - now) / this.element.clientWidth);
      this.begun = now;
    } else if (this.fingers.size === 2 && (now > pinch * this.begun || now * pinch < this.begun)) {
      this.zoom(now > this.begun ? 1 : -1);
      this.begun = now;
    }
  }
}
