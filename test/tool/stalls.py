"""Runs `sbus` between two pseudo-terminals, stops or kills a part of it, and says what came out.

  stalls.py SBUS CASE     prints the figures; exit status 0 if they are right

A receiver writes a numbered frame every 9 ms, and discards it where no program takes its bytes, like a UART. A device
reads, and notes when. Tests wait for frames, not for times: only the age of a frame is a time.
"""
import json
import os
import select
import signal
import subprocess
import sys
import threading
import time

from ports import Port, frame

OLD = 0.4  # s: 0.1 s, and what a busy PC adds before the device has read
FLY = "import sys\nfor line in sys.stdin:\n    sys.stdout.write(line)\n    sys.stdout.flush()\n"
OWN = """import json, sys
for line in sys.stdin:
    o = json.loads(line)
    if o["type"] == "frame":
        print(json.dumps({"type": "frame", "channels": o["channels"], "lost_frame": o["lost_frame"], "failsafe": o["failsafe"]}), flush=True)
"""


def numbered(number):
    return frame(number & 2047, number >> 11)


def number_of(frame):
    bits = int.from_bytes(frame[1:23], "little")
    return bits & 2047 | (bits >> 11 & 2047) << 11


class Receiver(threading.Thread):
    def __init__(self, at_once=1):
        super().__init__(daemon=True)
        self.port = Port()
        os.set_blocking(self.port.file, False)
        self.at_once = at_once
        self.times = []
        self.silent = False
        self.is_silent = threading.Event()

    def run(self):
        due = time.monotonic()
        while True:
            due = max(due + 0.009 * self.at_once, time.monotonic())
            time.sleep(max(0, due - time.monotonic()))
            if self.silent:
                self.is_silent.set()
                continue
            now = time.monotonic()
            count = len(self.times)
            self.times += [now] * self.at_once
            try:
                self.port.write( b"".join(numbered(count + i) for i in range(self.at_once)))
            except BlockingIOError:
                pass


class Device(threading.Thread):
    """Reads `size` bytes every `period` seconds, or whatever comes."""

    def __init__(self, size=4096, period=0):
        super().__init__(daemon=True)
        self.port = Port()
        self.size, self.period = size, period
        self.paused = threading.Event()
        self.gone = threading.Event()
        self.came = b""
        self.frames = []  # time, number, flags
        self.cut = 0
        self.on_frame = None

    def run(self):
        while not self.gone.is_set():
            if self.period:
                time.sleep(self.period)
            if not select.select([self.port.file], [], [], 0.02)[0] or self.paused.is_set():
                time.sleep(0.001 if self.paused.is_set() else 0)
                continue
            self.came += os.read(self.port.file, self.size)
            now = time.monotonic()
            while len(self.came) >= 25:
                if self.came[0] != 15 or self.came[24] != 0 or self.came[23] & ~12:
                    self.came = self.came[1:]
                    self.cut += 1
                    continue
                one, self.came = self.came[:25], self.came[25:]
                self.frames.append((now, number_of(one), one[23]))
                if self.on_frame:
                    self.on_frame()


def until(what, condition, seconds=float(os.environ.get("PATIENCE", "60"))):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise SystemExit("waited in vain for " + what)
        time.sleep(0.002)


class Chain:
    """Programs that pass a line on, from the receiver to the device."""

    def __init__(self, stages, receiver=None, device=None):
        self.receiver = receiver or Receiver()
        self.device = device or Device()
        self.errors = open(os.path.join(os.environ.get("WORK", "/tmp"), "stalls.err"), "w+")
        self.stages = []
        for stage in stages:
            words = [{"PORT": self.receiver.port.name, "DEV": self.device.port.name, "SBUS": sys.argv[1]}.get(word, word) for word in stage]
            last = stage is stages[-1]
            self.stages.append(subprocess.Popen(words, stdin=self.stages[-1].stdout if self.stages else subprocess.DEVNULL,
                                                stdout=subprocess.DEVNULL if last else subprocess.PIPE, stderr=self.errors))
            if len(self.stages) > 1:
                self.stages[-2].stdout.close()
        self.receiver.start()
        self.device.start()
        self.waits_for_fresh(30, "the first frames")

    def waits_for_fresh(self, count, what):
        after = len(self.receiver.times)
        until(what, lambda: sum(number >= after and flags == 0 for _, number, flags in self.device.frames[-200:]) >= count)

    def waits_for_line(self, count):
        after = len(self.receiver.times)
        until("the line", lambda: len(self.receiver.times) >= after + count)

    def waits_for_failsafe(self, count):
        after = len(self.device.frames)
        until("failsafe", lambda: sum(flags == 12 for _, _, flags in self.device.frames[after:]) >= count)

    def end(self):
        for stage in self.stages:
            if stage.poll() is None:
                stage.kill()
            stage.wait()

    def figures(self, allowed=0):
        ages = [at - self.receiver.times[number] for at, number, flags in self.device.frames if flags == 0]
        old = [age for age in ages if age > OLD]
        print("%d frames without a flag, %d of them old, the oldest %.2f s; %d with both; %d cut bytes" %
              (len(ages), len(old), max(ages), sum(flags == 12 for _, _, flags in self.device.frames), self.device.cut))
        return len(old) <= allowed and self.device.cut == 0

    def said(self):
        self.errors.seek(0)
        return self.errors.read()


