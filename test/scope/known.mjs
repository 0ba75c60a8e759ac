// Ports that were allowed before.
import assert from 'node:assert/strict';
import { check, connect, frame, lit, raw, reads, until } from './support.mjs';

const known = (page) => page.$$eval('#known button', (buttons) => buttons.map((button) => `${button.textContent}, ${button.title}, ${button.getAttribute('aria-pressed')}`));
const shows = (page, ...expected) => until(async () => `${JSON.stringify(await known(page))}`, async () => JSON.stringify(await known(page)) === JSON.stringify(expected));
// The next page is opened while these devices, which it may use, are plugged in; others are not permitted.
const plugged = (page, ...ports) => page.addInitScript((all) => {
  for (const ids of all) Object.assign(fake.newPort(), { ids, permitted: true });
}, ports);
const uno = { usbVendorId: 0x2341, usbProductId: 0x43 };

export default async function () {
  await check('a port that was allowed before opens with one click, without a dialog; vendor and product are shown', async (page) => {
    await shows(page);
    await page.evaluate((bytes) => {
      const port = Object.assign(fake.newPort(), { permitted: true, gone: true }).plug();
      port.onOpen = () => port.feed(bytes);
      fake.choose = () => fake.newPort(); // with other bytes: none
    }, [1, 2, 3].flatMap(() => frame([1234], { flags: 1 })));
    await shows(page, 'FTDI FT232 (0403:6001), Reopen it as an adapter, false');
    await page.click('#known button');
    await raw(page, 1, '1234');
    await lit(page, 'ch17');
    await shows(page, 'FTDI FT232 (0403:6001), Reopen it as an adapter, true');
    await reads(page, '#title', 'Serial adapter, 100000 baud, 8E2, FTDI FT232 (0403:6001)');
    assert.equal(await page.getAttribute('#source-adapter', 'aria-pressed'), 'true');
    await page.click('#source-simulated');
    await shows(page, 'FTDI FT232 (0403:6001), Reopen it as an adapter, false');
  });

  await check('a port opens again as the board or adapter that it was, a board with its baud rate, whatever its vendor; a new port is guessed', async (page) => {
    await connect(page, 'board');
    await page.selectOption('#baud', '57600');
    await shows(page, 'FTDI FT232 (0403:6001), Reopen it as a board, true');
    await plugged(page, { usbVendorId: 0x0403, usbProductId: 0x6001 }, uno, { usbVendorId: 0x0403, usbProductId: 0x6015 }, { usbVendorId: 0x1234, usbProductId: 0xabc }, {});
    await page.reload();
    await shows(page, 'FTDI FT232 (0403:6001), Reopen it as a board, false', 'Arduino Uno (2341:0043), Reopen it as a board, false',
      'FTDI FT231X (0403:6015), Reopen it as an adapter, false', 'USB 1234:0abc, Reopen it as a board, false', 'serial port, Reopen it as a board, false');
    await page.click('#known button');
    await reads(page, '#title', 'A board that prints numbers, 57600 baud, FTDI FT232 (0403:6001)');
  });

  await check('a port has a button while it is plugged in; a port without permission has none', async (page) => {
    await page.evaluate(() => fake.newPort().plug());
    await connect(page);
    await shows(page, 'FTDI FT232 (0403:6001), Reopen it as an adapter, true');
    await page.evaluate(() => fake.port.unplug());
    await shows(page);
    await page.evaluate(() => fake.port.plug());
    await shows(page, 'FTDI FT232 (0403:6001), Reopen it as an adapter, true');
  });

  await check('if the browser rejects getPorts(), as in a page of opaque origin, there are no buttons and no error', async (page) => {
    await page.addInitScript(() => (navigator.serial.getPorts = () => Promise.reject(new DOMException('opaque origin', 'SecurityError'))));
    await page.reload();
    await reads(page, '#state', 'Fine');
    await shows(page);
    await reads(page, '#verdict-text', 'Simulation.');
  });

  for (const button of ['#source-adapter', '#known button']) {
    await check(`a port that fails to open, by ${button}, leaves the running source and says why`, async (page) => {
      await page.evaluate(() => Object.assign(fake.newPort(), { permitted: true, gone: true }).plug());
      await reads(page, '#state', 'Fine');
      await page.evaluate(() => (WebAssembly.instantiate = () => Promise.reject(new Error('out of memory'))));
      await page.click(button);
      await reads(page, '#notice', /The port cannot be read: out of memory\. Reload the page, and choose the port again\./);
      await reads(page, '#state', 'Fine');
    });
  }
}
