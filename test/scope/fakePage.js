// Runs in the page, before it: a clock that tests put on, the memory of the WebAssembly, and what that says of its layout.
{
  const real = performance.now.bind(performance);
  let skipped = 0;
  performance.now = () => real() + skipped;
  // The clock goes on by so much.
  fake.skip = (ms) => (skipped += ms);
  fake.realNow = real;

  // The layout reads as `fake.layout` makes of it, in as many letters.
  const disguise = (at, { buffer }) => {
    const bytes = new Uint8Array(buffer, at);
    const text = new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
    new TextEncoder().encodeInto(fake.layout?.(text) ?? text, bytes);
    return at;
  };

  // A worker tells the memory of its WebAssemblies: `memories` in it.
  const prelude = `{
    const Real = WebAssembly.Instance;
    globalThis.memories = [];
    WebAssembly.Instance = function (...parts) {
      const made = new Real(...parts);
      memories.push(new WeakRef(made.exports.memory));
      return made;
    };
  }\n`;
  const RealBlob = Blob;
  globalThis.Blob = class extends RealBlob {
    constructor(parts, options) {
      super(options?.type?.startsWith('text/javascript') ? [prelude, ...parts] : parts, options);
    }
  };

  const instantiate = WebAssembly.instantiate;
  WebAssembly.instantiate = async (...parts) => {
    const { exports } = (await instantiate(...parts)).instance;
    fake.memory = exports.memory;
    return { instance: { exports: { ...exports, layout: () => disguise(exports.layout(), exports.memory) } } };
  };
}
