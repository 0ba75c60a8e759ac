// The border to WebAssembly: a page whose structs, enumerations or constants differ from its WebAssembly's does not start.
import { check, connect, counts, frame, opensWith, reads } from './support.mjs';

export default async function () {
  for (const [edit, to, said] of [
    [' byte 36', ' byte 35', 'the fields of Record differ: bytes is byte 36 in the page and byte 35 in WebAssembly'],
    ['field Record why ', 'field Record who ', 'the fields of Record differ: why is letter 88 in the page and undefined in WebAssembly'],
    ['field Status resyncs ', 'field Status resynks ', 'the fields of Status differ: resyncs is double 1 in the page and undefined in WebAssembly'],
    ['value LinkState Stale 4', 'value LinkState Stale 5', 'the values of LinkState differ: Stale is 4 in the page and 5 in WebAssembly'],
    ['value Kind Row 4', 'value Mind Row 4', 'the values of Kind differ: Row is 4 in the page and undefined in WebAssembly'],
    ['value Flag Failsafe 8', 'value Flag Failsafe 4', 'the values of Flag differ: Failsafe is 8 in the page and 4 in WebAssembly'],
    ['value Finding Noise 8', 'value Finding Voice 8', 'the values of Finding differ: Noise is 8 in the page and undefined in WebAssembly'],
    ['value CalibrationError NotHeld 9', 'value CalibrationError NotHeld 8', 'the values of CalibrationError differ: NotHeld is 9 in the page and 8 in WebAssembly'],
    ['value Scale Futaba 1', 'value Scale Futaba 2', 'the values of Scale differ: Futaba is 1 in the page and 2 in WebAssembly'],
    ['constant Enough ', 'constant Mostly ', 'WebAssembly has no Enough'],
  ]) {
    await check(`the page rejects a WebAssembly that says "${to}"`, async (page) => {
      await page.addInitScript(([from, other]) => (fake.layout = (text) => text.replace(from, other)), [edit, to]);
      await page.reload();
      await reads(page, '#verdict-text', `The page has failed: ${said}.`);
      page.complaints.length = 0; // that was one
    });
  }

  await check('fields are read where WebAssembly has them', async (page) => {
    await page.addInitScript(() => (fake.layout = (text) => text.replace(/(Status frames )(\d+)(.*?)(Status lostFrames )(\d+)/s, '$1$5$3$4$2')));
    await page.reload();
    await opensWith(page, [frame([1000]), frame([1000])]);
    await connect(page);
    await counts(page, 'lostFrames', 2); // frames
    await counts(page, 'frames', 0);
  });
}
