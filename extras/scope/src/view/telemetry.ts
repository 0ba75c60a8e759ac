// The telemetry of S.BUS2: a card that is shown while slots come, with the sensors' readings, each a curve if its button is pressed.

import { byId, make, setText } from '../dom';
import { quantitiesIn, slotOf, type Sensors } from '../sensors';
import { Throttle } from '../throttle';
import { chipOf } from './palette';

const drawMs = 200;
const unknown = 'unknown';

interface Row {
  item: HTMLElement;
  name: HTMLElement;
  value: HTMLElement;
}

export class TelemetryView {
  private readonly card = byId('telemetry');
  private readonly list = byId('telemetry-list');
  private readonly choices = byId('sensors');
  private readonly drawing = new Throttle(drawMs);
  private readonly slots = make('li', {});
  private readonly rows = new Map<number, Row>(); // by the history's columns
  private readonly seen = new Set<number>(); // slots
  private shown = '';
  private offered = '';

  // `chosen`: called when the user says which sensor is in a slot.
  constructor(
    private readonly sensors: Sensors,
    private readonly chosen: () => void,
  ) {}

  // Another source.
  enter(): void {
    this.sensors.forget();
    this.seen.clear();
    this.card.hidden = true;
    this.clear();
  }

  draw(lines: readonly string[]): void {
    const text = lines.join();
    if (text === this.shown || !this.drawing.due) {
      return;
    }
    this.shown = text;
    const quantities = quantitiesIn(lines);
    this.sensors.take(quantities);
    quantities.forEach(({ column }) => this.row(column));
    this.rows.forEach(({ name, value }, column) => {
      const now = quantities.find((each) => each.column === column);
      setText(name, this.sensors.name(column));
      setText(value, now ? ` ${now.value} ${now.unit}` : ' –');
    });
    setText(this.slots, lines[0] === 'slot 0' ? '' : (lines[0] ?? '')); // the receiver's own says nothing
    (lines[0] ?? '').match(/\d+/g)?.forEach((slot) => this.seen.add(Number(slot)));
    this.card.hidden = lines.length === 0 && this.sensors.drawn().length === 0;
    this.offer();
  }

  private clear(): void {
    this.rows.clear();
    this.shown = this.offered = '';
    this.list.replaceChildren(this.slots);
  }

  private row(column: number): void {
    if (!this.rows.has(column)) {
      const [name, value] = [make('span', { class: 'name' }), make('span')];
      const item = make('li', {}, chipOf(this.sensors.curves, column, name), value);
      this.rows.set(column, { item, name, value });
      const columns = [...this.rows.keys()].sort((a, b) => slotOf(a) - slotOf(b) || a - b);
      this.list.replaceChildren(...columns.map((each) => (this.rows.get(each) as Row).item), this.slots);
    }
  }

  // Offers a sensor for each slot that comes.
  private offer(): void {
    const slots = [...this.seen].filter((slot) => slot > 0 && !this.sensors.isTaken(slot)).sort((a, b) => a - b);
    const offered = slots.map((slot) => `${slot} ${this.sensors.at(slot)?.name}`).join();
    if (offered !== this.offered) {
      this.offered = offered;
      this.choices.replaceChildren(...slots.map((slot) => make('label', {}, `Slot ${slot} `, this.choice(slot))));
    }
  }

  private choice(slot: number): HTMLSelectElement {
    const fitting = this.sensors.types.filter((type, i) => i > 0 && this.sensors.fits(slot, type));
    const select = make('select', { 'data-slot': slot }, ...[unknown, ...fitting.map(({ name }) => name)].map((name) => make('option', {}, name)));
    select.value = this.sensors.at(slot)?.name ?? unknown;
    select.addEventListener('change', () => {
      this.sensors.choose(slot, select.value);
      this.clear();
      this.chosen();
      this.offer();
      this.choices.querySelector<HTMLElement>(`[data-slot="${slot}"]`)?.focus();
    });
    return select;
  }
}
