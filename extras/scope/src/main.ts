// The page: its own failures, its theme, its pictures.

import './style.css';
import { Core } from './core';
import { byId, make, setText } from './dom';
import { scopeOf } from './scope';
import { NoticeView } from './view/notice';

const stays = 'Save the recording, and reload the page.';
let notice: NoticeView | undefined;

// Shows the page's own failures: a blank page says nothing. The line's verdict is drawn over it: so once the page draws, it is a
// notice that stays.
let said = '';
function fault(error: unknown): void {
  const text = `The page has failed: ${error instanceof Error ? error.message : error}.`;
  if (text !== said) {
    notice?.show({ text, remedy: stays }, true);
  }
  said = text;
  byId('verdict').dataset.severity = 'alarm';
  setText(byId('verdict-text'), text);
  setText(byId('verdict-remedy'), 'Reload it in a browser released this year or last year.');
}
addEventListener('error', (event) => event.error && fault(event.error)); // without an error it is an observer's complaint
addEventListener('unhandledrejection', (event) => fault(event.reason));

const core = await Core.load();
const notices = (notice = new NoticeView());
const scope = scopeOf(core, notices, (view, error) => notices.show({ text: `${view} has failed: ${error.message}.`, remedy: `Everything else continues. ${stays}` }, true));

// Follows the system's dark or light theme until the button is pressed.
const dark = matchMedia('(prefers-color-scheme: dark)');
byId('theme').addEventListener('click', () => {
  const now = document.documentElement.dataset.theme ?? (dark.matches ? 'dark' : 'light');
  document.documentElement.dataset.theme = now === 'dark' ? 'light' : 'dark';
  scope.repaint();
});
for (const query of [dark, matchMedia('(forced-colors: active)')]) {
  query.addEventListener('change', () => scope.repaint());
}

void keepOffline();
await scope.begin();

// Where a server has sw.js and manifest.webmanifest beside the page, it can be installed, and opens without the server. The page
// is complete without them, and requests nothing if it was opened from disk.
async function keepOffline(): Promise<void> {
  if (!location.protocol.startsWith('http') || !('serviceWorker' in navigator)) {
    return;
  }
  try {
    await navigator.serviceWorker.register('sw.js', { updateViaCache: 'none' });
    document.head.append(make('link', { rel: 'manifest', href: 'manifest.webmanifest' }));
  } catch {
    // The server has only the page.
  }
}

function picture(): void {
  requestAnimationFrame(picture); // first: a view that throws ends no other picture
  scope.draw();
}
picture();
