// The border to WebAssembly (extras/scope/border.mjs): a page that does not match it does not compile. No browser.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { cpSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { build, check } from './support.mjs';

const npm = path.join(build, 'npm');

export default async function () {
  const folder = path.join(npm, 'mismatch');
  const border = path.join(folder, 'border.ts');
  cpSync(path.join(npm, 'src'), folder, { recursive: true });
  writeFileSync(path.join(folder, 'tsconfig.json'), JSON.stringify({ extends: '../tsconfig.json', include: ['.'] }));
  const text = readFileSync(border, 'utf8');
  const mismatches = [
    [/\bwhy\b/g, 'who', "Property 'why' does not exist on type 'RecordReader'"],
    [/\bresyncs\b/g, 'resynks', `Type '"resyncs"' is not assignable to type 'keyof Status'`],
    [/Stale,/, 'Old,', "Property 'Stale' does not exist on type 'typeof LinkState'"],
    [/ HasSwitches = /, ' HasThem = ', "Property 'HasSwitches' does not exist on type 'typeof Flag'"],
    [/ recall\(/, ' remember(', "Property 'recall' does not exist on type 'Exports'"],
    [/ received\(count: number, /, ' received(', 'Expected 1 arguments, but got 2'],
    [/ carrier\(\): Text/, ' carrier(): number', "Argument of type 'number' is not assignable to parameter of type 'Text'"],
  ];
  const compiled = (edited) => {
    writeFileSync(border, edited);
    return spawnSync('node_modules/.bin/tsc', ['--noEmit', '-p', folder], { cwd: npm, encoding: 'utf8' }).stdout;
  };
  await check('with the border as it is the page compiles; each mismatch at the border is an error', async () => {
    assert.equal(compiled(text), '');
    const edited = mismatches.reduce((all, [edit, to]) => {
      assert.match(all, edit);
      return all.replace(edit, to);
    }, text);
    const said = compiled(edited);
    mismatches.forEach(([, , error]) => assert.ok(said.includes(error), `${error}: ${said}`));
  });
  rmSync(folder, { recursive: true });
}
