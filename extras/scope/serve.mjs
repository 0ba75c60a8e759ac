// Serves the page on this computer alone:   node serve.mjs FILE [PORT]
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';

const [file, port] = process.argv.slice(2);

const server = createServer(async (request, response) => {
  if (request.url !== '/') {
    response.writeHead(404).end();
    return;
  }
  response.writeHead(200, { 'Content-Type': 'text/html; charset=utf-8', 'Cache-Control': 'no-store' });
  response.end(await readFile(file));
});
server.on('error', (error) => {
  console.error(error.code === 'EADDRINUSE' ? `Port ${port} is in use: choose another, as in make scope SCOPE_PORT=8001` : error.message);
  process.exit(1);
});
server.listen(Number(port), '127.0.0.1', () => {
  console.log(`${file} opens in a browser as it is, and here: http://localhost:${server.address().port}/   (Ctrl-C ends it)`);
});
