// Keeps the screen on, and by that the PC awake, while it is wanted. A browser takes the lock away from a page that is hidden, and may
// reject it (a low battery, no such feature): then the PC sleeps when it does.

export class Awake {
  private wanted = false;
  private lock?: WakeLockSentinel;
  private turn = Promise.resolve(); // one question after the other

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
