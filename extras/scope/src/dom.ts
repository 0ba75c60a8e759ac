// Helpers for the page's elements.

export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  const element = document.getElementById(id);
  if (!element) {
    throw new Error(`index.html has no #${id}`);
  }
  return element as T;
}

type Attributes = Record<string, string | number | boolean>;

export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== false) {
      element.setAttribute(name, String(value));
    }
  }
  element.append(...children);
  return element;
}

export function svg(tag: string, attributes: Attributes = {}, ...children: Element[]): SVGElement {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  Object.entries(attributes).forEach(([name, value]) => element.setAttribute(name, String(value)));
  element.append(...children);
  return element;
}

// Changes the page only if the text differs.
export function setText(element: HTMLElement, text: string): void {
  if (element.textContent !== text) {
    element.textContent = text;
  }
}

export function setAttribute(element: Element, name: string, value: string): void {
  if (element.getAttribute(name) !== value) {
    element.setAttribute(name, value);
  }
}

export function download(name: string, parts: BlobPart[], type: string): void {
  const url = URL.createObjectURL(new Blob(parts, { type }));
  make('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60000);
}

const standsMs = 700;

// Tells screen readers a text once it has not changed for a moment, and not too soon after the last one.
export class Announcer {
  private text = '';
  private sinceMs = 0;
  private saidMs = -Infinity;

  constructor(
    private readonly region: HTMLElement,
    private readonly restMs = 5000,
  ) {}

  // Call it for each picture.
  say(text: string): void {
    const now = performance.now();
    if (text !== this.text) {
      this.text = text;
      this.sinceMs = now;
    }
    if (text !== this.region.textContent && now - this.sinceMs > standsMs && now - this.saidMs > this.restMs) {
      this.saidMs = now;
      setText(this.region, text);
    }
  }
}
