// What the browser stores for the next visit. A page opened from disk may not be allowed to store anything, and works without.

// All that is kept by the browser. From line to line the page also keeps the scale, the curves that are shown, speed and repeat.
type Key = 'baud' | 'calibration' | 'channels' | 'sensors' | 'stick-mode' | 'trigger' | `port-${string}`;

export function recall(key: Key): string | undefined {
  return attempt(() => localStorage.getItem(`sbus-scope-${key}`)) ?? undefined;
}

// Stores a value; without one, removes what is stored.
export function keep(key: Key, value?: string): void {
  attempt(() => (value === undefined ? localStorage.removeItem(`sbus-scope-${key}`) : localStorage.setItem(`sbus-scope-${key}`, value)));
}

// Returns the object that is kept as JSON; undefined if there is none, or it is damaged.
export function recallObject(key: Key): Record<string, unknown> | undefined {
  const value: unknown = attempt(() => JSON.parse(recall(key) ?? ''));
  return typeof value === 'object' && value !== null ? (value as Record<string, unknown>) : undefined;
}

function attempt<T>(act: () => T): T | undefined {
  try {
    return act();
  } catch {
    return undefined;
  }
}
