// The telemetry of S.BUS2: a card that is shown while slots come.

import { byId, make } from '../dom';
import { Throttle } from '../throttle';

const drawMs = 200;

export class TelemetryView {
  private readonly card = byId('telemetry');
  private readonly list = byId('telemetry-list');
  private readonly drawing = new Throttle(drawMs);
  private shown = '';

  draw(lines: readonly string[]): void {
    const text = lines.join();
    if (text === this.shown || !this.drawing.due) {
      return;
    }
    this.shown = text;
    this.card.hidden = lines.length === 0;
    const [slots, ...quantities] = lines;
    this.list.replaceChildren(...[...quantities, slots].filter(Boolean).map((line) => make('li', {}, line)));
  }
}
