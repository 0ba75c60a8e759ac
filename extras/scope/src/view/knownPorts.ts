// Ports that the user has allowed before, for as long as they are plugged in: one click opens one again, as the adapter or board
// that it was the last time.

import { make, setAttribute } from '../dom';
import { deviceName, idsOf, isLikelyAdapter, type PortKind } from '../source/device';
import { keep, recall } from '../storage';

const keyOf = (port: SerialPort): `port-${string}` => `port-${idsOf(port.getInfo())}`;

export class KnownPorts {
  private readonly buttons = new Map<SerialPort, HTMLButtonElement>();

  constructor(
    private readonly root: HTMLElement,
    private readonly open: (port: SerialPort, kind: PortKind) => void,
  ) {
    for (const event of ['connect', 'disconnect']) {
      navigator.serial?.addEventListener(event, () => void this.list());
    }
    void this.list();
  }

  // Keeps as what the port was opened.
  remember(port: SerialPort, kind: PortKind): void {
    keep(keyOf(port), kind);
    void this.list();
  }

  // `isOpen`: whether the page looks at that port.
  draw(isOpen: (port: SerialPort) => boolean): void {
    this.buttons.forEach((button, port) => setAttribute(button, 'aria-pressed', String(isOpen(port))));
  }

  private async list(): Promise<void> {
    const ports = (await navigator.serial?.getPorts().catch(() => [])) ?? [];
    this.buttons.forEach((button, port) => {
      if (!ports.includes(port)) {
        button.remove();
        this.buttons.delete(port);
      }
    });
    for (const port of ports) {
      const button = this.buttons.get(port) ?? this.add(port);
      setAttribute(button, 'title', `Reopen it as ${this.kindOf(port) === 'adapter' ? 'an adapter' : 'a board'}`);
    }
  }

  private add(port: SerialPort): HTMLButtonElement {
    const button = make('button', {}, deviceName(port.getInfo()));
    button.setAttribute('aria-pressed', 'false');
    button.addEventListener('click', () => this.open(port, this.kindOf(port)));
    this.buttons.set(port, button);
    this.root.append(button);
    return button;
  }

  private kindOf(port: SerialPort): PortKind {
    const kept = recall(keyOf(port));
    return kept === 'adapter' || kept === 'board' ? kept : isLikelyAdapter(port.getInfo()) ? 'adapter' : 'board';
  }
}
