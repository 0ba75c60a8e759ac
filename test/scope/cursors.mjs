// Two cursors on the curves, and the differences between them.
import assert from 'node:assert/strict';
import { clean } from './looks.mjs';
import { check, codes, connect, counts, drawn, fingers, placeOf, playRamp, ramp, reads, until } from './support.mjs';

// The table: by row, then by column.
const table = (page) => page.$$eval('#cursor-values tr', (rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent)));
const shows = (page, expected) => {
  let now;
  return until(() => `${JSON.stringify(now)}, not ${JSON.stringify(expected)}`, async () => JSON.stringify((now = (await table(page)).slice(1))) === JSON.stringify(expected));
};
// The middle of the line of cursor A or B.
const lineOf = async (page, name) => {
  await drawn(page);
  const box = await page.locator(`.cursor[aria-label="Cursor ${name}"]`).boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
};
const rows = (a, b) => {
  const [dt, values] = [ramp.timeS(b) - ramp.timeS(a), [a, b].map((i) => ramp.channels(i))];
  const signed = (value) => (value > 0 ? `+${value}` : `${value}`);
  return [
    ['A', `${ramp.timeS(a).toFixed(3)} s`, '', ...values[0].map(String)],
    ['B', `${ramp.timeS(b).toFixed(3)} s`, '', ...values[1].map(String)],
    ['B − A', `${dt > 0 ? '+' : ''}${dt.toFixed(3)} s`, `${+(1 / Math.abs(dt)).toPrecision(4)} Hz`, ...values[0].map((value, i) => signed(values[1][i] - value))],
  ];
};

export default async function () {
  await check('two cursors dragged to two frames show times, 1/Δt, the values of each curve and the differences; the button removes them', async (page) => {
    await playRamp(page);
    await page.click('#zoom-in');
    await reads(page, '#window', '2 s');
    await page.click('#cursors');
    assert.equal(await page.getAttribute('#cursors', 'aria-pressed'), 'true');
    for (const [name, i] of [['A', 360], ['B', 320]]) {
      await page.mouse.move(...(await lineOf(page, name)));
      await page.mouse.down();
      await page.mouse.move(...(await placeOf(page, i)), { steps: 3 });
      await page.mouse.up();
    }
    await shows(page, rows(360, 320));
    await reads(page, '#window', '2 s');
    await page.click('#bars li:nth-child(3) .chip');
    await until('CH3 is still there', async () => (await table(page))[0].join() === ',Time,1/Δt,CH1,CH2,CH4');
    await page.click('#cursors');
    await page.waitForSelector('#cursor-values', { state: 'hidden' });
    assert.equal(await page.locator('.cursor:visible').count(), 0);
    await page.click('#cursors');
    await page.waitForSelector('#cursor-values');
    await page.keyboard.press('Escape');
    await page.waitForSelector('#cursor-values', { state: 'hidden' });
  });

  await check('keys move cursors from frame to frame and to the edges, and the curves follow; Escape clears them', async (page) => {
    await playRamp(page);
    for (let i = 0; i < 4; i++) await page.click('#zoom-in');
    await reads(page, '#window', '0.5 s');
    await page.focus('#plot');
    await page.keyboard.press('C');
    assert.equal(await page.evaluate(() => document.activeElement.getAttribute('aria-label')), 'Cursor A');
    await page.keyboard.press('End');
    await page.keyboard.press('Tab');
    await page.keyboard.press('End');
    for (let i = 0; i < 3; i++) await page.keyboard.press('ArrowLeft');
    await shows(page, rows(ramp.count - 1, ramp.count - 4));
    assert.equal(await page.getAttribute('.cursor[aria-label="Cursor B"]', 'aria-valuetext'), `${ramp.timeS(ramp.count - 4).toFixed(3)} s`);
    for (let i = 0; i < 30; i++) await page.keyboard.press('PageDown'); // three widths to the left
    await until('the curves do not follow', async () => {
      const [[x], box] = [await lineOf(page, 'B'), await page.locator('#plot .u-over').boundingBox()];
      return x > box.x && x < box.x + box.width && (await page.locator('.cursor.away').count()) === 1;
    });
    await page.keyboard.press('Escape');
    await page.waitForSelector('#cursor-values', { state: 'hidden' });
    assert.equal(await page.evaluate(() => document.activeElement.id), 'cursors');
  });

  await check('a finger drags cursors, and the curves stay where they are', async (page) => {
    await playRamp(page);
    await page.tap('#zoom-in');
    await page.tap('#cursors');
    await page.locator('#plot').scrollIntoViewIfNeeded();
    const { put, move, lift } = await fingers(page);
    for (const [name, i] of [['A', 280], ['B', 330]]) {
      const [[fromX, y], [toX]] = [await lineOf(page, name), await placeOf(page, i)];
      await put([fromX, y]);
      for (let step = 1; step <= 5; step++) await move([fromX + ((toX - fromX) * step) / 5, y]);
      await lift();
    }
    const near = (await table(page)).slice(1).map((row) => parseFloat(row[1])); // a pixel of a phone is more than a frame
    assert.ok(Math.abs(near[0] - ramp.timeS(280)) < 0.02 && Math.abs(near[1] - ramp.timeS(330)) < 0.02, String(near));
    await reads(page, '#window', '2 s');
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= document.documentElement.clientWidth));
  }, { size: { width: 390, height: 844 }, hasTouch: true, isMobile: true });

  await check("cursors on a board's numbers differ in their unit; another source clears them", async (page) => {
    await connect(page, 'board');
    for (const [before, row] of ['0,0', '0.25,-1', '0.25,-1', '0.75,0.5'].entries()) { // the first may be cut off: it is not shown
      await page.evaluate((letters) => fake.port.feed(letters), codes(`${row}\r\n`));
      await counts(page, 'rows', before); // rows that are read at once have one time
      await page.evaluate(() => fake.skip(200));
    }
    await page.focus('#plot');
    await page.keyboard.press('c');
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('Tab');
    await page.keyboard.press('End');
    await until('the values do not differ', async () => (await table(page))[3]?.slice(3).join() === '+0.5,+1.5');
    await clean(page);
    await page.click('#source-simulated');
    await page.waitForSelector('#cursor-values', { state: 'hidden' });
    await reads(page, '#pause', 'Pause');
  });
}
