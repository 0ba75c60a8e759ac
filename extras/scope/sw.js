// Keeps the page for when its server is away. While the server answers, its page is shown: a new build is seen at once.

const kept = 'sbus-scope';
const page = new URL('./', location.href).href;
const manifest = new URL('manifest.webmanifest', location.href).href;
const nameOf = (url) => (url === `${page}index.html` ? page : url);

addEventListener('install', (event) => event.waitUntil(caches.open(kept).then((cache) => cache.addAll([page, manifest]))));

addEventListener('fetch', (event) => {
  const url = nameOf(event.request.url.replace(/[?#].*/, ''));
  if (event.request.method === 'GET' && (url === page || url === manifest)) {
    event.respondWith(answer(event.request, url));
  }
});

async function answer(request, url) {
  const cache = await caches.open(kept);
  try {
    const response = await fetch(request);
    if (response.ok && !response.redirected) {
      await cache.put(url, response.clone());
    }
    return response;
  } catch (error) {
    return (await cache.match(url)) ?? Promise.reject(error);
  }
}
