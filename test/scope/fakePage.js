// Runs in the page before its scripts: a clock that tests can set, drawing as on a slow PC, and the memory of the WebAssembly.
{
  const real = performance.now.bind(performance);
  let skipped = 0;
  performance.now = () => real() + skipped;
  // Moves the clock on.
  fake.skip = (ms) => (skipped += ms);
  fake.realNow = real;

  // Draws about fifteen of sixty pictures a second: each costs 8 ms of the PC's time. `fake.restMs = 0` draws all of them.
  const picture = requestAnimationFrame;
  fake.restMs = 50;
  globalThis.requestAnimationFrame = (draw) => (fake.restMs > 0 ? setTimeout(() => picture(draw), fake.restMs) : picture(draw));

  // A worker has the memories of its WebAssembly instances in `memories`, and what `fakeOfWorkers` has.
  const prelude = () => `${globalThis.fakeOfWorkers ?? ''}{
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
      super(options?.type?.startsWith('text/javascript') ? [prelude(), ...parts] : parts, options);
    }
  };

  const instantiate = WebAssembly.instantiate;
  WebAssembly.instantiate = async (...parts) => {
    const made = await instantiate(...parts);
    fake.memory = made.instance.exports.memory;
    return made;
  };
}
