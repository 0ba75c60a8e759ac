// The times that the page shows: those of the file, which are below 0 before a capture's trigger. Everywhere else a line's times
// begin at 0.

let zeroUs = 0;

// Sets the file's own time at the line's time 0, not above 0. `us`: 0 of any other line.
export function setZero(us: number): void {
  zeroUs = us;
}

export const shownSeconds = (seconds: number): number => seconds + zeroUs / 1e6;

// Returns an axis's tick, rounded to so many digits, or exact if it is not a round time of the file.
export const tickText = (seconds: number, digits: number): string =>
  `${zeroUs === 0 ? seconds.toFixed(digits) : +shownSeconds(seconds).toFixed(6)} s`;

// Returns "10 s", or "60 min" for what is longer than the page keeps.
export const widthText = (seconds: number): string => (seconds > 240 ? `${+(seconds / 60).toPrecision(3)} min` : `${+seconds.toPrecision(3)} s`);

// Returns "1.234 s" for a time of the line.
export const secondsText = (us: number, digits = 3): string => `${((us + zeroUs) / 1e6).toFixed(digits)} s`;

// Returns 1:02.345 for a time of the line.
export function clock(us: number, digits = 3): string {
  const shown = us + zeroUs;
  const units = Math.floor(Math.abs(shown) / 10 ** (6 - digits));
  const minute = 60 * 10 ** digits;
  const seconds = ((units % minute) / 10 ** digits).toFixed(digits);
  return `${shown < 0 ? '-' : ''}${Math.floor(units / minute)}:${seconds.padStart(digits + 3, '0')}`;
}
