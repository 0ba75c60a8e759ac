// Two cursors on the curves, A and B: dragged, or moved by keys. Each stays at a frame's time, and waits at the edge while that
// is out of sight.

import { shownSeconds } from '../clock';
import { make, setAttribute, setText } from '../dom';
import type { History } from '../history';
import type { Curve } from './strokes';
import type { Viewport } from './viewport';

const names = ['A', 'B'];
const begun = [0.35, 0.65]; // of the width

export class Cursors {
  readonly layer = make('div', { class: 'cursors', hidden: true });
  private times: number[] = []; // of A and B, in s; none while they are off
  private readonly handles: HTMLElement[];

  // `turned`: called when they are switched on or off. `moved`: called when the user moves one.
  constructor(
    private readonly history: History,
    private readonly view: Viewport,
    private readonly button: HTMLElement,
    private readonly turned: (on: boolean) => void,
    private readonly moved: () => void,
  ) {
    this.handles = names.map((name, i) => this.handle(name, i));
    this.layer.append(...this.handles);
    button.addEventListener('click', () => this.toggle());
  }

  get on(): boolean {
    return this.times.length > 0;
  }

  // The samples at A and B.
  get samples(): number[] {
    return this.times.map((time) => this.history.nearest(time));
  }

  // Switches them on, and gives the first one the focus, or off.
  toggle(): void {
    if (this.on) {
      this.clear();
      return;
    }
    const from = this.history.end > 0 ? Math.max(this.view.begin, this.history.time(this.history.begin)) : this.view.begin;
    const to = Math.min(this.view.edge, this.history.end > 0 ? this.history.time(this.history.end - 1) : Infinity);
    this.times = begun.map((part) => this.snapped(from + part * (to - from)));
    this.tell();
    this.draw();
    this.handles[0].focus();
  }

  clear(): void {
    if (this.layer.contains(document.activeElement)) {
      this.button.focus();
    }
    this.times = [];
    this.tell();
  }

  // Puts the cursors over a plot that was made again.
  enter(over: HTMLElement): void {
    const focused = document.activeElement;
    over.append(this.layer);
    if (this.layer.contains(focused)) {
      (focused as HTMLElement).focus();
    }
  }

  // Call it for each picture.
  draw(): void {
    const { begin, seconds, edge } = this.view;
    this.times.forEach((time, i) => {
      const handle = this.handles[i];
      const place = Math.min(Math.max((time - begin) / seconds, 0), 1);
      handle.style.left = `${(100 * place).toFixed(3)}%`;
      handle.classList.toggle('away', time < begin || time > edge);
      setAttribute(handle, 'aria-valuemin', String(Math.floor(Math.min(begin, time))));
      setAttribute(handle, 'aria-valuemax', String(Math.ceil(Math.max(edge, time))));
      setAttribute(handle, 'aria-valuenow', time.toFixed(3));
      setAttribute(handle, 'aria-valuetext', `${shownSeconds(time).toFixed(3)} s`);
    });
  }

  private tell(): void {
    this.layer.hidden = !this.on;
    this.button.setAttribute('aria-pressed', String(this.on));
    this.turned(this.on);
  }

  private snapped(time: number): number {
    return this.history.end > 0 ? this.history.time(this.history.nearest(time)) : time;
  }

  private handle(name: string, cursor: number): HTMLElement {
    const handle = make('div', { class: 'cursor', role: 'slider', tabindex: 0, 'aria-label': `Cursor ${name}` }, make('b', {}, name));
    handle.addEventListener('pointerdown', (event) => {
      event.stopPropagation(); // the curves stay where they are
      handle.setPointerCapture(event.pointerId);
    });
    handle.addEventListener('mousedown', (event) => event.stopPropagation());
    handle.addEventListener('pointermove', (event) => {
      if (handle.hasPointerCapture(event.pointerId)) {
        const { left, width } = this.layer.getBoundingClientRect();
        const part = Math.min(Math.max((event.clientX - left) / width, 0), 1);
        this.move(cursor, this.view.begin + part * this.view.seconds);
      }
    });
    handle.addEventListener('keydown', (event) => this.key(event, cursor));
    return handle;
  }

  private move(cursor: number, time: number): void {
    this.times[cursor] = this.snapped(time);
    this.moved();
    this.draw();
  }

  private key(event: KeyboardEvent, cursor: number): void {
    const frames = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
    const part = { PageDown: -0.1, PageUp: 0.1 }[event.key];
    const { begin, seconds, edge } = this.view;
    const time = this.times[cursor];
    if (event.key === 'Escape' || event.key === 'Delete') {
      this.clear();
    } else if (frames !== undefined && this.history.end > 0) {
      const next = this.history.nearest(time) + frames;
      this.move(cursor, this.history.time(Math.min(Math.max(next, this.history.begin), this.history.end - 1)));
      this.view.reveal(this.times[cursor]);
    } else if (part !== undefined) {
      this.move(cursor, time + part * seconds);
      this.view.reveal(this.times[cursor]);
    } else if (event.key === 'Home' || event.key === 'End') {
      this.move(cursor, event.key === 'Home' ? begin : edge);
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  }
}

const rows = ['A', 'B', 'B − A'];
const first = ['Time', '1/Δt'];

const signed = (value: number, text: (value: number) => string): string => (value > 0 ? '+' : '') + text(value);
const seconds = (value: number): string => `${value.toFixed(3)} s`;

export class CursorTable {
  private columns = '';
  private cells: HTMLElement[][] = []; // by row

  constructor(
    private readonly root: HTMLElement,
    private readonly history: History,
  ) {}

  // `samples`: at A and B; none hides the table.
  draw(samples: number[], curves: Curve[]): void {
    this.root.hidden = samples.length === 0;
    if (this.root.hidden) {
      return;
    }
    const names = curves.map(({ name }) => name);
    if (names.join('\n') !== this.columns) {
      this.columns = names.join('\n');
      this.make(names);
    }
    const gone = samples.some((sample) => sample < this.history.begin || sample >= this.history.end);
    const [a, b] = samples;
    const between = gone ? NaN : this.history.time(b) - this.history.time(a);
    const time = (sample: number): string => (gone ? '–' : seconds(shownSeconds(this.history.time(sample))));
    this.fill(0, [time(a), time(b), Number.isNaN(between) ? '–' : signed(between, seconds)]);
    this.fill(1, ['', '', between ? `${+(1 / Math.abs(between)).toPrecision(4)} Hz` : '–']);
    curves.forEach(({ column, unit }, i) => {
      const [atA, atB] = samples.map((sample) => (gone ? NaN : this.history.value(sample, column)));
      const text = (value: number): string => (Number.isNaN(value) ? '–' : unit.text(value));
      this.fill(first.length + i, [text(atA), text(atB), signed(atB - atA, text)]);
    });
  }

  private fill(column: number, texts: string[]): void {
    texts.forEach((text, row) => setText(this.cells[row][column], text));
  }

  private make(names: string[]): void {
    const heads = [...first, ...names].map((name) => make('th', { scope: 'col' }, name));
    this.cells = rows.map(() => heads.map(() => make('td')));
    this.root.replaceChildren(
      make(
        'table',
        {},
        make('thead', {}, make('tr', {}, make('td'), ...heads)),
        make('tbody', {}, ...rows.map((row, i) => make('tr', {}, make('th', { scope: 'row' }, row), ...this.cells[i]))),
      ),
    );
  }
}
