// Keeps the screen on, and thereby the PC awake, while that is wanted. A browser releases the lock of a hidden page, and may
// reject it (low battery, no such feature): then the PC goes to sleep as usual.

export class Awake {
  private wanted = false;
  private lock?: WakeLockSentinel;
  private turn = Promise.resolve(); // one request after the other

  constructor() {
    document.addEventListener('visibilitychange', () => this.settle());
  }

  want(on: boolean): void {
    this.wanted = on;
    this.settle();
  }

  private settle(): void {
    this.turn = this.turn.then(() => this.ask()).catch(() => undefined);
  }

  private async ask(): Promise<void> {
    if (!this.wanted) {
      await this.lock?.release();
    } else if (document.visibilityState === 'visible' && this.lock?.released !== false) {
      this.lock = await navigator.wakeLock?.request('screen');
    }
  }
}
