// The curves as an SVG file.
import assert from 'node:assert/strict';
import { check, connect, counts, downloaded, drawn, frame, opensWith, playRamp, ramp, reads, until } from './support.mjs';

// Returns what a browser reads in the file.
const parsed = (page, text) => page.evaluate((svg) => {
  const picture = new DOMParser().parseFromString(svg, 'image/svg+xml');
  return {
    error: picture.querySelector('parsererror')?.textContent,
    texts: [...picture.querySelectorAll('text')].map((each) => each.textContent),
    curves: [...picture.querySelectorAll('path')].map((path) => ({
      name: path.textContent, color: path.getAttribute('stroke'), dash: path.getAttribute('stroke-dasharray'), line: path.getAttribute('d'),
    })),
    bands: [...picture.querySelectorAll('g rect')].map((each) => [each.getAttribute('fill'), Number(each.getAttribute('fill-opacity'))].join()),
    background: picture.querySelector('rect').getAttribute('fill'),
  };
}, text);

export default async function () {
  await check('an SVG has the curves as they are shown, with title, axes, names, colours and dashes, and each value in its place', async (page) => {
    await page.click('#names-open');
    await page.keyboard.type('<A & "B">');
    await page.keyboard.press('Enter');
    await page.click('#bars li:nth-child(3) .chip');
    await playRamp(page);
    await page.click('#zoom-in');
    await reads(page, '#window', '5 s');
    await drawn(page);
    const { name, text } = await downloaded(page, '#picture');
    assert.match(name, /^sbus-\d{8}-\d{6}\.svg$/);
    const { error, texts, curves, bands, background } = await parsed(page, text);
    assert.equal(error, undefined);
    assert.deepEqual(texts.filter((each) => !/ s$/.test(each)), ['Recording ramp.txt', '0', '172', '992', '1811', '2047', '<A & "B">', 'CH2', 'CH4']);
    const [shown, ...ticks] = texts.filter((each) => / s$/.test(each));
    assert.match(shown, /^5 s up to 4\.00[34] s$/); // the last byte came at 4.003 s, the end is a moment later
    assert.deepEqual(ticks, ['0 s', '0.5 s', '1 s', '1.5 s', '2 s', '2.5 s', '3 s', '3.5 s', '4 s']);
    assert.deepEqual(curves.map((curve) => [curve.name, curve.dash]), [['<A & "B">', 'none'], ['CH2', '9 3'], ['CH4', '9 3 2 3']]);
    assert.equal(new Set(curves.map(({ color }) => color)).size, 3);
    assert.deepEqual(bands, []);
    assert.equal(background, await page.evaluate(() => getComputedStyle(document.querySelector('.card')).backgroundColor));
    // Pixels to values and back: the plot is 1110 px wide and 420 high.
    const points = curves[0].line.match(/[\d.]+ [\d.]+/g).map((point) => point.split(' ').map(Number));
    assert.ok(points.length > 50);
    for (const [x, y] of points) {
      const time = ramp.lengthS + ((x - 70) / 1110 - 1) * 5;
      const value = 2047 * (1 - (y - 64) / 420);
      const frame = Math.round((time - ramp.timeS(0)) / 0.01);
      assert.ok(Math.abs(value - ramp.channels(frame)[0]) < 4, `${x} ${y}: ${value} at ${time} s`);
    }
  });

  await check('an SVG shows failsafe and lost frames as bands; in the dark it is dark', async (page) => {
    const flagged = (flags) => [1, 2, 3].map(() => frame([992], { flags }));
    await opensWith(page, [...flagged(0), ...flagged(4), ...flagged(12), ...flagged(0)]);
    await connect(page);
    await counts(page, 'frames', 12);
    let picture = {};
    await until('two bands', async () => {  // the curves come with a message of their own
      picture = await parsed(page, (await downloaded(page, '#picture')).text);
      return picture.bands.length === 2;
    });
    const { bands, background, texts } = picture;
    assert.match(texts[0], /^S\.Bus on a serial adapter/);
    assert.notEqual(bands[0], bands[1]);
    for (const band of bands) assert.match(band, /^rgb\(\d+, \d+, \d+\),0\.[12]\d*$/);
    assert.equal(background, 'rgb(23, 30, 38)');
  }, { colorScheme: 'dark' });
}
