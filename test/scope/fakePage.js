// Runs in the page, before it: a clock that tests put on, the memory of the WebAssembly, and a screen that may sleep.
{
  const real = performance.now.bind(performance);
  let skipped = 0;
  performance.now = () => real() + skipped;
  // The clock goes on by so much.
  fake.skip = (ms) => (skipped += ms);
  fake.realNow = real;

  const instantiate = WebAssembly.instantiate;
  WebAssembly.instantiate = async (...parts) => {
    const result = await instantiate(...parts);
    fake.memory = result.instance.exports.memory;
    return result;
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
  // WakeLock::request(), DidReceivePermissionResponse(): a page that is hidden gets none, also one that has been hidden since it asked.
  const request = async () => {
    if (document.visibilityState === 'hidden') throw notVisible();
    await new Promise((resolve) => setTimeout(resolve, 20));
    if (document.visibilityState === 'hidden') throw notVisible();
    fake.locks.push(new Sentinel());
    return fake.locks.at(-1);
  };
  Object.defineProperty(Navigator.prototype, 'wakeLock', { get: () => ({ request }), configurable: true });
  // Hides the page, or shows it. WakeLock::PageVisibilityChanged() takes the locks before the page hears of it.
  fake.show = (visible) => {
    Object.defineProperty(document, 'visibilityState', { get: () => (visible ? 'visible' : 'hidden'), configurable: true });
    if (!visible) fake.locks.forEach((lock) => lock.release());
    document.dispatchEvent(new Event('visibilitychange'));
  };
}
