"""Pseudo-terminals and frames, for the Python in these scripts."""
import os
import pty
import select
import tty


class Port:
    """A pseudo-terminal: `sbus` has the end `name`, the test the other one."""

    def __init__(self):
        self.file, self.far = pty.openpty()
        tty.setraw(self.far)
        self.name = os.ttyname(self.far)

    def write(self, data):
        os.write(self.file, data)

    def read(self, seconds, size=4096):
        """Returns what comes within this time, at the latest; nothing otherwise."""
        return os.read(self.file, size) if select.select([self.file], [], [], max(0, seconds))[0] else b""


def frame(*raw):
    """A frame with these values of CH1 and so on; the others are 992."""
    bits = sum(value << 11 * i for i, value in enumerate([*raw, *[992] * (16 - len(raw))]))
    return bytes([15]) + bits.to_bytes(22, "little") + bytes(2)


def value_of(data):
    """CH1 of a frame."""
    return data[1] | (data[2] & 7) << 8
