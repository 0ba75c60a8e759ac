// Sizes, themes, keyboard and screen readers.
import assert from 'node:assert/strict';
import { axe, check, connect, reads, until } from './support.mjs';

const sizes = {
  desktop: { width: 1440, height: 900 },
  tablet: { width: 820, height: 1180 },
  phone: { width: 360, height: 740 },
};

async function clean(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] }));
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => `${node.target} ${node.failureSummary}`).join('; ')}`), []);
}

const fits = async (page) => {
  const { wide, room, small } = await page.evaluate(() => ({
    wide: document.documentElement.scrollWidth,
    room: document.documentElement.clientWidth,
    small: [...document.querySelectorAll('button, select')].filter((button) => button.offsetParent && button.offsetHeight < 24).map((button) => button.id),
  }));
  assert.ok(wide <= room, `${wide} px wide, ${room} px of room`);
  assert.deepEqual(small, []);
};

export default async function () {
  for (const [name, size] of Object.entries(sizes)) {
    for (const colorScheme of ['light', 'dark']) {
      await check(`${name}, ${colorScheme}: it fits, and axe-core finds nothing`, async (page) => {
        await reads(page, '#state', 'Fine');
        await fits(page);
        await clean(page);
      }, { size, colorScheme });
    }
  }
  await check('at 200 % it fits, and axe-core finds nothing', async (page) => {
    await reads(page, '#state', 'Fine');
    await fits(page);
    await clean(page);
  }, { size: { width: 640, height: 400 }, deviceScaleFactor: 2 });

  for (const colorScheme of ['light', 'dark']) {
    await check(`stale, ${colorScheme}: axe-core finds nothing`, async (page) => {
      await reads(page, '#state', 'Fine');
      await page.click('#cut');
      await reads(page, '#verdict-text', /^NO SIGNAL/);
      await page.click('#calibrate');
      await clean(page);
    }, { colorScheme });
    await check(`noise, ${colorScheme}: axe-core finds nothing`, async (page) => {
      await page.selectOption('#fault', 'noise');
      await page.selectOption('#receiver', '32');
      await reads(page, '#verdict-text', /^NOISE/);
      await clean(page);
    }, { colorScheme });
    await check(`failsafe, ${colorScheme}: axe-core finds nothing`, async (page) => {
      await page.evaluate(async () => {
        const frame = [0x0f, ...new Array(22).fill(0x11), 0x0f, 0]; // after a 00 its flags would be a second header
        fake.port.onOpen = () => fake.every(9, frame);
      });
      await connect(page);
      await reads(page, '#state', 'Failsafe');
      await clean(page);
    }, { colorScheme });
  }

  await check('the theme follows the system until its button is pressed', async (page) => {
    const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await background();
    await page.click('#theme');
    assert.notEqual(await background(), light);
    await page.click('#theme');
    assert.equal(await background(), light);
  }, { colorScheme: 'light' });

  await check('everything can be reached and worked by keyboard', async (page) => {
    const reached = new Set();
    for (let i = 0; i < 45; i++) {
      await page.keyboard.press('Tab');
      reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.className));
    }
    for (const id of ['source-simulated', 'source-adapter', 'source-board', 'source-recording', 'record', 'csv', 'theme', 'receiver', 'fault', 'cut', 'scale', 'calibrate', 'chip', 'pause', 'plot', 'bits']) {
      assert.ok(reached.has(id), `${id} is not reached`);
    }
    await page.focus('#cut');
    await page.keyboard.press('Enter');
    await reads(page, '#state', 'Stale');
  });

  await check('a screen reader hears the verdict, and the channels as meters', async (page) => {
    await reads(page, '#announcement[role="status"]', /^ALL WELL/);
    await until('CH7 has no value', async () => (await page.getAttribute('#bars li:nth-child(7) .track', 'aria-valuenow')) === '992');
    assert.equal(await page.getAttribute('#bars li:nth-child(7) .track', 'role'), 'meter');
    assert.equal(await page.getAttribute('#bars li:nth-child(7) .track', 'aria-label'), 'CH7');
  });
}
