// The page served with its two files can be installed, and opens without its server. Alone, served or from disk, it is complete.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { browser, build, check, reads, root, toEnd, counts, until } from './support.mjs';

const page = 'index.html';
const all = [page, 'sw.js', 'manifest.webmanifest'];

// Serves these files in a folder of their own, as `make scope` does.
async function serve(files) {
  const folder = path.join(build, 'served');
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder);
  files.forEach((name) => copyFileSync(path.join(build, name), path.join(folder, name)));
  const server = spawn('node', [path.join(root, 'extras/scope/serve.mjs'), path.join(folder, page), '0'], { stdio: ['ignore', 'pipe', 'inherit'] });
  let said = '';
  server.stdout.on('data', (text) => (said += text));
  const url = () => /http:\S+/.exec(said)?.[0];
  await until('it does not serve', url);
  const gone = new Promise((resolve) => server.on('exit', resolve));
  const stop = () => {
    server.kill();
    return gone;
  };
  return { url: url(), folder, stop };
}

// Visits a server in a context of its own: check()'s page is one from disk.
async function visit(files, show) {
  const server = await serve(files);
  const context = await browser.newContext({ acceptDownloads: true });
  try {
    const served = await context.newPage();
    served.faults = [];
    served.on('pageerror', (error) => served.faults.push(error.message));
    await served.goto(server.url);
    await reads(served, '#state', 'Fine');
    await show(served, server, context);
    assert.deepEqual(served.faults, []);
  } finally {
    await context.close();
    await server.stop();
  }
}

const isKept = (served) => until('nothing is kept', () => served.evaluate(async () => {
  const { active } = (await navigator.serviceWorker.getRegistration()) ?? {};
  return active?.state === 'activated';
}));

export default async function () {
  for (const opened of ['', 'index.html', '?from=somewhere']) {
    await check(`served as /${opened}, the page opens again when the server has stopped, simulates and plays a recording`, () => visit(all, async (served, server) => {
      await isKept(served);
      await server.stop();
      await served.goto(server.url + opened);
      await served.reload();
      await reads(served, '#state', 'Fine');
      await served.setInputFiles('#file', path.join(root, 'test/recordings/paper.txt'));
      await reads(served, '#title', 'Recording paper.txt');
      await toEnd(served);
      await counts(served, 'frames', 6);
    }));
  }

  await check('Chromium would install the page when it is served', () => visit(all, async (served, server, context) => {
    await isKept(served);
    const session = await context.newCDPSession(served);
    const { url, errors } = await session.send('Page.getAppManifest');
    assert.equal(url, `${server.url}manifest.webmanifest`);
    assert.deepEqual(errors, []);
    const { installabilityErrors } = await session.send('Page.getInstallabilityErrors');
    assert.deepEqual(installabilityErrors.map(({ errorId }) => errorId), ['in-incognito']); // all pages of the tests are
  }));

  await check('while the server answers, a new build is shown at once, and kept', () => visit(all, async (served, server) => {
    await isKept(served);
    const file = path.join(server.folder, page);
    writeFileSync(file, readFileSync(file, 'utf8').replace('<title>S.Bus scope', '<title>S.Bus scope, newer'));
    await served.reload();
    assert.equal(await served.title(), 'S.Bus scope, newer');
    await server.stop();
    await served.reload();
    assert.equal(await served.title(), 'S.Bus scope, newer');
  }));

  await check('served without its two files, the page works as from disk', () => visit([page], async (served) => {
    await served.waitForTimeout(500);
    assert.equal(await served.evaluate(() => navigator.serviceWorker.getRegistration().then((found) => found === undefined)), true);
    assert.equal(await served.$('link[rel="manifest"]'), null);
  }));

  await check('opened from disk, the page requests nothing', async (fromDisk) => {
    const asked = [];
    fromDisk.on('request', (request) => /^(blob|data):/.test(request.url()) || asked.push(request.url()));
    await fromDisk.reload();
    await reads(fromDisk, '#state', 'Fine');
    await fromDisk.waitForTimeout(500);
    assert.deepEqual(asked, [fromDisk.url()]);
  });
}
