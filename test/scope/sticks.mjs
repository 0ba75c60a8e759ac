// The sticks as on a radio.
import assert from 'node:assert/strict';
import { check, codes, connect, frame, opensWith, reads, until } from './support.mjs';

// Returns where a stick is, in % of its square, from the left and from the top.
const places = (page) => page.$$eval('.stick-at', (all) => all.map((each) => (each.hidden ? 'unknown' : [each.style.left, each.style.top].map(parseFloat).join())));
const texts = (page) => page.$$eval('#sticks figcaption', (all) => all.map((each) => each.textContent));
const stand = (page, ...expected) => until(async () => `${await places(page)}`, async () => JSON.stringify(await places(page)) === JSON.stringify(expected));

export default async function () {
  // 100, -100, 50 and 0 %.
  const sent = frame([1811, 172, 1401, 992]);
  for (const [mode, left, right, leftText, rightText] of [
    [1, '50,90', '90,30', 'rudder 0 %elevator -100 %', 'aileron 100 %throttle 50 %'],
    [2, '50,30', '90,90', 'rudder 0 %throttle 50 %', 'aileron 100 %elevator -100 %'],
    [3, '90,90', '50,30', 'aileron 100 %elevator -100 %', 'rudder 0 %throttle 50 %'],
    [4, '90,30', '50,90', 'aileron 100 %throttle 50 %', 'rudder 0 %elevator -100 %'],
  ]) {
    await check(`in mode ${mode} each stick's axis is where the radio has it; the browser stores the mode`, async (page) => {
      await page.selectOption('#stick-mode', String(mode));
      await page.reload();
      await until('the mode is not kept', async () => (await page.inputValue('#stick-mode')) === String(mode));
      await opensWith(page, [sent, sent, sent]);
      await connect(page);
      await until(async () => String(await places(page)), async () => (await places(page)).map((place) => place.split(',').map((part) => Math.round(part)).join()).join(' ') === `${left} ${right}`);
      await until(async () => String(await texts(page)), async () => String(await texts(page)) === `Left stick${leftText},Right stick${rightText}`);
    });
  }

  await check("a board's numbers have sticks once their unit is chosen", async (page) => {
    await connect(page, 'board');
    const print = async (row) => {
      for (let i = 0; i < 3; i++) await page.evaluate((letters) => fake.port.feed(letters), codes(`${row}\r\n`));
    };
    await print('1500,988,2012,1244');
    await reads(page, '#bars li:nth-child(4) .raw', '1244');
    await stand(page, 'unknown', 'unknown');
    await page.selectOption('#unit', 'us');
    await stand(page, '30,10', '50,90');
  });

  await check('a stored mode that does not exist is not used', async (page) => {
    for (const bad of ['5', '', 'toString']) {
      await page.evaluate((value) => localStorage.setItem('sbus-scope-stick-mode', value), bad);
      await page.reload();
      await reads(page, '#state', 'Fine');
      assert.equal(await page.inputValue('#stick-mode'), '2');
    }
  });
}
