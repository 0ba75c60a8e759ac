// The dashes of a channel's curve: its colour alone is lost on paper, and to many eyes.

const dashes = [[], [9, 3], [2, 3], [9, 3, 2, 3], [16, 4], [5, 5], [16, 3, 2, 3, 2, 3], [2, 6]];

// Curves of one colour, such as CH1 and CH9, also differ in their dashes.
export function dashOf(channel: number): number[] {
  return dashes[(channel + Math.floor(channel / dashes.length)) % dashes.length];
}
