// A mouse, its wheel and fingers on the curves: what is pointed at stays under the pointer.
import assert from 'node:assert/strict';
import { check, drawn, fingers, placeOf, playRamp, ramp, reads, until } from './support.mjs';

const readsFrame = (page, i) => reads(page, '#readout', `${[`${ramp.timeS(i).toFixed(3)} s`, ...ramp.channels(i).map((value, channel) => `CH${channel + 1} ${value}`)].join('   ')}`);
const seconds = async (page) => parseFloat(await page.textContent('#window'));

export default async function () {
  await check('the wheel zooms at the pointer, in and out; a wheel turned sideways and a drag scroll; a double click resets', async (page) => {
    await playRamp(page);
    await page.click('#zoom-in');
    const [x, y] = await placeOf(page, 300);
    await page.mouse.move(x, y);
    await readsFrame(page, 300);
    await page.keyboard.down('Control');
    await page.mouse.wheel(0, -250);
    await reads(page, '#window', '1 s');
    await readsFrame(page, 300);
    await reads(page, '#pause', 'Continue');
    await page.mouse.wheel(0, 125);
    await page.keyboard.up('Control');
    await reads(page, '#window', '1.41 s');
    await readsFrame(page, 300);
    await page.mouse.down();
    await page.mouse.move(x + 150, y, { steps: 5 });
    await page.mouse.up();
    await readsFrame(page, 300);
    await page.mouse.wheel(150, 0);
    await page.mouse.move(x, y);
    await readsFrame(page, 300);
    await reads(page, '#window', '1.41 s');
    await page.mouse.dblclick(x, y);
    await reads(page, '#window', '4 s');
    await reads(page, '#pause', 'Pause');
  });

  await check('on a running line, the wheel scrolls the page, but with the key that the page names it zooms: in, and the line pauses; out, and it follows the newest', async (page) => {
    await reads(page, '#state', 'Fine');
    const box = await page.locator('#plot .u-over').boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + 100);
    await page.mouse.wheel(0, 60);
    await until('the page does not scroll', () => page.evaluate(() => scrollY === 60));
    await page.mouse.wheel(0, -60);
    await until('the page does not scroll back', () => page.evaluate(() => scrollY === 0));
    await reads(page, '#window', '10 s');
    await page.mouse.move(5, 5);
    await reads(page, '#readout', 'Drag to scroll, Ctrl and the wheel to zoom.');
    await page.mouse.move(box.x + box.width / 2, box.y + 100);
    await page.keyboard.down('Control');
    for (let i = 0; i < 8; i++) await page.mouse.wheel(0, 500);
    await reads(page, '#window', '240 s');
    await reads(page, '#pause', 'Pause');
    assert.equal(await page.evaluate(() => scrollY), 0);
    for (let i = 0; i < 14; i++) await page.mouse.wheel(0, -500);
    await reads(page, '#window', '0.1 s');
    await reads(page, '#pause', 'Continue');
    await page.focus('#plot');
    await page.keyboard.press('0');
    await reads(page, '#window', '10 s');
    await reads(page, '#pause', 'Pause');
  });

  await check('one finger scrolls; two fingers zoom between them, and move what they hold; two taps reset', async (page) => {
    await playRamp(page);
    await page.tap('#zoom-in');
    await page.locator('#plot').scrollIntoViewIfNeeded();
    const [x, y] = await placeOf(page, 300);
    const { put, move, lift } = await fingers(page);
    await put([x, y]);
    for (const px of [20, 40, 60]) await move([x + px, y]);
    await reads(page, '#pause', 'Continue');
    await move([x, y]);
    await lift();
    await put([x - 40, y], [x + 40, y]);
    for (let i = 1; i <= 10; i++) await move([x - 40 - 7 * i, y], [x + 40 + 9 * i, y]);
    await lift();
    await until(async () => `${await seconds(page)} s`, async () => (await seconds(page)) === 0.667);
    await drawn(page);
    await page.touchscreen.tap(x + 10, y);
    await reads(page, '#readout', new RegExp(`^${ramp.timeS(300).toFixed(2)}`));
    // On a busy PC two taps may be too far from each other.
    await until('two taps do nothing', async () => {
      await page.touchscreen.tap(x + 10, y);
      await page.touchscreen.tap(x + 10, y);
      return (await seconds(page)) === 4;
    });
    await reads(page, '#pause', 'Pause');
  }, { size: { width: 820, height: 1180 }, hasTouch: true, isMobile: true });
}
