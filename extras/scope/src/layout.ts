// What WebAssembly says about its structs, enumerations and constants (../wasm/Layout.cpp). The page's own copies are compared
// with it.

export interface Field {
  at: number; // offset in bytes
  type: string; // "double 32"
}

type Named<T> = Map<string, Map<string, T>>;

export class Layout {
  private readonly fields: Named<Field> = new Map();
  private readonly values: Named<number> = new Map();
  private readonly sizes = new Map<string, number>();
  private readonly constants = new Map<string, number>();

  constructor(text: string) {
    for (const [what, of, ...rest] of text.trim().split('\n').map((line) => line.split(' '))) {
      if (what === 'field') {
        put(this.fields, of, rest[0], { at: Number(rest[1]), type: `${rest[2]} ${rest[3]}` });
      } else if (what === 'value') {
        put(this.values, of, rest[0], Number(rest[1]));
      } else {
        (what === 'size' ? this.sizes : this.constants).set(of, Number(rest[0]));
      }
    }
  }

  // Returns where the fields of a struct are. Throws unless it has these fields, of these types, and no others.
  struct<Name extends string>(of: string, types: Record<Name, string>): Record<Name, number> {
    const found = this.fields.get(of) ?? new Map<string, Field>();
    same(`the fields of ${of}`, types, new Map(Array.from(found, ([name, { type }]) => [name, type])));
    return Object.fromEntries(Array.from(found, ([name, { at }]) => [name, at])) as Record<Name, number>;
  }

  size(of: string): number {
    return known(of, this.sizes.get(of));
  }

  constant(name: string): number {
    return known(name, this.constants.get(name));
  }

  // Throws unless an enumeration has these names with these values, and no others.
  enumeration(of: string, values: Record<string, string | number>): void {
    const numbers = Object.entries(values).filter(([, value]) => typeof value === 'number'); // TypeScript also has names by value
    same(`the values of ${of}`, Object.fromEntries(numbers), this.values.get(of) ?? new Map());
  }
}

function put<T>(all: Named<T>, of: string, name: string, value: T): void {
  all.set(of, (all.get(of) ?? new Map<string, T>()).set(name, value));
}

function known(name: string, value: number | undefined): number {
  if (value === undefined) {
    throw new Error(`WebAssembly has no ${name}`);
  }
  return value;
}

function same<T>(what: string, here: Record<string, T>, there: ReadonlyMap<string, T>): void {
  for (const name of new Set([...Object.keys(here), ...there.keys()])) {
    if (here[name] !== there.get(name)) {
      throw new Error(`${what} differ: ${name} is ${here[name]} in the page and ${there.get(name)} in WebAssembly`);
    }
  }
}
