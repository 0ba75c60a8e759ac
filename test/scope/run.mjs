// The tests of extras/scope's page, in Debian's Chromium. What is read is the page: numbers, indicators, words, downloads.
//   node run.mjs [PART...]   some of the parts below; else all
import { finish } from './support.mjs';

const parts = process.argv.length > 2 ? process.argv.slice(2) : ['start', 'verdicts', 'watch', 'looks', 'panes', 'ports', 'late', 'held', 'known', 'recordings', 'seek', 'strip', 'report', 'telemetry', 'captures', 'wire', 'keep', 'curves', 'trigger', 'cursors', 'gestures', 'losses', 'sticks', 'names', 'calibration', 'offline', 'hour'];
for (const part of parts) {
  await (await import(`./${part}.mjs`)).default();
}
await finish();
