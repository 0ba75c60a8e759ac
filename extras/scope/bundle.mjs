// Builds dist/index.html: script, worker, style and WebAssembly stand in it, and it asks for nothing else. It may run only the
// script that it was built with.
import { createHash } from 'node:crypto';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { build } from 'esbuild-wasm';

const bundle = async (entry, define = {}) => {
  const { outputFiles } = await build({
    entryPoints: [entry], bundle: true, minify: true, write: false, outdir: 'dist', format: 'esm', target: 'es2022', charset: 'utf8',
    legalComments: 'eof', loader: { '.gz': 'binary' }, define,
  });
  return Object.fromEntries(outputFiles.map(({ path, text }) => [path.slice(path.lastIndexOf('.') + 1), text.trim()]));
};

const worker = await bundle('src/worker/worker.ts');
const { js, css } = await bundle('src/main.ts', { WORKER: JSON.stringify(worker.js) });
const script = js.replaceAll('</script', '<\\/script');
const sha256 = createHash('sha256').update(script).digest('base64');
const policy =
  `default-src 'none'; script-src 'sha256-${sha256}' 'wasm-unsafe-eval'; style-src 'unsafe-inline'; img-src data:; ` +
  `worker-src blob: 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'`;
// esbuild keeps comments that say `@license`; uPlot's does not. What is compiled to WebAssembly has no comments.
const licences = `${readFileSync('LICENSE', 'utf8')}
Parts of this page, under the same licence:
  uPlot, ${readFileSync('node_modules/uplot/LICENSE', 'utf8').match(/^Copyright.*$/m)[0]}
  JSON for Modern C++, Copyright (c) 2013-2022 Niels Lohmann
  musl, Copyright (c) 2005-2020 Rich Felker, et al.
`;
const page = readFileSync('index.html', 'utf8')
  .replace('<!-- policy -->', () => `<meta http-equiv="Content-Security-Policy" content="${policy}">`)
  .replace('<html', () => `<!--\n${licences}-->\n<html`)
  .replace('</head>', () => `<style>${css}</style>\n</head>`)
  .replace(/<script[^>]*src=.*<\/script>/, () => `<script type="module">${script}</script>`);
mkdirSync('dist', { recursive: true });
writeFileSync('dist/index.html', page);
