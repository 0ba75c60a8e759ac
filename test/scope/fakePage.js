// Runs in the page before its scripts: a clock that tests can set, drawing as on a slow PC, the memory of the
// WebAssembly, and a screen that may sleep.
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

  // As in Chromium's third_party/blink/renderer/modules/wake_lock, commit 047c7dc.
  const notVisible = () => new DOMException('The requesting page is not visible', 'NotAllowedError');
  class Sentinel extends EventTarget {
    released = false;
    // WakeLockSentinel::DoRelease(): once.
    async release() {
      if (this.released) return;
      this.released = true;
      this.dispatchEvent(new Event('release'));
    }
  }
  fake.locks = [];
  // WakeLock::request(), DidReceivePermissionResponse(): a hidden page gets none, also if it was hidden after its request.
  const request = async () => {
    if (document.visibilityState === 'hidden') throw notVisible();
    await new Promise((resolve) => setTimeout(resolve, 20));
    if (document.visibilityState === 'hidden') throw notVisible();
    fake.locks.push(new Sentinel());
    return fake.locks.at(-1);
  };
  Object.defineProperty(Navigator.prototype, 'wakeLock', { get: () => ({ request }), configurable: true });
  // Hides the page, or shows it. WakeLock::PageVisibilityChanged() releases the locks before the page gets the event.
  fake.show = (visible) => {
    Object.defineProperty(document, 'visibilityState', { get: () => (visible ? 'visible' : 'hidden'), configurable: true });
    if (!visible) fake.locks.forEach((lock) => lock.release());
    document.dispatchEvent(new Event('visibilitychange'));
  };
}
