// Channels that the user names and hides.
import assert from 'node:assert/strict';
import { clean } from './looks.mjs';
import { check, connect, downloaded, frame, opensWith, placeOf, playRamp, raw, reads, until } from './support.mjs';

const chips = (page) => page.$$eval('#bars li', (rows) => rows.filter((row) => row.offsetParent).map((row) => row.querySelector('.chip').textContent));

export default async function () {
  await check('a channel keeps its name, in its bar, curves, cursors and for screen readers; CSV has CH1 and so on', async (page) => {
    await page.click('#names-open');
    assert.equal(await page.evaluate(() => document.activeElement.getAttribute('aria-label')), 'Name of CH1');
    await page.keyboard.type('  Throttle  ');
    await clean(page);
    await page.keyboard.press('Enter');
    await reads(page, '#bars li:nth-child(1) .chip', 'Throttle');
    assert.equal(await page.evaluate(() => document.activeElement.id), 'names-open');
    await page.reload();
    await reads(page, '#bars li:nth-child(1) .chip', 'Throttle');
    assert.equal(await page.getAttribute('#bars li:nth-child(1) .track', 'aria-label'), 'Throttle (CH1)');
    await playRamp(page);
    await page.mouse.move(...(await placeOf(page, 300)));
    await reads(page, '#readout', / s {3}Throttle \d+ {3}CH2 /);
    await page.click('#cursors');
    await reads(page, '#cursor-values thead', 'Time1/ΔtThrottleCH2CH3CH4');
    assert.match((await downloaded(page, '#csv')).text, /^time,CH1,CH2,/);
    await page.click('#names-open');
    await page.click('#names-clear');
    await page.click('#names-close');
    await reads(page, '#bars li:nth-child(1) .chip', 'CH1');
    assert.equal(await page.evaluate(() => localStorage.getItem('sbus-scope-channels')), null);
  });

  await check('hidden channels have no bar and no curve, and the page says so, also the next time', async (page) => {
    await page.click('#names-open');
    for (const channel of [2, 16]) await page.uncheck(`#names-list [aria-label="Show CH${channel}"]`);
    await page.keyboard.press('Escape');
    await page.reload();
    await reads(page, '#hidden-note', '2 channels are hidden.');
    await until('it is there', async () => String(await chips(page)) === 'CH1,CH3,CH4,CH5,CH6,CH7,CH8,CH9,CH10,CH11,CH12,CH13,CH14,CH15');
    await playRamp(page);
    await page.mouse.move(...(await placeOf(page, 300)));
    await reads(page, '#readout', / s {3}CH1 \d+ {3}CH3 \d+ {3}CH4 \d+$/);
    await page.click('#names-open');
    await page.check('#names-list [aria-label="Show CH2"]');
    await page.click('#names-close');
    await reads(page, '#hidden-note', '1 channel is hidden.');
  });

  await check('names that are given in two tabs are all stored', async (page) => {
    const other = await page.context().newPage();
    await other.goto(page.url());
    await reads(other, '#state', 'Fine');
    for (const [tab, channel, name] of [[page, 1, 'Flaps'], [other, 2, 'Gear'], [page, 3, 'Lights']]) {
      await tab.bringToFront();
      await tab.click('#names-open');
      await tab.fill(`#names-list [aria-label="Name of CH${channel}"]`, name);
      await tab.click('#names-close');
    }
    await other.reload();
    await reads(other, '#state', 'Fine');
    await until(async () => `${await chips(other)}`, async () => String((await chips(other)).slice(0, 4)) === 'Flaps,Gear,Lights,CH4');
  });

  await check('stored names that are damaged are not used; a browser that stores nothing has names until the page is left', async (page) => {
    const all = Array.from({ length: 16 }, (_, i) => `CH${i + 1}`).join();
    for (const bad of ['nonsense', '[]', 'null', '7', '{"names":7,"hidden":7}', '{"names":{"-1":"x","32":"x","0":7,"y":"x"},"hidden":[-1,99,"0",null,0.5]}']) {
      await page.evaluate((value) => localStorage.setItem('sbus-scope-channels', value), bad);
      await page.reload();
      await reads(page, '#state', 'Fine');
      await until(async () => `${bad}: ${await chips(page)}`, async () => String(await chips(page)) === all);
    }
    await page.addInitScript(() => Object.defineProperty(window, 'localStorage', { get: () => { throw new DOMException('denied', 'SecurityError'); } }));
    await page.reload();
    await reads(page, '#state', 'Fine');
    await page.click('#names-open');
    await page.fill('#names-list [aria-label="Name of CH3"]', 'A name that is far too long');
    await page.click('#names-close');
    await reads(page, '#bars li:nth-child(3) .chip', 'A name that is f');
    await opensWith(page, [frame([7, 8, 9])]);
    await connect(page);
    await raw(page, 3, '9');
    await reads(page, '#bars li:nth-child(3) .chip', 'A name that is f');
  });

  await check('on a phone the names fit, and buttons and fields are 44 px high', async (page) => {
    await page.tap('#names-open');
    await page.fill('#names-list [aria-label="Name of CH3"]', 'WWWWWWWWWWWWWWWW');
    const fits = () => page.evaluate(() => document.documentElement.scrollWidth <= document.documentElement.clientWidth);
    assert.ok(await fits());
    assert.deepEqual(await page.$$eval('#names button, #names label, #names [type="text"]', (all) => all.filter((each) => each.offsetHeight < 44).map((each) => each.outerHTML)), []);
    await page.tap('#names-close');
    await reads(page, '#bars li:nth-child(3) .chip', 'WWWWWWWWWWWWWWWW');
    assert.ok(await fits());
    await clean(page);
  }, { size: { width: 360, height: 740 }, hasTouch: true, isMobile: true });
}
