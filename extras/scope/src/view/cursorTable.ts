// The times and values at the cursors, and their differences.

import { shownSeconds } from '../clock';
import { make, setText } from '../dom';
import type { History } from '../history';
import type { Curve } from './strokes';

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
