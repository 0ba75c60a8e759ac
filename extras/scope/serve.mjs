// Serves the page on this computer alone, with what makes it installable:   node serve.mjs FILE [PORT]
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import path from 'node:path';

const [file, port] = process.argv.slice(2);
const beside = (name) => path.join(path.dirname(file), name);
const page = [file, 'text/html; charset=utf-8'];
const served = {
  '/': page,
  '/index.html': page,
  '/sw.js': [beside('sw.js'), 'text/javascript; charset=utf-8'],
  '/manifest.webmanifest': [beside('manifest.webmanifest'), 'application/manifest+json'],
};

const server = createServer(async (request, response) => {
  try {
    const [name, type] = served[request.url.split('?')[0]];
    const content = await readFile(name);
    response.writeHead(200, { 'Content-Type': type, 'Cache-Control': 'no-store' }).end(content);
  } catch {
    response.writeHead(404).end();
  }
});
server.on('error', (error) => {
  console.error(error.code === 'EADDRINUSE' ? `Port ${port} is in use: choose another, as in make scope SCOPE_PORT=8001` : error.message);
  process.exit(1);
});
server.listen(Number(port), '127.0.0.1', () => {
  console.log(`${file} opens in a browser as it is, and here: http://localhost:${server.address().port}/   (Ctrl-C ends it)`);
});
