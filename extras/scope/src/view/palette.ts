// The theme's colours as numbers, for a canvas and for a picture: they know neither variables nor light-dark().

const names = ['card', 'ink', 'muted', 'grid', 'alarm-band', 'warning-band', 'alarm'] as const;
const curves = 8;

export type Palette = Record<(typeof names)[number], string> & { curves: string[] };

// `probe`: an element of the page, whose colour is set and taken back.
export function paletteOf(probe: HTMLElement): Palette {
  const color = (name: string): string => {
    probe.style.color = `var(--${name})`;
    return getComputedStyle(probe).color;
  };
  const palette = Object.fromEntries(names.map((name) => [name, color(name)])) as Omit<Palette, 'curves'>;
  const all = { ...palette, curves: Array.from({ length: curves }, (_, i) => color(`c${i}`)) };
  probe.style.color = '';
  return all;
}
