# mavlink.py
import os
import sys

os.environ['MAVLINK20'] = '1'  # MAVLink 1 has only eight channels

from pymavlink import mavutil
from sticks import frames

RELEASE = [0] * 8 + [65534] * 10  # to the vehicle's own receiver
vehicle = mavutil.mavlink_connection(sys.argv[1])
for channels, lost in frames():
    us = RELEASE if lost else [round(5 * raw / 8 + 880) for raw in channels[:16]] + [65535] * 2
    vehicle.mav.rc_channels_override_send(1, 1, *us)
