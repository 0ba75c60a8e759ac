// The page's own modules (extras/scope/src) for node: unchanged, but without their types.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url));
export const build = process.env.SCOPE_BUILD ?? path.resolve(here, '../../build/scope');
const { transpile } = createRequire(path.join(build, 'npm/package.json'))('typescript');
export const sources = path.join(here, '../../extras/scope/src');
const written = new Set();

// Loads a module, such as 'source/port', with all that it imports.
export async function load(name) {
  write(name);
  return import(pathToFileURL(path.join(build, 'modules', `${name}.mjs`)));
}

function write(name) {
  if (written.has(name)) return;
  written.add(name);
  const folder = name === 'border' ? build : sources; // it is written with the WebAssembly
  const text = readFileSync(path.join(folder, `${name}.ts`), 'utf8');
  const code = transpile(text, { module: 'esnext', target: 'es2022' });
  const file = path.join(build, 'modules', `${name}.mjs`);
  mkdirSync(path.dirname(file), { recursive: true });
  writeFileSync(file, code.replace(/^import wasm .*$/m, "const wasm = '';").replace(/from '(\.[\w./]+)'/g, (_, other) => {
    write(path.join(path.dirname(name), other));
    return `from '${other}.mjs'`;
  }));
}

// Returns a generator of numbers from 0 to below 1, always the same ones for a seed.
export function random(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}
