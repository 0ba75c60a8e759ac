// Arithmetic that more than one module needs.

// Returns the first number from `low` to before `high` that does not come before; `high` if all do. Numbers that do are the first ones.
export function firstFrom(low: number, high: number, comesBefore: (number: number) => boolean): number {
  while (low < high) {
    const middle = (low + high) >> 1;
    [low, high] = comesBefore(middle) ? [middle + 1, high] : [low, middle];
  }
  return low;
}

// Rounds away from 0 to 1, 2 or 5 times a power of ten.
export function roundUp(value: number): number {
  const size = Math.abs(value);
  const ten = 10 ** Math.floor(Math.log10(size));
  return value === 0 ? 0 : Math.sign(value) * ten * ([1, 2, 5].find((times) => size <= times * ten) ?? 10);
}
