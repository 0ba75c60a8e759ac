#!/usr/bin/python3
"""Runs the class of other-platforms.md on frames: python.py FOLDER RECORDING, FOLDER has sbus.py. Ends with 0 if it reads all frames of
clean lines, and of lines that lose bytes none that was not sent."""
import os
import pathlib
import random
import sys

sys.path.insert(0, sys.argv[1])
from sbus import SBus  # noqa: E402

SEED = int(os.environ.get("SEED", "1"))
WRAP = 1 << 30  # of MicroPython's ticks_ms()


def frame_of(channels, flags, end=0):
    bits = sum(value << 11 * n for n, value in enumerate(channels))
    return bytes([0x0F]) + bits.to_bytes(22, "little") + bytes([flags, end])


def recorded(path):
    """Returns the recording's frames: lines of 25 bytes, 9 ms apart."""
    lines = [line.split() for line in pathlib.Path(path).read_text().splitlines() if line and line[0].isdigit()]
    return [bytes(int(byte, 16) for byte in line[1:]) for line in lines if len(line) == 26 and "!" not in "".join(line)]


def received(frames, period_ms=9, start_ms=0, lossy=None):
    """Returns (channels, flags) of the frames that come out, at a poll each ms, and what failsafe() says at the end."""
    receiver = SBus(start_ms % WRAP)
    assert receiver.failsafe(start_ms % WRAP)
    line = [(start_ms + 5 + n * period_ms + 0.12 * (i + 1), byte) for n, frame in enumerate(frames) for i, byte in enumerate(frame)]
    if lossy:
        line = [item for item in line if lossy.random() > 1 / 100]
    seen, at = [], 0
    end = start_ms + 20 + len(frames) * period_ms
    for now in range(start_ms, end):
        upto = at
        while upto < len(line) and line[upto][0] <= now:
            upto += 1
        data = bytes(byte for _, byte in line[at:upto]) or None
        at = upto
        if receiver.poll(data, now % WRAP):
            seen.append((tuple(receiver.channels), receiver.ch17, receiver.ch18, receiver.lost, receiver.failsafe(now % WRAP)))
    silent = receiver.failsafe((end + 200) % WRAP)
    return seen, silent


def fields(frame):
    channels = tuple(int.from_bytes(frame[1:23], "little") >> 11 * n & 2047 for n in range(16))
    return (channels, *(bool(frame[23] & bit) for bit in (1, 2, 4, 8)))


real = recorded(sys.argv[2])
assert len(real) >= 3 and fields(real[0])[0][:2] == (997, 992), real
seen, silent = received(real)
assert seen == [fields(frame) for frame in real] and silent, (len(seen), len(real), silent)

random_ = random.Random(SEED)
made = [frame_of([random_.randrange(2048) for _ in range(16)], random_.randrange(16), random_.choice([0, 4, 0x14, 0x24, 0x34])) for _ in range(3000)]
for period in (6, 9, 14, 15):
    seen, _ = received(made, period, WRAP - 5000)
    assert seen == [fields(frame) for frame in made], f"period {period}, seed {SEED}: {len(seen)} of {len(made)}"
sent = {fields(frame) for frame in made}
seen, _ = received(made, 9, 0, random_)
assert len(seen) > 2000 and all(frame in sent for frame in seen), f"seed {SEED}"
