# sticks.py
import json
import queue
import sys
import threading
import time


def frames():
    """Yields (channels, lost) per frame, at least every 0.1 s. Channels are raw, 0..2047; None before the first frame.
    While lost is true they are old, or the receiver's failsafe positions: do not use them."""
    received = queue.Queue()

    def read():
        try:
            for line in sys.stdin:
                frame = json.loads(line)
                if frame.get('first') == 1:  # not the line of type end; not CH17 to CH32
                    received.put(frame)
        finally:
            received.put(None)

    threading.Thread(target=read, daemon=True).start()
    channels, in_a_row = None, 0
    while True:
        try:
            frame = received.get(timeout=0.1)
        except queue.Empty:  # sbus was stopped, or there is no receiver
            yield channels, True
            continue
        if frame is None:  # sbus has ended
            yield channels, True
            return
        channels = frame['channels']
        in_a_row = in_a_row + 1 if frame['lost_frame'] else 0
        age = time.clock_gettime(time.CLOCK_BOOTTIME) - frame['read_us'] / 1e6  # s
        no_pulses = not any(channels[:4])  # a lost link, even without the flag
        yield channels, frame['failsafe'] or no_pulses or in_a_row >= 100 or age > 0.1
