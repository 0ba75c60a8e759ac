// A stand-in for Chromium's Web Serial: `fake.port` is the port that is picked. It runs in the page before all scripts, in
// node, and in workers (inWorkers() of support.mjs). It behaves as Chromium's third_party/blink/renderer/modules/serial, commit 08bac9d: serial_port.cc,
// serial_port_underlying_source.cc and serial.cc; each place names the function.
{
  const later = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
  const failure = (method, name, text) => new DOMException(`Failed to execute '${method}' on 'SerialPort': ${text}`, name);

  // SerialPortUnderlyingSource::SignalErrorOnClose()
  const errorTexts = {
    BreakError: 'Break received',
    FramingError: 'Framing error',
    ParityError: 'Parity error',
    BufferOverrunError: 'Buffer overrun',
    UnknownError: 'An unknown system error has occurred.',
    NetworkError: 'The device has been lost.',
  };

  class FakePort extends EventTarget {
    opened = []; // the options of each open() that succeeded
    busy = false; // another program has it open
    gone = false;
    permitted = false; // by the user, in the chooser
    ephemeral = false; // it has no serial number: the permission ends when it is unplugged
    openMs = 60; // an FTDI adapter's open() took 60 to 1300 ms; 0: it opens at once
    closeMs = 5;
    ids = { usbVendorId: 0x0403, usbProductId: 0x6001 };
    // What comes with a setting: called when the port is opened with it.
    onOpen = () => {};

    #bound = false;
    #opening = false;
    #closing = false;
    #fatal = false;
    #stream = null;
    #controller;
    #size = 255; // of the pipe, in bytes
    #waiting = []; // packets, then perhaps the name of an error
    #wanted; // resolves a pull()
    #closed; // resolves a close()

    getInfo() {
      return this.ids;
    }

    // SerialPort::open(), OnOpen(): the same text for a device that has gone, is busy, or is not permitted.
    async open(options) {
      if (this.#opening) throw failure('open', 'InvalidStateError', 'A call to open() is already in progress.');
      if (this.#bound) throw failure('open', 'InvalidStateError', 'The port is already open.');
      this.#opening = true;
      await later(this.openMs);
      this.#opening = false;
      if (this.gone || this.busy) throw failure('open', 'NetworkError', 'Failed to open serial port.');
      this.#bound = true;
      this.#waiting = [];
      this.#size = options.bufferSize ?? 255;
      this.opened.push(options);
      this.onOpen(options);
    }

    // SerialPort::readable(): made when it is read; none while the port opens or closes, nor once the device is lost.
    get readable() {
      if (!this.#stream && this.#bound && !this.#closing && !this.#fatal) {
        this.#stream = new ReadableStream({
          type: 'bytes',
          start: (controller) => (this.#controller = controller),
          pull: () => this.#pull(),
          cancel: () => this.#cancel(),
        });
      }
      return this.#stream;
    }

    // SerialPort::close(): a stream that has a reader cannot be cancelled.
    async close() {
      if (!this.#bound) throw failure('close', 'InvalidStateError', 'The port is already closed.');
      if (this.#closing) throw failure('close', 'InvalidStateError', 'A call to close() is already in progress.');
      if (this.#stream?.locked) throw new TypeError("Failed to execute 'close' on 'SerialPort': Cannot cancel a locked stream");
      this.#closing = true;
      if (this.#stream) {
        const streamClosed = new Promise((resolve) => (this.#closed = resolve));
        this.#stream.cancel();
        await streamClosed;
      }
      await later(this.closeMs);
      this.#closing = false;
      this.#bound = false;
      this.#fatal = false;
    }

    get isOpen() {
      return this.#bound || this.#opening;
    }

    get isLocked() {
      return this.#stream?.locked ?? false;
    }

    // Returns true once all that was fed has been read, or cannot be read any more.
    get isEmpty() {
      return this.#waiting.length === 0;
    }

    // Bytes wait in the pipe to the page and in the system's buffer (Linux's n_tty: 4095 bytes); what finds no
    // room is lost. Returns false if the port is closed.
    feed(bytes) {
      if (this.#bound && this.#room >= bytes.length) this.#come(Uint8Array.from(bytes));
      return this.#bound;
    }

    get #room() {
      return this.#size + 4095 - this.#waiting.reduce((sum, part) => sum + (typeof part === 'string' ? 0 : part.length), 0);
    }

    // SerialPort::OnReadError(): what came before is read first. Then the stream breaks and `readable` is a new one; a lost
    // device has none.
    fail(name) {
      this.#fatal ||= name === 'NetworkError';
      if (this.#stream) this.#come(name);
    }

    // A read finds that the device has gone, and the port is still to be closed (`bound`); or the browser's service finds it first,
    // SerialPort::OnConnectionError(), and the port is closed. Then Serial::OnPortConnectedStateChanged().
    unplug({ bound = true } = {}) {
      this.gone = true;
      if (this.#bound) {
        this.#bound = bound;
        this.fail('NetworkError');
        this.#fatal = bound;
      }
      tell('disconnect', this);
    }

    // A device that is plugged in again is another SerialPort: Serial::GetOrCreatePort() knows it by a new token. The permission of
    // one with a serial number stays: SerialChooserContext::GrantPortPermission() in chrome/browser/serial.
    plug() {
      const port = Object.assign(new FakePort(), { ids: this.ids, opened: this.opened, onOpen: this.onOpen, openMs: this.openMs, permitted: this.permitted && !this.ephemeral });
      if (fake.port === this) fake.port = port;
      ports.push(port);
      tell('connect', port);
      return port;
    }

    #come(packetOrError) {
      this.#waiting.push(packetOrError);
      queueMicrotask(() => this.#deliver());
    }

    #pull() {
      return new Promise((resolve) => {
        this.#wanted = resolve;
        this.#deliver();
      });
    }

    // SerialPortUnderlyingSource::ReadDataOrArmWatcher(), PipeClosed(): one chunk has all that is in the pipe, so after a thread was
    // busy a single read brings what came meanwhile.
    #deliver() {
      if (!this.#wanted || this.#waiting.length === 0) return;
      let next = this.#waiting.shift();
      while (typeof next !== 'string' && next.length < this.#size && this.#waiting.length > 0 && typeof this.#waiting[0] !== 'string') {
        next = Uint8Array.from([...next, ...this.#waiting.shift()]);
      }
      const wanted = this.#wanted;
      this.#wanted = undefined;
      if (typeof next === 'string') {
        this.#stream = null;
        this.#controller.error(new DOMException(errorTexts[next], next));
      } else {
        this.#controller.enqueue(next);
      }
      wanted();
    }

    // SerialPortUnderlyingSource::Cancel(): what waits is dropped, which takes a moment. Until then `readable` is the old one.
    async #cancel() {
      this.#wanted?.();
      this.#wanted = undefined;
      this.#waiting = [];
      if (!this.#closing) await later(this.closeMs);
      this.#stream = null;
      this.#closed?.();
    }
  }

  const ports = []; // all ports

  // SerialPort::DispatchEventInternal(): the event bubbles to navigator.serial. A page gets no events of a port without permission:
  // SerialService::OnPortConnectedStateChanged() in content/browser/serial/serial_service.cc.
  const tell = (name, port) => {
    if (!port.permitted) return;
    const event = Object.defineProperty(new Event(name), 'target', { value: port });
    port.dispatchEvent(new Event(name));
    serial.dispatchEvent(event);
  };

  const serial = new EventTarget();
  let cancel; // cancels the open chooser
  const notSelected = () => new DOMException("Failed to execute 'requestPort' on 'Serial': No port selected by the user.", 'NotFoundError');
  // Serial::requestPort(). A second chooser takes the place of the first, whose caller gets no port: SerialService::RequestPort() in
  // content/browser/serial/serial_service.cc, ~SerialChooserController().
  serial.requestPort = async () => {
    if (globalThis.navigator?.userActivation?.isActive === false) {
      throw new DOMException("Failed to execute 'requestPort' on 'Serial': Must be handling a user gesture to show a permission request.", 'SecurityError');
    }
    cancel?.();
    return new Promise((resolve, reject) => {
      cancel = () => reject(notSelected());
      Promise.resolve(fake.choose()).then((port) => (port ? resolve(Object.assign(port, { permitted: true })) : reject(notSelected())));
    });
  };
  // Serial::getPorts(), without any gesture: those that are plugged in and permitted, SerialService::FinishGetPorts(); each is the
  // SerialPort that it was before, Serial::OnGetPorts().
  serial.getPorts = async () => {
    await later(5);
    return ports.filter(({ permitted, gone }) => permitted && !gone);
  };
  const newPort = () => {
    ports.push(new FakePort());
    return ports.at(-1);
  };
  globalThis.fake = {
    port: newPort(),
    newPort,
    serial,
    // What the user picks in the chooser; undefined: nothing.
    choose: () => fake.port,
    sent: 0, // bytes, by every()
    // Feeds a frame every `ms`, until clearInterval() of what it returns, as an adapter does: what has come, every 16 ms (an
    // FTDI's latency timer; 1 ms if it is set to that), in packets of 62 (test/support/Adapter.h has the sources).
    every: (ms, bytes, latencyMs = 16) => {
      const { port } = fake;
      const start = performance.now();
      let sent = 0;
      return setInterval(() => {
        const frames = Math.floor((performance.now() - start) / ms);
        const into = Math.floor((performance.now() - start - frames * ms) / 0.12);
        const end = frames * bytes.length + Math.min(bytes.length, into);
        while (sent < end) {
          const packet = Array.from({ length: Math.min(62, end - sent) }, (_, i) => bytes[(sent + i) % bytes.length]);
          sent += packet.length;
          fake.sent += port.feed(packet) ? packet.length : 0;
        }
      }, latencyMs);
    },
  };
  // Chromium's serial.idl: [Exposed=(DedicatedWorker, Window)].
  const { prototype } = globalThis.Navigator ?? globalThis.WorkerNavigator ?? {};
  if (prototype) {
    Object.defineProperty(prototype, 'serial', { get: () => serial, configurable: true });
  }
}
