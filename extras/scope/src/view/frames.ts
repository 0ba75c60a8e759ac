// The line, byte by byte. Pointing at a bit shows its channel; meanwhile the view holds still.

import { Flag, Kind } from '../border';
import { secondsText } from '../clock';
import type { Core } from '../core';
import { byId, make, setText } from '../dom';
import type { Stretch } from '../native';
import { Throttle } from '../throttle';
import { pointAt } from './gestures';

const kept = 8; // pieces of the line
const drawMs = 100;

const hex = (byte: number): string => byte.toString(16).toUpperCase().padStart(2, '0');

const howTo = `${pointAt} a bit. Bits are shown least significant first, as on the wire.`;

const flagNames: Record<number, string> = { 0: 'CH17', 1: 'CH18', 2: 'The lost-frame flag', 3: 'The failsafe flag' };

export class FramesView {
  private readonly bits = byId('bits');
  private readonly text = byId('bit-text');
  private stretches: Stretch[] = []; // the newest last
  private shown?: Stretch; // the frame shown bit by bit
  private held = false;
  private stopUs?: number;
  private stopped?: Stretch[]; // what it shows from that time on
  private readonly drawing = new Throttle(drawMs);
  private at = 8; // the bit pointed at, from 0 on; 8 is the payload's first
  private cells: HTMLElement[] = [];
  private bitCells: HTMLElement[] = [];
  private owners: (string | undefined)[] = []; // by bit: "CH3"
  private readonly rows: HTMLElement[] = [];

  constructor(private readonly core: Core) {
    const { bits } = this;
    for (let i = 0; i < kept; i++) {
      this.rows.push(make('li', {}, make('span', { class: 'time' }), make('code'), make('span', { class: 'why' })));
    }
    byId('lines').append(...this.rows);
    bits.addEventListener('pointermove', (event) => this.point(event));
    bits.addEventListener('pointerdown', (event) => this.point(event));
    bits.addEventListener('pointerleave', () => this.hold(document.activeElement === bits));
    bits.addEventListener('focus', () => this.hold(true));
    bits.addEventListener('blur', () => this.hold(false));
    bits.addEventListener('keydown', (event) => this.key(event));
    setText(this.text, howTo);
  }

  clear(): void {
    this.stretches = [];
    this.shown = this.stopped = undefined;
    this.bits.replaceChildren();
    this.cells = this.bitCells = [];
    this.hold(false);
    this.drawing.reset();
  }

  add(stretch: Stretch): void {
    this.stretches.push(stretch);
    if (this.stretches.length > kept) {
      this.stretches.shift();
    }
    if (this.stopUs !== undefined && stretch.endUs >= this.stopUs) {
      this.stopped ??= [...this.stretches];
    }
  }

  // Stops at the stretch that ends then; without a time, goes on.
  stopAt(us?: number): void {
    this.stopUs = us;
    this.stopped = undefined;
    this.drawing.reset();
  }

  draw(): void {
    if (this.held || !this.drawing.due) {
      return;
    }
    const newest = [...(this.stopped ?? this.stretches)].reverse();
    this.rows.forEach((row, i) => this.drawRow(row, newest[i]));
    this.show(newest.find((stretch) => stretch.kind !== Kind.NoFrame));
    setText(byId('hold'), newest.length === 0 ? 'No S.Bus bytes: none have come, or the source is a board that prints numbers.' : '');
    if (document.activeElement === this.bits) {
      this.hold(true); // those of another place
    }
  }

  private drawRow(row: HTMLElement, stretch: Stretch | undefined): void {
    row.hidden = !stretch;
    if (!stretch) {
      return;
    }
    const [time, code, why] = Array.from(row.children) as HTMLElement[];
    setText(time, secondsText(stretch.endUs).slice(0, -2));
    setText(code, Array.from(stretch.bytes, hex).join(' '));
    const flags = stretch.flags & Flag.Failsafe && !(stretch.flags & Flag.ByLosses) ? 'failsafe' : stretch.flags & Flag.LostFrame ? 'lost frame' : stretch.kind === Kind.Frame && stretch.flags & Flag.NoPulses ? 'no pulses' : '';
    setText(why, stretch.why || flags);
    row.className = stretch.kind === Kind.NoFrame && !stretch.isTelemetry ? 'none' : flags ? 'flagged' : '';
  }

