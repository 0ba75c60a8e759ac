# controller.py
import json
import select
import struct
import sys
import time

AXES = {3: 0, 4: 1, 5: 2, 0: 3}  # an Xbox controller: right stick CH1, CH2; right trigger CH3; left stick's X CH4
channels = [992, 992, 172] + [992] * 13  # CH3 stays closed until the trigger moves
due = 0
with open(sys.argv[1], 'rb', buffering=0) as controller:
    while True:
        if select.select([controller], [], [], max(0, due - time.monotonic()))[0]:
            event = controller.read(8)
            if not event:
                sys.exit('the controller is gone')
            _, value, kind, number = struct.unpack('IhBB', event)
            if kind == 2 and number in AXES:
                channels[AXES[number]] = 992 + round(value * 819 / 32767)
        if time.monotonic() >= due:
            due = time.monotonic() + 0.009
            read_us = time.clock_gettime_ns(time.CLOCK_BOOTTIME) // 1000
            print(json.dumps({'type': 'frame', 'first': 1, 'channels': channels, 'read_us': read_us}), flush=True)
