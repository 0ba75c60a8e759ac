// Mouse, wheel, fingers and keys on the curves, as in PulseView and Saleae's Logic: what is dragged stays under the pointer, the wheel with
// Ctrl and two fingers zoom there, a double click resets. The wheel alone scrolls the page. With Shift, uPlot selects instead. A tap points like a mouse.

const slopPx = { mouse: 3, touch: 8 }; // a click or a tap may tremble
const leastSpreadPx = 20;
const doublePx = 250; // of the wheel, to show twice as much time
const pinchPx = 50; // of two fingers on a touchpad, to show twice as much time: the browser says Ctrl and a wheel, in small steps
const notchPx = 40; // of a wheel at least

const key = /^Mac/.test(navigator.platform) ? '⌘' : 'Ctrl'; // for the wheel
const byFingers = matchMedia('(pointer: coarse)').matches;
export const howTo = byFingers ? 'One finger scrolls, two zoom.' : `Drag to scroll, ${key} and the wheel to zoom.`;
export const [doubleClick, pointAt] = byFingers ? ['Tap twice', 'Touch'] : ['Double-click', 'Point at'];

interface Gestured {
  // Returns the curves' place on the screen, without their axes.
  place(): DOMRect;
  // Scrolls by this part of the width.
  scroll(part: number): void;
  // Shows `factor` times as much; what is at this part of the width stays there.
  zoom(factor: number, part: number): void;
  // To the next round width: +1 zooms in.
  step(steps: number): void;
  // Goes to the newest.
  end(): void;
  reset(): void;
}

export class Gestures {
  private readonly pointers = new Map<number, number>(); // x, by pointer
  private scrolls = false;
  private begun = 0; // x of the first pointer

  constructor(
    element: HTMLElement,
    private readonly curves: Gestured,
  ) {
    element.addEventListener('pointerdown', (event) => this.put(event));
    element.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    element.addEventListener('dblclick', () => this.curves.reset());
    element.addEventListener('keydown', (event) => this.key(event));
    addEventListener('pointermove', (event) => this.move(event));
    for (const end of ['pointerup', 'pointercancel'] as const) {
      addEventListener(end, (event) => this.lift(event));
    }
  }

  private key(event: KeyboardEvent): void {
    const { curves } = this;
    const part = { ArrowLeft: -0.1, ArrowRight: 0.1, PageUp: -1, PageDown: 1 }[event.key];
    const steps = { '+': 1, '=': 1, '-': -1 }[event.key];
    if (part !== undefined) {
      curves.scroll(part);
    } else if (steps !== undefined) {
      curves.step(steps);
    } else if (event.key === 'End') {
      curves.end();
    } else if (event.key === '0') {
      curves.reset();
    } else {
      return;
    }
    event.preventDefault();
  }

  private put(event: PointerEvent): void {
    if (event.button === 0 && !event.shiftKey) {
      this.pointers.set(event.pointerId, event.clientX);
      this.begin();
    }
  }

  private lift(event: PointerEvent): void {
    if (this.pointers.delete(event.pointerId)) {
      this.begin();
    }
  }

  private begin(): void {
    this.scrolls = false;
    [this.begun = 0] = this.pointers.values();
  }

  private move(event: PointerEvent): void {
    if (!this.pointers.has(event.pointerId)) {
      return;
    }
    const before = this.spread();
    const slop = event.pointerType === 'mouse' ? slopPx.mouse : slopPx.touch;
    if (this.pointers.size === 1 && !this.scrolls) {
      this.scrolls = Math.abs(event.clientX - this.begun) > slop;
      if (!this.scrolls) {
        return;
      }
    }
    this.pointers.set(event.pointerId, event.clientX);
    const now = this.spread();
    const { left, width } = this.curves.place();
    this.curves.scroll((before.middle - now.middle) / width);
    if (this.pointers.size === 2) {
      this.curves.zoom(before.px / now.px, (now.middle - left) / width);
    }
  }

  // Returns where the fingers are, and how far apart.
  private spread(): { middle: number; px: number } {
    const [first = 0, second = first] = this.pointers.values();
    return { middle: (first + second) / 2, px: Math.max(Math.abs(second - first), leastSpreadPx) };
  }

  private wheel(event: WheelEvent): void {
    const { left, width } = this.curves.place();
    const px = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 16;
    const isSideways = Math.abs(event.deltaX) > Math.abs(event.deltaY);
    if (!isSideways && !event.ctrlKey && !event.metaKey) {
      return;
    }
    event.preventDefault();
    if (isSideways) {
      this.curves.scroll((event.deltaX * px) / width);
    } else {
      const doubles = (event.deltaY * px) / (Math.abs(event.deltaY * px) < notchPx ? pinchPx : doublePx);
      this.curves.zoom(2 ** Math.min(Math.max(doubles, -1), 1), (event.clientX - left) / width);
    }
  }
}
