// Where a server has sw.js and manifest.webmanifest beside the page, it can be installed, and opens without the server. The page
// is complete without them, and requests nothing if it was opened from disk.

import { make } from './dom';

export async function keepOffline(): Promise<void> {
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
