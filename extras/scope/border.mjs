// Writes the border between the page and its WebAssembly as TypeScript, from the C++: enumerations, constants, structs as
// clang lays them out, and the functions. The compiler then finds what does not match.
//   node border.mjs LAYOUTS >border.ts     LAYOUTS: what clang++ -Xclang -fdump-record-layouts has printed
import { readdirSync, readFileSync } from 'node:fs';

const root = new URL('../../', import.meta.url);
const read = (file) => readFileSync(new URL(file, root), 'utf8').replace(/\/\/.*/g, '');
const scope = 'extras/scope/wasm/ShownLine.h';
const layouts = readFileSync(process.argv[2], 'utf8');
// A row's flags and a frame's share a bit: ShownLine.h.
const lines = ['// biome-ignore-all lint/suspicious/noDuplicateEnumValues: a row has other flags than a frame', '// Written by border.mjs from the C++ in ../wasm.', ''];

// Returns what a pattern finds in a text. Throws if that is nothing.
function find(text, pattern) {
  const found = pattern.exec(text);
  if (!found) throw new Error(`border.mjs: nothing is ${pattern}`);
  return found[1];
}

function addEnum(name, values) {
  lines.push(`export enum ${name} {`, ...values.map((value) => `  ${value},`), '}', '');
}

for (const [name, file, of = name] of [
  ['LinkState', 'src/sbus/Link.h'],
  ['Finding', 'src/sbus/Diagnosis.h'],
  ['CalibrationError', 'src/sbus/Calibrator.h'],
  ['Gap', 'extras/line/Silence.h'],
  ['Scale', scope],
  ['Kind', scope],
  ['FlightKind', 'extras/line/report/FlagSpans.h', 'Kind'],
]) {
  addEnum(name, find(read(file), new RegExp(`enum class ${of}[^{]*{([^}]*)}`)).split(',').map((value) => value.trim()).filter(Boolean));
}
const flags = ['src/sbus/Frame.h', scope].flatMap((file) => [...read(file).matchAll(/constexpr uint8_t Flag([A-Z]\w*) = (\w+);/g)]);
addEnum('Flag', flags.map(([, name, value]) => `${name} = ${value}`));

for (const [name, file] of [['Enough', scope], ['TransferSize', scope], ['EndUs', scope], ['FileHeadMax', 'extras/line/file/LineReader.h']]) {
  lines.push(`export const ${name} = ${find(read(file), new RegExp(`constexpr size_t ${name} = (\\d+);`))};`);
}
const layoutOf = (struct) => find(layouts, new RegExp(`^ *0 \\| struct ${struct}\\n([^]*?)\\n\\n`, 'm'));
const sizeOf = (struct) => find(layoutOf(struct), /\[sizeof=(\d+)/);
lines.push(`export const CharacterSize = ${sizeOf('line::Character')};`, '');

// TypeScript's type and what reads it.
const kinds = {
  double: ['number', 'getFloat64'],
  size_t: ['number', 'getUint32'],
  uint8_t: ['number', 'getUint8'],
};
const arrays = { double: 'Float64Array', uint8_t: 'Uint8Array', char: 'Uint8Array' };
for (const struct of ['Record', 'Status', 'ReadCondition']) {
  const fields = [...layoutOf(`scope::${struct}`).matchAll(/^ *(\d+) \| {3}([\w: *]+?)(?:\[(\d+)\])? (\w+)$/gm)].map(([, at, type, count, name]) => {
    const [kind, get] = count ? [arrays[type]] : type.endsWith('*') ? [typeOf(type), 'getUint32'] : (kinds[type] ?? []);
    if (!kind) throw new Error(`border.mjs: ${struct}::${name} is ${type}`);
    const value = get ? `this.view.${get}(this.at + ${at}${get === 'getUint8' ? '' : ', true'})` : `new ${kind}(this.view.buffer, this.view.byteOffset + this.at + ${at}, ${count})`;
    return { name, kind, text: `  get ${name}(): ${kind} { return ${value}${kind === 'Text' ? ' as Text' : ''}; }` };
  });
  lines.push(
    `export interface ${struct} {`, ...fields.map(({ name, kind }) => `  ${name}: ${kind};`), '}', '',
    `export class ${struct}Reader implements ${struct} {`,
    `  static readonly size = ${sizeOf(`scope::${struct}`)};`,
    '  constructor(private readonly view: DataView, public at = 0) {}',
    ...fields.map(({ text }) => text),
    ...(fields.some(({ kind }) => kind.endsWith('Array')) ? [] : [`  copy(): ${struct} { return { ${fields.map(({ name }) => `${name}: this.${name}`).join(', ')} }; }`]),
    '}', '',
  );
}

function typeOf(type) {
  return type === 'void' ? 'void' : type === 'const char *' ? 'Text' : 'number';
}

lines.push('// Where a text is that ends with 0.', 'export type Text = number & { readonly isText: true };', '');
lines.push('export interface Exports {', '  memory: WebAssembly.Memory;', '  _initialize(): void;');
for (const file of readdirSync(new URL('extras/scope/wasm', root)).filter((name) => name.endsWith('.cpp')).sort()) {
  for (const [, name, list, result] of read(`extras/scope/wasm/${file}`).matchAll(/^EXPORT\((\w+)\)\s*\(([^)]*)\)->([^{]+?) ?{/gm)) {
    const parameters = list.split(',').filter(Boolean).map((each) => `${find(each, /(\w+)$/)}: number`);
    lines.push(`  ${name}(${parameters.join(', ')}): ${typeOf(result)};`);
  }
}
lines.push('}', '');
process.stdout.write(lines.join('\n'));
