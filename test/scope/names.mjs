// Channels that the user names and hides, and the keys that go from one to the next.
import assert from 'node:assert/strict';
import { check, playRamp, reads, until } from './support.mjs';

const shown = (page) => page.$$eval('#bars li', (rows) => rows.filter((row) => row.checkVisibility()).map((row) => row.querySelector('.name').textContent));

export default async function () {
  await check('a channel that is named has its name at its bar and its curve, one that is hidden has neither; another visit finds them', async (page) => {
    await playRamp(page);
    await page.click('#names-open');
    await page.fill('[aria-label="Name of CH3"]', ' Throttle\t');
    for (let channel = 4; channel <= 16; channel++) await page.uncheck(`[aria-label="Show CH${channel}"]`);
    await page.uncheck('[aria-label="Show CH1"]');
    await page.keyboard.press('Escape');
    assert.deepEqual(await shown(page), ['CH2', 'Throttle']);
    await reads(page, '#hidden-note', '14 hidden');
    const box = await page.locator('#plot .u-over').boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + 40);
    await reads(page, '#readout', /^\d\.\d{3} s {3}CH2 \d+ {3}Throttle 992$/);
    await page.reload();
    await reads(page, '#state', 'Fine');
    await until('the names are gone', async () => (await shown(page)).join() === 'CH2,Throttle');
    await page.click('#names-open');
    await page.click('#names-clear');
    await page.click('#names-close');
    await until('they stay', async () => (await shown(page)).length === 16 && (await shown(page))[2] === 'CH3');
  });

  await check('the channels are one stop of the Tab key, with arrows within; Escape closes the condition of the trigger', async (page) => {
    await reads(page, '#state', 'Fine');
    await page.focus('#calibrate');
    await page.keyboard.press('Tab');
    const focused = () => page.evaluate(() => document.activeElement.textContent || document.activeElement.id);
    assert.equal(await focused(), 'CH1');
    for (const [key, name] of [['ArrowDown', 'CH2'], ['End', 'CH16'], ['ArrowDown', 'CH16'], ['ArrowUp', 'CH15'], ['Home', 'CH1']]) {
      await page.keyboard.press(key);
      assert.equal(await focused(), name);
    }
    let stops = 0;
    for (; stops < 12 && (await focused()) !== 'Cursors'; stops++) await page.keyboard.press('Tab');
    assert.ok(stops <= 5, `${stops} stops from the channels to the cursors`);
    await page.click('#trigger-open');
    await page.fill('#trigger-condition', 'ch1 > 1500');
    await page.keyboard.press('Escape');
    assert.ok(await page.locator('#trigger').isHidden());
    assert.equal(await focused(), 'Trigger');
  });
}
