// Sizes, themes, keyboard and screen readers.
import assert from 'node:assert/strict';
import path from 'node:path';
import { axe, check, connect, frame, play, playToEnd, reads, recorded, root, until } from './support.mjs';

const sizes = {
  desktop: { width: 1440, height: 900 },
  tablet: { width: 820, height: 1180 },
  phone: { width: 360, height: 740 },
};

export async function clean(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] }));
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => `${node.target} ${node.failureSummary}`).join('; ')}`), []);
}

export const fits = async (page) => {
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
    await check(`${name}: a running line, dark and light, a recording with its strip, and no signal fit, and axe-core finds nothing`, async (page) => {
      const isGood = async () => {
        await fits(page);
        await clean(page);
      };
      await reads(page, '#state', 'Fine');
      await isGood();
      await page.click('#theme');
      await isGood();
      await playToEnd(page, path.join(root, 'test/recordings/paper.txt'));
      await page.click('#fault-back');
      await reads(page, '#fault-text', 'Fault 1 of 1: no frames, 0:00.181 to 0:00.363.');
      await isGood();
      await connect(page);
      await page.waitForSelector('#guide');
      await isGood();
    }, { size });
  }
  for (const [scale, size, most] of [[2, { width: 640, height: 400 }, 120], [4, { width: 320, height: 256 }, 90]]) {
    await check(`at ${100 * scale} % it fits, its header leaves room, and axe-core finds nothing`, async (page) => {
      await reads(page, '#state', 'Fine');
      const { height } = await page.locator('.top').boundingBox();
      assert.ok(height <= most, `the header has ${height} px`);
      await fits(page);
      await clean(page);
    }, { size, deviceScaleFactor: scale });
  }

  await check('on a phone a long file name fits', async (page) => {
    await play(page, `${'long'.repeat(30)}.txt`, recorded(9000, frame([1000])));
    await fits(page);
  }, { size: sizes.phone });

  for (const colorScheme of ['light', 'dark']) {
    await check(`stale, noise and failsafe, ${colorScheme}: axe-core finds nothing`, async (page) => {
      await reads(page, '#state', 'Fine');
      await page.click('#cut');
      await reads(page, '#verdict-text', /^Signal lost/);
      await page.click('#calibrate');
      await clean(page);
      await page.selectOption('#fault', 'noise');
      await page.selectOption('#receiver', '32');
      await reads(page, '#verdict-text', /^Noise/);
      await clean(page);
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

  await check('everything can be reached and used by keyboard', async (page) => {
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
    await reads(page, '#announcement[role="status"]', /^Simulation/);
    await until('CH7 has no value', async () => (await page.getAttribute('#bars li:nth-child(7) .track', 'aria-valuenow')) === '992');
    assert.equal(await page.getAttribute('#bars li:nth-child(7) .track', 'role'), 'meter');
    assert.equal(await page.getAttribute('#bars li:nth-child(7) .track', 'aria-label'), 'CH7');
  });

  // Makes the page draw as on a busy PC: every 5 to 60 ms of a clock that runs as fast as the PC can. Calls `watch` after each
  // picture, with the time.
  const busy = (page, watch) => page.addInitScript(`{
    let seed = 20181;
    let now = 0;
    performance.now = () => now;
    requestAnimationFrame = (draw) => setTimeout(() => {
      seed = (seed * 1103515245 + 12345) % 2147483648;
      now += 5 + (seed % 56);
      draw(now);
      (${watch})(now);
      globalThis.busyMs = now;
    });
  }`);
  const busyFor = async (page, seconds) => {
    for (let part = 5; part <= seconds; part += 5) {
      await until('the page stands still', async () => (await page.evaluate(() => globalThis.busyMs)) > 1000 * part);
    }
  };

  await check("a meter's value is one that the page showed within the last second, however busy the PC is", async (page) => {
    await busy(page, (now) => {
      const seen = (globalThis.seen ??= []);
      const at = (selector) => document.querySelector(`#bars li:nth-child(1) ${selector}`);
      seen.push([now, at('.raw')?.textContent]);
      const spoken = at('.track')?.getAttribute('aria-valuenow');
      if (now > 2000 && !seen.some(([ms, text]) => ms >= now - 1000 && text === spoken)) {
        globalThis.old = (globalThis.old ?? 0) + 1;
      }
    });
    await page.reload();
    await busyFor(page, 30);
    assert.equal(await page.evaluate(() => globalThis.old), undefined);
  });

  await check('no live region floods a screen reader: during noise, in a calibration, and with the pointer on the curves', async (page) => {
    await busy(page, () => {
      const said = (globalThis.said ??= new Map());
      for (const region of document.querySelectorAll('[role="status"], [role="alert"], output, [aria-live]')) {
        const [count, text] = said.get(region.id) ?? [0, ''];
        said.set(region.id, [count + (region.textContent !== text), region.textContent]);
      }
    });
    await page.reload();
    await page.selectOption('#fault', 'storm');
    await page.click('#calibrate');
    const plot = await page.locator('#plot .u-over').boundingBox();
    await page.mouse.move(plot.x + plot.width - 40, plot.y + 50);
    await reads(page, '#readout', /CH1/);
    const seconds = 40;
    await busyFor(page, seconds);
    const said = await page.evaluate(() => [...globalThis.said].map(([id, [count]]) => [id, count]));
    assert.ok(said.length >= 5, String(said));
    assert.deepEqual(said.filter(([, count]) => count > 1 + seconds / 5), []);
  });

  await check('eight curves can be told apart without colours: each has its own dashes, as its button shows', async (page) => {
    await page.addInitScript(() => {
      const set = CanvasRenderingContext2D.prototype.setLineDash;
      globalThis.dashes = new Set();
      CanvasRenderingContext2D.prototype.setLineDash = function (dashes) {
        globalThis.dashes.add(dashes.map((dash) => dash / devicePixelRatio).join(' '));
        return set.call(this, dashes);
      };
    });
    await page.reload();
    await reads(page, '#state', 'Fine');
    for (const channel of [5, 6, 7, 8]) await page.click(`#bars li:nth-child(${channel}) .chip`);
    const swatches = await page.$$eval('.swatch path', (paths) => paths.slice(0, 8).map((path) => path.getAttribute('stroke-dasharray')));
    assert.equal(new Set(swatches).size, 8);
    await until('the curves have other dashes', () => page.evaluate((all) => all.every((dashes) => globalThis.dashes.has(dashes)), swatches));
  });

  for (const colorScheme of ['light', 'dark']) {
    await check(`forced colours, ${colorScheme}: bars, bits, indicators and buttons can still be told apart`, async (page) => {
      await page.selectOption('#receiver', '32');
      await reads(page, '#state', 'Fine');
      // An indicator is on for a moment only: all colours are of one picture that has both.
      const look = () => page.evaluate(() => {
        const missing = [];
        const of = (selector, what = 'backgroundColor') => {
          const element = document.querySelector(selector) ?? missing.push(selector);
          return element instanceof Element ? getComputedStyle(element)[what] : '';
        };
        const colors = {
          bar: [of('.fill'), of('.track')],
          mark: [of('.mark'), of('.track')],
          silence: [of('.fault-counts .silence', 'stroke'), of('.fault-counts .lost', 'fill')],
          bit: [of('.eight i.one'), of('.eight i:not(.one)')],
          button: [of('#source-simulated'), of('#source-adapter')],
          indicator: [of('.indicator[data-on="true"] i'), of('.indicator[data-on="false"] i')],
          swatch: [of('.chip[aria-pressed="true"] path', 'stroke'), of('.chip[aria-pressed="false"] path', 'stroke')],
          curve: [getComputedStyle(document.documentElement).getPropertyValue('--c0').trim(), of('body')],
        };
        return { colors, missing };
      });
      let colors, missing;
      await until(() => `there is no ${missing}`, async () => ({ colors, missing } = await look()).missing.length === 0);
      for (const [what, [one, other]] of Object.entries(colors)) {
        assert.notEqual(one, other, `${what}: ${JSON.stringify(colors)}`);
      }
      assert.equal(colors.curve[0], 'CanvasText');
      await page.click('#cursors');
      // Each where it belongs.
      const astray = await page.$$eval('button, select, .fill, .mark, .plot, .sign, .indicator i, .eight i, .cursor, .stick-at', (all) => all.filter((each) => each.checkVisibility() && each.closest('li, section, header')).filter((each) => {
        const [inner, outer] = [each, each.closest('li, section, header')].map((one) => one.getBoundingClientRect());
        const slop = 30; // a cursor's handle and a stick's place reach over an edge
        return inner.left < outer.left - slop || inner.top < outer.top - slop || inner.right > outer.right + slop || inner.bottom > outer.bottom + slop;
      }).map((each) => each.outerHTML.slice(0, 80)));
      assert.deepEqual(astray, []);
      await fits(page);
    }, { forcedColors: 'active', colorScheme });
  }

  await check('on a touch screen buttons are 44 px high', async (page) => {
    await reads(page, '#state', 'Fine');
    const small = await page.evaluate(() => [...document.querySelectorAll('button, select')].filter((each) => each.offsetParent && each.offsetHeight < 44).map((each) => each.id || each.textContent));
    assert.deepEqual(small, []);
  }, { size: { width: 820, height: 1180 }, hasTouch: true, isMobile: true });
}