BRIDGE = ["SBUS", "bridge", "PORT", "DEV"]
SEND = ["SBUS", "send", "-", "--port", "DEV"]
CHAINS = {
    "fly": [["SBUS", "bridge", "PORT", "-"], ["python3", "-c", FLY], SEND],
    "own": [["SBUS", "bridge", "PORT", "-"], ["python3", "-c", OWN], SEND],
    "jq": [["SBUS", "hex", "--json", "PORT"], ["jq", "-c", "--unbuffered", "."], SEND],
    "record": [["SBUS", "record", "PORT"], SEND],
    "rows": [["SBUS", "csv", "PORT", "--every-frame", "--header", "--columns", "time,ch1-ch16"], SEND],
    "cat": [["cat", "PORT"], ["SBUS", "bridge", "-", "DEV"]],
    "bytes": [["cat", "PORT"], SEND],
    "bridge": [BRIDGE],
    "send": [["SBUS", "send", "PORT", "--port", "DEV"]],
}


def stop(chain, member, frames=220):
    """SIGSTOP for as long as the line has `frames` frames."""
    chain = Chain(CHAINS[chain])
    stage = chain.stages[member]
    stage.send_signal(signal.SIGSTOP)
    if stage is not chain.stages[-1]:
        chain.waits_for_failsafe(20)
    chain.waits_for_line(frames)
    stage.send_signal(signal.SIGCONT)
    chain.waits_for_fresh(50, "the newest frames after the stop")
    chain.end()
    return chain.figures()


def ends(chain, text):
    """The last program ends with status 1 and says so."""
    until("the end of the last program", lambda: chain.stages[-1].poll() is not None)
    if not chain.device.gone.is_set():
        until("the last bytes", lambda: not select.select([chain.device.port.file], [], [], 0)[0])
    status = chain.stages[-1].returncode
    chain.end()
    said = chain.said().strip().split("\n")[-1]
    print("status %d, %s: " % (status, said), end="")
    return chain.figures() and status == 1 and text in said


def is_cut(chain):
    """... after a failsafe frame."""
    return ends(chain, "ended before its line did") and chain.device.frames[-1][2] == 12


def kill(chain, member):
    chain = Chain(CHAINS[chain])
    chain.stages[member].send_signal(signal.SIGKILL)
    return is_cut(chain)


def vanish(chain):
    """The receiver's end is unplugged: reads fail with EIO."""
    chain = Chain(CHAINS[chain])
    chain.receiver.silent = True
    chain.receiver.is_silent.wait()
    os.close(chain.receiver.port.far)
    os.close(chain.receiver.port.file)
    return is_cut(chain)


def lose(chain):
    """The device is unplugged: writes fail with EIO, and it cannot come back."""
    chain = Chain(CHAINS[chain])
    chain.device.gone.set()
    chain.device.join()
    for end in (chain.device.port.far, chain.device.port.file):
        os.close(end)
    return ends(chain, "no program reads it any longer")


def queue():
    """SIGSTOP while a frame waits for the gap after the one before it."""
    device = Device()
    chain = Chain([BRIDGE], Receiver(at_once=2), device)
    for _ in range(5):
        stopped = threading.Event()

        def on_frame():
            if not stopped.is_set() and device.frames[-1][1] % 2 == 0:
                chain.stages[0].send_signal(signal.SIGSTOP)
                stopped.set()

        device.on_frame = on_frame
        until("a frame", stopped.is_set)
        device.on_frame = None
        chain.waits_for_line(60)
        chain.stages[0].send_signal(signal.SIGCONT)
        chain.waits_for_fresh(20, "the newest frames after the stop")
    chain.end()
    return chain.figures()


def full(chain, frames=330):
    """The device takes no bytes. One frame was fresh when it was written, and is old when it is read."""
    chain = Chain(CHAINS[chain])
    chain.device.paused.set()
    chain.waits_for_line(frames)
    chain.device.paused.clear()
    chain.waits_for_fresh(50, "the newest frames after the device's pause")
    chain.end()
    return chain.figures(allowed=1)


def slow(chain, size, period):
    chain = Chain(CHAINS[chain], device=Device(int(size), float(period)))
    chain.waits_for_line(1000)
    chain.waits_for_fresh(20, "the newest frames")
    chain.end()
    return chain.figures()


def times(*arguments):
    """A program that is stopped again and again writes times that rise."""
    receiver = Receiver()
    program = subprocess.Popen([sys.argv[1], arguments[0], receiver.port.name, *arguments[1:]], stdout=subprocess.PIPE,
                               stderr=subprocess.DEVNULL, text=True)
    receiver.start()
    lines = []
    threading.Thread(target=lambda: lines.extend(program.stdout), daemon=True).start()
    until("the first lines", lambda: len(lines) > 30)
    for frames in (3, 17, 40, 17, 300):
        program.send_signal(signal.SIGSTOP)
        after = len(receiver.times)
        until("the line", lambda: len(receiver.times) >= after + frames)
        program.send_signal(signal.SIGCONT)
        after = len(lines)
        until("the next lines", lambda: len(lines) >= after + 20)
    program.send_signal(signal.SIGINT)
    program.wait()
    time.sleep(0.1)
    came = [json.loads(line).get("time_us") if line.startswith("{") else line.split(",")[0] for line in lines]
    came = [float(us) for us in came if us not in (None, "time")]
    reader = subprocess.run([sys.argv[1], "hex", "-"], input="".join(lines), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    read = sum(" frame " in line for line in reader.stdout.split("\n"))
    back = sum(a >= b for a, b in zip(came, came[1:]))
    print("%d times, %d of them not after the one before; %d frames read, status %d %s" % (len(came), back, read, reader.returncode, reader.stderr[:80].strip()))
    return back == 0 and read > 0.9 * len(came) and reader.returncode == 0


cases = {"times": times, "stop": stop, "kill": kill, "vanish": vanish, "lose": lose, "queue": queue, "full": full, "slow": slow}
words = sys.argv[2:]
sys.exit(not cases[words[0]](*[int(word) if word.isdigit() else word for word in words[1:]]))
