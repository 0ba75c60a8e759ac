import { History } from '../history';

// The dashes of a curve: its colour alone is lost on paper, and to many eyes.

const dashes = [[], [9, 3], [2, 3], [9, 3, 2, 3], [16, 4], [5, 5], [16, 3, 2, 3, 2, 3], [2, 6]];

// A sensor's curves follow the colours and dashes of the first four channels.
const shifted = (column: number): number => (column < History.channels ? column : column + 4);

export const colorOf = (column: number): number => shifted(column) % dashes.length;

// Curves of one colour, such as CH1 and CH9, also differ in their dashes.
export function dashOf(column: number): number[] {
  return dashes[(shifted(column) + Math.floor(column / dashes.length)) % dashes.length];
}
