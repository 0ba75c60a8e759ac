// Makes the pictures of README.md, light and dark: the page with a simulated flight, played to its end.
//   node picture.mjs BUILD FLIGHT FOLDER    BUILD has the page, FLIGHT is a recording, the pictures go to FOLDER
import { writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [build, flight, folder] = process.argv.slice(2).map((name) => path.resolve(name));
const { chromium } = createRequire(path.join(build, 'npm/package.json'))('playwright-core');
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox', '--disable-gpu'] });
const page = await browser.newPage({ viewport: { width: 1100, height: 900 } });

async function until(isSo) {
  for (const end = Date.now() + 60000; !(await page.evaluate(isSo)); ) {
    if (Date.now() > end) throw new Error(`not in a minute: ${isSo}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

await page.goto(pathToFileURL(path.join(build, 'index.html')).href);
await until(() => document.querySelector('#verdict-text').textContent !== '');
await page.setInputFiles('#file', flight);
await until(() => /^Recording/.test(document.querySelector('#title').textContent) && document.querySelector('#whole-text').textContent !== '');
await page.evaluate(() => {
  const position = document.querySelector('#position');
  position.value = 1e9;
  position.dispatchEvent(new Event('input'));
});
await until(() => document.querySelector('#play').textContent === 'Play');
const session = await page.context().newCDPSession(page);
for (const colorScheme of ['light', 'dark']) {
  await page.emulateMedia({ colorScheme });
  await page.waitForTimeout(500); // until it is drawn in these colours
  const clip = await page.evaluate(() => {
    const top = Math.round(document.querySelector('#link').getBoundingClientRect().top) - 10;
    const { bottom } = document.querySelector('#plot').closest('.card').getBoundingClientRect();
    return { x: 0, y: top, width: innerWidth, height: Math.round(bottom) + 10 - top, scale: 1 };
  });
  const { data } = await session.send('Page.captureScreenshot', { format: 'webp', quality: 80, clip });
  writeFileSync(path.join(folder, `scope-${colorScheme}.webp`), Buffer.from(data, 'base64'));
}
await browser.close();
