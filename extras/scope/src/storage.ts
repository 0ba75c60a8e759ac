// What the browser keeps for the next time, where it lets the page: one that was opened from disk may keep nothing, and goes on.

export function recall(key: string): string | undefined {
  return attempt(() => localStorage.getItem(`sbus-scope-${key}`)) ?? undefined;
}

// Without a value it is forgotten.
export function keep(key: string, value?: string): void {
  attempt(() => (value === undefined ? localStorage.removeItem(`sbus-scope-${key}`) : localStorage.setItem(`sbus-scope-${key}`, value)));
}

// Returns the object that is kept as JSON; {} if it is damaged or no object.
export function recallObject(key: string): Record<string, unknown> {
  const value: unknown = attempt(() => JSON.parse(recall(key) ?? ''));
  return typeof value === 'object' && value !== null ? (value as Record<string, unknown>) : {};
}

function attempt<T>(act: () => T): T | undefined {
  try {
    return act();
  } catch {
    return undefined;
  }
}
