# plot.py
import json
import socket
import sys
import time

from sticks import frames

COLUMNS = [f'CH{n}' for n in range(1, 17)] + ['lost']


def as_json(now, values):
    return json.dumps({'time': now, **values})


FORMATS = {  # UDP port, and how the values are written
    'lines': (None, as_json),
    'udp': (5005, as_json),
    'plotjuggler': (9870, lambda now, values: json.dumps({'timestamp': now, 'sbus': values})),
    'teleplot': (47269, lambda now, values: '\n'.join(f'{key}:{now * 1000:.0f}:{values[key]}' for key in values)),
    'serial-studio': (7878, lambda now, values: ','.join(str(values.get(key, 0)) for key in COLUMNS) + '\n'),
}
name, host, port = (sys.argv[1:] + [None, None])[:3]
default, text_of = FORMATS[name]
udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
for channels, lost in frames():
    us = {} if lost else {f'CH{n}': 5 * raw / 8 + 880 for n, raw in enumerate(channels, 1)}
    text = text_of(time.time(), {'lost': int(lost), **us})
    if default:
        udp.sendto(text.encode(), (host or '127.0.0.1', int(port or default)))
    else:
        print(text, flush=True)