  // Shows the newest frame bit by bit.
  private show(stretch: Stretch | undefined): void {
    if (!stretch) {
      return;
    }
    if (stretch.bytes.length !== this.shown?.bytes.length || stretch.kind !== this.shown.kind) {
      this.build(stretch);
    }
    this.shown = stretch;
    stretch.bytes.forEach((byte, i) => {
      setText(this.cells[i], hex(byte));
      for (let bit = 0; bit < 8; bit++) {
        this.bitCells[8 * i + bit].classList.toggle('one', ((byte >> bit) & 1) !== 0);
      }
    });
  }

  private build({ bytes: { length }, kind }: Stretch): void {
    this.cells = [];
    this.bitCells = [];
    this.owners = [];
    this.bits.replaceChildren();
    const offset = kind === Kind.Extra ? 16 : 0;
    for (let byte = 0; byte < length; byte++) {
      const cell = make('b');
      const bitCells = [];
      for (let bit = 0; bit < 8; bit++) {
        const owner = this.core.ownerOfBit(length, byte, bit);
        const bitCell = make('i', { 'data-bit': 8 * byte + bit });
        if (owner) {
          bitCell.className = owner.channel % 2 === 0 ? 'even' : 'odd';
        }
        this.owners.push(owner && `CH${owner.channel + 1 + (byte < length - 2 ? offset : 0)}`);
        bitCells.push(bitCell);
      }
      this.cells.push(cell);
      this.bitCells.push(...bitCells);
      this.bits.append(make('span', { class: 'byte' }, cell, make('span', { class: 'eight' }, ...bitCells)));
    }
  }

  private point(event: PointerEvent): void {
    const bit = (event.target as HTMLElement).dataset?.bit;
    this.hold(true);
    if (bit !== undefined) {
      this.explain(Number(bit));
    }
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: 8, ArrowUp: -8 }[event.key];
    if (step !== undefined && this.shown) {
      event.preventDefault();
      this.explain(this.at + step);
    }
  }

  private hold(held: boolean): void {
    this.held = held && this.shown !== undefined;
    this.bits.classList.toggle('held', this.held);
    if (!this.held) {
      this.bitCells.forEach((cell) => cell.classList.remove('same', 'at'));
      setText(this.text, howTo);
    } else if (document.activeElement === this.bits) {
      this.explain(this.at);
    }
  }

  private explain(bit: number): void {
    const frame = this.shown;
    if (!frame) {
      return;
    }
    const at = (this.at = Math.min(Math.max(bit, 0), this.bitCells.length - 1));
    const owner = this.owners[at];
    this.bitCells.forEach((cell, i) => {
      cell.classList.toggle('at', i === at);
      cell.classList.toggle('same', owner !== undefined && this.owners[i] === owner);
    });
    const byte = at >> 3;
    const place = `byte ${byte}, bit ${at & 7}`;
    const found = this.core.ownerOfBit(frame.bytes.length, byte, at & 7);
    const isFlags = byte === frame.bytes.length - 2;
    if (isFlags) {
      setText(this.text, `${flagNames[at & 7] ?? 'Not used'}: ${place}, of the flags.`);
    } else if (found && owner) {
      const value = frame.channels[Number(owner.slice(2)) - 1];
      const binary = value.toString(2).padStart(11, '0');
      setText(this.text, `${owner}, bit ${found.bit} (worth ${1 << found.bit}): ${place}. ${owner} = ${value} = ${binary} in binary.`);
    } else {
      setText(this.text, `${byte === 0 ? 'The header' : 'The end byte'}: ${place}.`);
    }
  }
}
