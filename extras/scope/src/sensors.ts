// Telemetry's sensors: which is in which slot, as the user says and the browser stores it; and which of their readings have a curve.

import uPlot from 'uplot';
import { History } from './history';
import { keep, recallObject } from './storage';
import type { Area, Curve, Strokes } from './view/strokes';
import type { Unit } from './unit';

export interface SensorType {
  name: string; // "SBS-01V"
  slots: number;
}

interface Quantity {
  column: number; // of the history
  name: string;
  value: string;
  unit: string;
}

const key = 'sensors';
const ofGroup = 8; // slots: a sensor's are in one group
const slots = 32;

export const slotOf = (column: number): number => (column - History.channels) % slots;

// Returns what a line's telemetry says: see Picture.
export function quantitiesIn(lines: readonly string[]): Quantity[] {
  return lines.slice(1).map((line) => line.split('\t')).map(([at, name, value, unit]) => ({ column: History.channels + Number(at), name, value, unit }));
}

export class Sensors {
  readonly curves = new Set<number>(); // columns of the history
  private readonly bySlot = new Map<number, SensorType>();
  private readonly known = new Map<number, Quantity>(); // by column, as they came last
  private readonly units = new Map<string, Unit>();

  constructor(readonly types: readonly SensorType[]) {
    this.recall();
  }

  // Takes what is stored: another tab may have stored more.
  private recall(): void {
    const kept = recallObject(key);
    if (kept) {
      this.bySlot.clear();
    }
    for (const [slot, name] of Object.entries(kept ?? {})) {
      const type = this.types.find((each) => each.name === name);
      if (type && this.fits(Number(slot), type)) {
        this.bySlot.set(Number(slot), type);
      }
    }
  }

  // Returns whether such a sensor can begin at a slot: its slots are free, or a sensor's that begins there. Slot 0 is the receiver's.
  fits(slot: number, { slots: count }: SensorType): boolean {
    const isFree = [...this.bySlot].every(([first, other]) => first === slot || slot >= first + other.slots || first >= slot + count);
    return Number.isInteger(slot) && slot > 0 && slot < slots && (slot % ofGroup) + count <= ofGroup && isFree;
  }

  // Returns the sensor that begins at a slot.
  at(slot: number): SensorType | undefined {
    return this.bySlot.get(slot);
  }

  // Returns true for a slot that belongs to the sensor in a slot before.
  isTaken(slot: number): boolean {
    return [...this.bySlot].some(([first, { slots: count }]) => first < slot && slot < first + count);
  }

  // Puts a sensor into a slot; none removes it.
  choose(slot: number, name: string): void {
    const type = this.types.find((each) => each.name === name);
    this.recall();
    this.bySlot.delete(slot);
    if (type && this.fits(slot, type)) {
      this.bySlot.set(slot, type);
    }
    this.forget();
    keep(key, JSON.stringify(Object.fromEntries([...this.bySlot].map(([first, { name }]) => [first, name]))));
  }

  get any(): boolean {
    return this.bySlot.size > 0;
  }

  // What WebAssembly takes: of each its slot and its number. The receiver is the first sensor, in slot 0.
  get bytes(): Uint8Array {
    return Uint8Array.from([0, 0, ...[...this.bySlot].flatMap(([slot, type]) => [slot, this.types.indexOf(type)])]);
  }

  take(quantities: readonly Quantity[]): void {
    quantities.forEach((quantity) => this.known.set(quantity.column, quantity));
  }

  // Forgets what was measured: other sensors, or another line.
  forget(): void {
    this.known.clear();
    this.units.clear();
  }

  // Returns its name, with the slot if another one has the same.
  name(column: number): string {
    const { name } = this.known.get(column) as Quantity;
    const isOnly = [...this.known.values()].filter((each) => each.name === name).length === 1;
    return isOnly ? name : `${name} (slot ${slotOf(column)})`;
  }

  // Returns the curves to draw. Quantities of one unit have one scale.
  drawn(): Curve[] {
    const columns = [...this.curves].filter((column) => this.known.has(column)).sort((a, b) => a - b);
    return columns.map((column) => ({ column, name: this.name(column), unit: this.unitOf((this.known.get(column) as Quantity).unit) }));
  }

  private unitOf(axis: string): Unit {
    const unit = this.units.get(axis) ?? { raw: false, low: 0, high: 1, axis, text: (value): string => `${+value.toFixed(6)} ${axis}` };
    this.units.set(axis, unit);
    return unit;
  }
}

// Fits the scales of sensors to what is shown.
export function fit(strokes: Strokes, curves: readonly Curve[], shown: Pick<Area, 'edge' | 'seconds' | 'begin' | 'end'>): void {
  for (const unit of new Set(curves.map((curve) => curve.unit).filter(({ axis }) => axis !== undefined))) {
    const ends = curves.filter((curve) => curve.unit === unit).map(({ column }) => strokes.ends(column, shown));
    const [low, high] = [Math.min(...ends.map(([least]) => least)), Math.max(...ends.map(([, greatest]) => greatest))];
    if (low <= high) {
      [unit.low, unit.high] = uPlot.rangeNum(low, high, 0.1, true) as [number, number];
    }
  }
}
