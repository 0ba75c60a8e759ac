// One HTML file: script, style and WebAssembly stand in it, and it asks for nothing else. It may run only the script that it
// was built with.
import { createHash } from 'node:crypto';
import { defineConfig } from 'vite';

const sha256 = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;

const oneFile = {
  name: 'one-file',
  enforce: 'post',
  generateBundle(_, bundle) {
    const all = Object.values(bundle);
    const page = bundle['index.html'];
    const style = all.filter((part) => part.fileName.endsWith('.css')).map((part) => part.source).join('');
    const script = all.filter((part) => part.type === 'chunk').map((part) => part.code).join('').replaceAll('</script', '<\\/script');
    const policy =
      `default-src 'none'; script-src ${sha256(script)} 'wasm-unsafe-eval'; style-src 'unsafe-inline'; img-src data:; ` +
      `worker-src blob: 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'`;
    page.source = page.source
      .replace(/<script[^>]*src=[^>]*><\/script>/g, '')
      .replace(/<link rel="stylesheet"[^>]*>/g, '')
      .replace('<!-- policy -->', () => `<meta http-equiv="Content-Security-Policy" content="${policy}">`)
      .replace('</head>', () => `<style>${style}</style>\n</head>`)
      .replace('</body>', () => `<script type="module">${script}</script>\n</body>`);
    for (const part of all) {
      if (part !== page) delete bundle[part.fileName];
    }
  },
};

export default defineConfig({
  base: './',
  assetsInclude: ['**/*.wasm.gz'],
  plugins: [oneFile],
  build: {
    modulePreload: false,
    cssCodeSplit: false,
    assetsInlineLimit: 1 << 24,
    target: 'es2022',
    chunkSizeWarningLimit: 2000,
    reportCompressedSize: false,
  },
  logLevel: 'warn',
});
