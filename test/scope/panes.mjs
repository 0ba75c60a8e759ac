// Places to look from: what stands where at three sizes, and only what a source has.
import assert from 'node:assert/strict';
import { check, codes, connect, drawn, frame, opensWith, reads, recorded, seek, toEnd, until } from './support.mjs';

const boxOf = (page, selector) => page.$eval(selector, (element) => {
  const { left, right, top, bottom, width, height } = element.getBoundingClientRect();
  return { left, right, top: top + scrollY, bottom: bottom + scrollY, width, height };
});
const above = async (page, selector, fold) => {
  const { bottom } = await boxOf(page, selector);
  assert.ok(bottom <= fold, `${selector} ends at ${bottom} px, the fold is at ${fold}`);
};
const shown = (page, selector) => page.$eval(selector, (element) => element.checkVisibility());
const phone = { size: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

// The port brings this text twenty times a second.
const printing = (page, text) => page.evaluate((bytes) => (fake.port.onOpen = () => fake.every(50, bytes)), codes(text));

export default async function () {
  await check('2560 x 1440: the page has all the width, and the curves more height', async (page) => {
    await reads(page, '#state', 'Fine');
    assert.ok((await boxOf(page, '#channels')).left <= 24);
    assert.ok((await boxOf(page, '.curves')).right >= 2536);
    assert.ok((await boxOf(page, '#plot')).height >= 860);
    const canvas = await boxOf(page, '#plot canvas');
    assert.ok(Math.abs(canvas.height - (await boxOf(page, '#plot')).height) < 2, 'the curves do not fill their pane');
    await above(page, '#bit-text', 1440);
  }, { size: { width: 2560, height: 1440 } });

  await check('1280 x 800: channels, sticks and counters are above the fold', async (page) => {
    await reads(page, '#state', 'Fine');
    for (const selector of ['#bars', '#sticks', '#counters', '#plot']) await above(page, selector, 800);
  }, { size: { width: 1280, height: 800 } });

  await check('a phone shows verdict, link, sticks and losses first, and all 25 bytes without scrolling sideways', async (page) => {
    await reads(page, '#state', 'Fine');
    for (const selector of ['#verdict', '#state', '#sticks', '#losses-chart']) await above(page, selector, 844);
    assert.ok((await boxOf(page, '#state')).bottom < (await boxOf(page, '#sticks')).top);
    await reads(page, '#lines li:first-child code', /^([0-9A-F]{2} ){24}[0-9A-F]{2}$/);
    const all = await page.$$eval('#lines code, #bits .byte', (places) => places.filter((each) => each.checkVisibility()).map((each) => {
      const { left, right, width } = each.getBoundingClientRect();
      return [left >= 0 && right <= 390 && each.scrollWidth <= width + 1, each.textContent];
    }));
    assert.deepEqual(all.filter(([fits]) => !fits), []);
    assert.ok(all.length > 25);
    const { height } = await page.evaluate(() => ({ height: document.documentElement.scrollHeight }));
    assert.ok(height < 3370, `the page is ${height} px high`);
  }, phone);

  await check('a board that prints plain numbers shows no flags, no bytes, no sticks', async (page) => {
    await printing(page, '12.5,80,-3\r\n');
    await connect(page, 'board');
    await reads(page, '#verdict-text', 'Receiving rows from a board.');
    for (const selector of ['#bars', '#plot']) assert.ok(await shown(page, selector), selector);
    for (const selector of ['.frames', '.losses', '.stick-card', '.indicators', '#indicator-failsafe', '#telemetry', '#calibrate', '#bars .us', '#guide']) {
      await until(`${selector} is not shown`, async () => !(await shown(page, selector)));
    }
    await reads(page, '#link', /Newest row.*Row interval/);
    await page.selectOption('#unit', 'raw');
    await until('raw numbers are not scaled', () => shown(page, '#calibrate'));
  });

  await check('on a phone the tiles of a board without flags have all the width', async (page) => {
    await printing(page, '12.5,80,-3\r\n');
    await connect(page, 'board');
    await until('flags are shown', async () => !(await shown(page, '.indicators')));
    const [link, last] = [await boxOf(page, '#link'), await boxOf(page, '#link > :last-child')];
    assert.ok(link.right - last.right < 1, `they end at ${last.right} px, their row at ${link.right}`);
  }, phone);

  await check('both sticks have one size, whatever their words', async (page) => {
    await opensWith(page, [1, 2, 3].map(() => frame([992, 172, 992, 992]))); // elevator -100 %
    await connect(page);
    await reads(page, '#sticks', /elevator -100 %/);
    assert.equal((await boxOf(page, '.stick')).width, (await boxOf(page, 'figure:last-child .stick')).width);
  });

  await check('a board that prints flags shows these, and sticks once its unit is known', async (page) => {
    await printing(page, '992,992,992,992,0,1\r\n');
    await connect(page, 'board');
    await page.waitForSelector('#indicator-lost-frame[data-on="true"]');
    for (const [selector, is] of [['#indicator-failsafe', true], ['#indicator-ch17', false], ['.losses', true], ['.frames', false], ['.stick-card', false]]) {
      await until(selector, async () => (await shown(page, selector)) === is);
    }
    await page.selectOption('#unit', 'raw');
    await until('there are no sticks', () => shown(page, '.stick-card'));
    await page.click('#source-simulated');
    await until('S.Bus lacks its views', async () => (await shown(page, '.frames')) && (await shown(page, '#indicator-ch17')));
  });

  await check('an adapter without a signal: the page shows its pins instead of empty views, until a frame comes', async (page) => {
    await connect(page);
    await page.waitForSelector('#guide');
    const text = await page.$eval('#guide', (guide) => guide.innerText);
    assert.match(text, /S-BUS_OUT.*RXD/);
    assert.doesNotMatch(text, /GP1/);
    for (const selector of ['#bars', '#plot', '#link', '.stick-card', '.frames', '.losses']) assert.equal(await shown(page, selector), false, selector);
    assert.equal((await boxOf(page, '.counters')).left, (await boxOf(page, '#guide')).left);
    await page.evaluate((bytes) => fake.every(9, bytes), frame([1000]));
    await reads(page, '#state', 'Fine');
    for (const selector of ['#bars', '#plot', '#link', '.stick-card', '.frames', '.losses']) await until(`${selector} is not there`, () => shown(page, selector));
    assert.equal(await shown(page, '#guide'), false);
  });

  await check('a recording that is paused before its first frame shows its views; one that has ended without a frame says what it lacks', async (page) => {
    const file = (name, text) => ({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });
    await page.setInputFiles('#file', file('late.txt', [1, 2, 3].map((i) => recorded(5e6 + 9000 * i, frame([1000]))).join('')));
    await reads(page, '#title', 'Recording late.txt');
    await page.click('#play');
    await seek(page, 0);
    await reads(page, '#position-text', /^0:00\.0/);
    await page.evaluate(() => fake.skip(5000));
    await drawn(page);
    await drawn(page);
    assert.equal(await shown(page, '#guide'), false);
    for (const selector of ['#bars', '#plot', '.frames']) assert.ok(await shown(page, selector), selector);
    await page.setInputFiles('#file', file('none.txt', recorded(5e6, [1, 2, 3])));
    await reads(page, '#title', 'Recording none.txt');
    await toEnd(page);
    await until('it does not say so', () => shown(page, '#guide'));
    assert.match(await page.$eval('#guide', (guide) => guide.innerText), /The file has no frame up to here/);
  });

  await check('a board without a signal: its pins; the simulation: its button', async (page) => {
    for (const [silence, said, end] of [
      [() => connect(page, 'board'), /Grasshopper\s+D0/, '#source-simulated'],
      [() => page.selectOption('#fault', 'silent'), /Cut the wire/, '#cut'],
    ]) {
      await silence();
      await page.waitForSelector('#guide');
      assert.match(await page.$eval('#guide', (guide) => guide.innerText), said);
      await page.click(end);
      await reads(page, '#state', 'Fine');
      assert.equal(await shown(page, '#guide'), false);
    }
  });

  await check('no time on the curves is negative', async (page) => {
    await page.addInitScript(() => {
      const write = CanvasRenderingContext2D.prototype.fillText;
      globalThis.written = [];
      CanvasRenderingContext2D.prototype.fillText = function (text, ...more) {
        globalThis.written.push(text);
        return write.call(this, text, ...more);
      };
    });
    await page.reload();
    await reads(page, '#state', 'Fine');
    await until('nothing is written', () => page.evaluate(() => globalThis.written.includes('0 s')));
    assert.deepEqual(await page.evaluate(() => globalThis.written.filter((text) => /^-.* s$/.test(text))), []);
  });

  await check('a frame that is there at once needs no guide', async (page) => {
    await page.evaluate(() => {
      fake.guided = 0;
      new MutationObserver(() => (fake.guided += Number(!document.querySelector('#guide').hidden))).observe(document.querySelector('#guide'), { attributes: true });
    });
    await opensWith(page, [frame([1000]), frame([1001]), frame([1002])]);
    await connect(page);
    await reads(page, '#bars li:first-child .raw', '1002');
    await page.waitForTimeout(2000);
    assert.equal(await page.evaluate(() => fake.guided), 0);
  });
}
