// Runs in the page, before it: a navigator.serial whose ports the tests play. `fake.port` is the one that is picked.
{
  const real = performance.now.bind(performance);
  let skipped = 0;
  performance.now = () => real() + skipped;

  class FakePort extends EventTarget {
    readable = null;
    opened = []; // the options of each open()
    busy = false;
    gone = false;
    // What comes at a setting: called when the port is opened so.
    onOpen = () => {};

    getInfo() {
      return { usbVendorId: 0x0403, usbProductId: 0x6001 };
    }

    async open(options) {
      if (this.gone) throw new DOMException('The device has been lost.', 'NetworkError');
      if (this.busy) throw new DOMException('Failed to open serial port.', 'NetworkError');
      if (this.readable) throw new DOMException('The port is already open.', 'InvalidStateError');
      this.opened.push(options);
      this.stream();
      this.onOpen(options);
    }

    async close() {
      this.readable = null;
    }

    stream() {
      this.readable = new ReadableStream({ start: (controller) => (this.controller = controller) });
    }

    feed(bytes) {
      this.controller.enqueue(Uint8Array.from(bytes));
    }

    // ParityError and the like: the port stays open, its stream does not.
    fail(name) {
      const { controller } = this;
      this.stream();
      controller.error(new DOMException(name, name));
    }

    unplug() {
      this.gone = true;
      this.readable = null;
      this.controller.error(new DOMException('The device has been lost.', 'NetworkError'));
    }

    plug() {
      this.gone = false;
      serial.dispatchEvent(Object.defineProperty(new Event('connect'), 'target', { value: this }));
    }
  }

  const serial = new EventTarget();
  serial.requestPort = async () => {
    if (!fake.port) throw new DOMException('No port selected by the user.', 'NotFoundError');
    return fake.port;
  };
  globalThis.fake = {
    port: new FakePort(),
    // The clock goes on by so much.
    skip: (ms) => (skipped += ms),
    sent: 0, // bytes, by every()
    // A frame every `ms`, until clearInterval() of what this returns, as an FTDI adapter brings it: every 16 ms what has
    // come since, in packets of 62 (test/support/Adapter.h has the sources).
    every: (ms, bytes) => {
      const start = real();
      let sent = 0;
      return setInterval(() => {
        const frames = Math.floor((real() - start) / ms);
        const into = Math.floor((real() - start - frames * ms) / 0.12);
        const end = frames * bytes.length + Math.min(bytes.length, into);
        while (sent < end) {
          const packet = Array.from({ length: Math.min(62, end - sent) }, (_, i) => bytes[(sent + i) % bytes.length]);
          sent += packet.length;
          if (fake.port.readable) {
            fake.port.feed(packet);
            fake.sent += packet.length;
          }
        }
      }, 16);
    },
  };
  Object.defineProperty(Navigator.prototype, 'serial', { get: () => serial, configurable: true });

  const instantiate = WebAssembly.instantiate;
  WebAssembly.instantiate = async (...parts) => {
    const result = await instantiate(...parts);
    fake.memory = result.instance.exports.memory;
    return result;
  };
}
