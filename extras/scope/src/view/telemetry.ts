// The telemetry of S.BUS2: a card that is shown while slots come.

import { byId, make } from '../dom';

const drawMs = 200;

export class TelemetryView {
  private readonly card = byId('telemetry');
  private readonly list = byId('telemetry-list');
  private drawnAt = 0;
  private shown = '';

  draw(lines: readonly string[]): void {
    const now = performance.now();
    const text = lines.join();
    if (text === this.shown || now - this.drawnAt < drawMs) {
      return;
    }
    this.drawnAt = now;
    this.shown = text;
    this.card.hidden = lines.length === 0;
    const [slots, ...quantities] = lines;
    this.list.replaceChildren(...[...quantities, slots].filter(Boolean).map((line) => make('li', {}, line)));
  }
}
