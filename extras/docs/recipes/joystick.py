# joystick.py
import time

from evdev import AbsInfo, UInput, ecodes
from sticks import frames

AXES = [getattr(ecodes, 'ABS_' + name) for name in ('X', 'Y', 'Z', 'RX', 'RY', 'RZ', 'THROTTLE', 'RUDDER')]
BUTTONS = [ecodes.BTN_TRIGGER + n for n in range(8)]
REST = [992, 992, 172] + [992] * 13  # the sticks centred, and CH3 at its low end
abilities = [(axis, AbsInfo(raw, min=172, max=1811, fuzz=0, flat=0, resolution=0)) for axis, raw in zip(AXES, REST)]
controller = UInput({ecodes.EV_ABS: abilities, ecodes.EV_KEY: BUTTONS}, name='sbus')
for channels, lost in frames():
    values = REST if lost else channels
    for axis, raw in zip(AXES, values):  # CH1 to CH8
        controller.write(ecodes.EV_ABS, axis, max(172, min(1811, raw)))
    for button, raw in zip(BUTTONS, values[8:]):  # CH9 to CH16, pressed above +50 %
        controller.write(ecodes.EV_KEY, button, int(raw > 1402))
    controller.syn()
time.sleep(0.1)  # a game reads the last values; once the controller is gone, Linux returns none
