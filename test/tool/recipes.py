"""Runs the programs of the folder beside a page of recipes, and its commands: recipes.py PAGE FOLDER. A command that no line below takes is
a failure. Receivers are UDP sockets and pseudo-terminals here; rclpy, evdev and, where it is not installed, pymavlink are stand-ins."""
import atexit
import contextlib
import importlib.util
import itertools
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import time

page, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
for program in (page.parent / "recipes").glob("*.py"):
    shutil.copy(program, folder)
commands = [line for text in re.findall(r"^```\n(.*?)^```$", page.read_text(), re.M | re.S) for line in text.splitlines()]
LIVE, FAILSAFE = "ch1=1811,ch3=500", "ch1=1811,ch3=500,failsafe=on"
SECONDS = 60  # how long a test waits for what must come
MANY = 6000  # frames, about a minute


def verdict(well, what):
    print(f"{'ok' if well else 'FAILED'} sbus: recipes: {what}")


started = []


def start(command, **options):
    """Starts a program or, given as a text, a pipe; at the end of this one it is killed."""
    process = subprocess.Popen(command, shell=isinstance(command, str), stderr=subprocess.DEVNULL, start_new_session=True, **options)
    started.append(process)
    return process


def kill(process):
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


atexit.register(lambda: [kill(process) for process in started])


def run(command):
    return subprocess.run(command, shell=True, cwd=folder, capture_output=True, text=True, timeout=SECONDS)


def taken(start):
    """Returns the page's command that begins like this, and strikes it off."""
    found = [command for command in commands if command.startswith(start)]
    if len(found) != 1:
        verdict(False, f"the page has one command {start}...: {found}")
        return "false"
    commands.remove(found[0])
    return found[0]


def on(command, source):
    """Returns a command that reads a port, on a source that ends: late enough for a program that starts slowly on a busy PC."""
    return command.replace("/dev/ttyUSB0 -", f"{source} - --seconds 1")


class Receiver:
    def __init__(self):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(SECONDS)
        self.port = self.socket.getsockname()[1]

    def next(self):
        return self.socket.recv(4096)

    def all(self):
        """Returns what has come: the sender has ended."""
        self.socket.setblocking(False)
        datagrams = []
        with contextlib.suppress(BlockingIOError):
            while True:
                datagrams.append(self.next())
        return datagrams


def follows(what, outputs, live, lost):
    """A program prints or sends `live` of a live link, and `lost` in failsafe, of late frames and at its end."""
    for source, wanted in (LIVE, live), (FAILSAFE, lost):
        values = outputs(source)
        well = len(values) > 10 and values[-1] == lost and wanted in values and all(value in (wanted, lost) for value in values)
        verdict(well, f"{what} of {source}")


def datagrams_of(command, read):
    """Returns a function that runs the command on a source, a receiver's port in place of PORT, and returns what it sends."""
    def outputs(source):
        receiver = Receiver()
        run(on(command, source).replace("PORT", str(receiver.port)))
        return [read(datagram) for datagram in receiver.all()]
    return outputs


# ---- What counts as a lost link

def frame(age=-60.0, **fields):  # s; still fresh when a slow machine comes to it
    read_us = (time.clock_gettime(time.CLOCK_BOOTTIME) - age) * 1e6
    sticks = {"channels": [1811, 992, 500] + [992] * 13, "lost_frame": False, "failsafe": False}
    return json.dumps({"type": "frame", "first": 1, "read_us": read_us, **sticks, **fields})


def without_end(lines):
    """Returns `lost` of each frame. The last line is always lost: the pipe has ended."""
    (folder / "given").write_text("\n".join(lines) + "\n")
    answers = [json.loads(line) for line in run("python3 plot.py lines <given").stdout.splitlines()]
    assert answers[-1]["lost"] == 1
    # A slow machine adds lines, lost: never the other way round.
    assert all(("CH1" in answer) == (answer["lost"] == 0) for answer in answers)
    return [answer["lost"] for answer in answers[:-1]]


zeros = [0, 0, 0, 0] + [992] * 12
for what, lines, wanted in [
    ("a fresh frame is live", [frame()], [0]),
    ("failsafe", [frame(failsafe=True)], [1]),
    ("no pulses, without a flag", [frame(channels=zeros)], [1]),
    ("0 on CH1 to CH3 alone", [frame(channels=[0, 0, 0] + [992] * 13)], [0]),
    ("a throttle at 0 is no lost link", [frame(channels=[992, 992, 0, 992] + [992] * 12)], [0]),
    ("a single lost frame is no lost link", [frame(), frame(lost_frame=True), frame()], [0, 0, 0]),
    ("100 lost frames in a row are", [frame(lost_frame=True)] * 101 + [frame()], [0] * 99 + [1, 1, 0]),
    ("a frame that is too old", [frame(age=1.0), frame()], [1, 0]),
    ("CH17 to CH32 are no sticks", [frame(), frame(first=17)], [0]),
    ("a line that is no JSON ends it", [frame(), "{", frame()], [0]),
    ("nothing", [""], []),
]:
    lost = without_end(lines)
    verdict(lost == wanted, f"{what}: {lost if len(lost) < 9 else ''}")

# ---- Plots, UDP, MQTT

NAMES = [f"CH{n}" for n in range(1, 17)]
US = dict(zip(NAMES, [2011.875, 1500.0, 1192.5] + [1500.0] * 13))


def of_json(datagram):
    values = json.loads(datagram)
    assert values.pop("time") > 1e9
    return values


def of_plotjuggler(datagram):
    outer = json.loads(datagram)
    assert outer["timestamp"] > 1e9 and len(outer) == 2
    return outer["sbus"]


def of_teleplot(datagram):
    values = {}
    for line in datagram.decode().split("\n"):
        name, ms, value = line.split(":")
        assert re.fullmatch(r"\d{13}", ms)
        values[name] = float(value)
    return values


def of_serial_studio(datagram):
    *us, lost = datagram.decode().removesuffix("\n").split(",")
    assert datagram.endswith(b"\n") and len(us) == 16
    return {"lost": int(lost), **{name: float(value) for name, value in zip(NAMES, us) if float(value)}}


for name, read in [("udp", of_json), ("plotjuggler", of_plotjuggler), ("teleplot", of_teleplot), ("serial-studio", of_serial_studio)]:
    command = re.sub(r" 192\.[0-9.]+$", "", taken(f"sbus bridge /dev/ttyUSB0 - | python3 plot.py {name}")) + " 127.0.0.1 PORT"
    follows(f"plot.py {name}", datagrams_of(command, read), {"lost": 0, **US}, {"lost": 1})

# A pipe that hangs or breaks: a lost link is reported while nothing comes, the sticks when they come again.
for end in signal.SIGKILL, signal.SIGINT:
    receiver = Receiver()
    sbus = start(["sbus", "bridge", LIVE, "-"], stdout=subprocess.PIPE)
    plot = start(["python3", "plot.py", "udp", "127.0.0.1", str(receiver.port)], cwd=folder, stdin=sbus.stdout)

    def until(lost):
        return any(of_json(receiver.next())["lost"] == lost for _ in range(MANY))

    well = until(0)
    sbus.send_signal(signal.SIGSTOP)
    well = well and until(1)
    sbus.send_signal(signal.SIGCONT)
    well = well and until(0)
    sbus.send_signal(end)
    sbus.wait()
    plot.wait(SECONDS)
    verdict(well and of_json(receiver.all()[-1]) == {"lost": 1}, f"a stopped sbus is a lost link, and so is its end by {end.name}")

command = taken("sbus bridge /dev/ttyUSB0 - | python3 plot.py lines | mosquitto_pub ")
broker = shutil.which("mosquitto", path=os.environ["PATH"] + ":/usr/sbin")
if not (broker and shutil.which("mosquitto_sub")):
    print("skipped sbus: recipes: MQTT: there is no mosquitto here, or no mosquitto-clients")
else:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    (folder / "broker").write_text(f"listener {port} 127.0.0.1\nallow_anonymous true\n")
    start([broker, "-c", folder / "broker"])
    wait = f"timeout --foreground {SECONDS} sh -c 'until mosquitto_sub -p {port} -t sbus -t ready; do sleep 0.1; done'"
    subscriber = start(wait, stdout=subprocess.PIPE, text=True)
    greeter = start(f"while :; do mosquitto_pub -p {port} -t ready -m ready; sleep 0.1; done")

    def comes(text):
        """Waits for that line, and returns those before it; None if it does not come."""
        lines = []
        for line in subscriber.stdout:
            if line == text:
                return lines
            lines.append(line)
        return None

    comes("ready\n")
    kill(greeter)
    done = run(on(command, LIVE).replace("mosquitto_pub", f"mosquitto_pub -p {port}"))
    run(f"mosquitto_pub -p {port} -t ready -m end")
    seen = [of_json(line) for line in comes("end\n") or [] if line != "ready\n"]
    verdict(done.returncode == 0 and {"lost": 0, **US} in seen and seen[-1] == {"lost": 1}, "plot.py lines to MQTT")
    run(on(command, LIVE).replace("mosquitto_pub", f"timeout -s KILL 0.2 mosquitto_pub -p {port}").replace("--seconds 1", "--seconds 5"))
    verdict(comes('{"lost": 1}\n') is not None, "MQTT: a killed publisher's will is a lost link")

# ---- MAVLink

PYMAVLINK = '''import os, socket, struct
class Vehicle:
    def __init__(self, address):
        kind, host, port = address.split(":")
        assert kind == "udpout" and os.environ["MAVLINK20"] == "1"
        self.mav, self.address, self.socket = self, (host, int(port)), socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    def rc_channels_override_send(self, system, component, *channels):
        payload = struct.pack("<8H2B10H", *channels[:8], system, component, *channels[8:]).rstrip(b"\\0")
        self.socket.sendto(struct.pack("<7BHB", 0xFD, len(payload), 0, 0, 0, 255, 0, 70, 0) + payload + b"CC", self.address)
class mavutil:
    mavlink_connection = Vehicle
'''


def of_mavlink(datagram):
    assert datagram[0] == 0xFD and datagram[7:10] == bytes([70, 0, 0])  # MAVLink 2, RC_CHANNELS_OVERRIDE; zeros at its end are not sent
    values = struct.unpack("<8H2B10H", datagram[10:10 + datagram[1]].ljust(38, b"\0"))
    assert values[8:10] == (1, 1)
    return list(values[:8] + values[10:])


RELEASED = [0] * 8 + [65534] * 10
command = taken("sbus bridge /dev/ttyUSB0 - | python3 mavlink.py ")
if not importlib.util.find_spec("pymavlink"):
    (folder / "pymavlink.py").write_text(PYMAVLINK)
    print("skipped sbus: recipes: MAVLink with pymavlink itself: it is not here")
follows("mavlink.py", datagrams_of(command.replace("14550", "PORT"), of_mavlink), [2012, 1500, 1192] + [1500] * 13 + [65535] * 2, RELEASED)

# ---- ROS 2

(folder / "sensor_msgs").mkdir()
(folder / "sensor_msgs/msg.py").write_text('''class Header: stamp = None
class Joy:
    def __init__(self):
        self.header, self.axes, self.buttons = Header(), [], []
''')
(folder / "rclpy.py").write_text('''import sensor_msgs.msg
def init(): pass
class Node:
    def create_publisher(self, kind, topic, depth):
        assert (kind, topic, depth) == (sensor_msgs.msg.Joy, "joy", 1)
        return self
    def publish(self, joy):
        assert joy.header.stamp == "now" and all(type(axis) is float and -1 <= axis <= 1 for axis in joy.axes)
        print(joy.axes[:4], joy.buttons, flush=True)
    def get_clock(self): return self
    def now(self): return self
    def to_msg(self): return "now"
def create_node(name): return Node()
''')
command = taken("sbus bridge /dev/ttyUSB0 - | python3 ros.py")
follows("ros.py", lambda source: run(on(command, source)).stdout.splitlines(), f"[{819 / 819.5}, 0.0, {-492 / 819.5}, 0.0] [1]",
        "[0.0, 0.0, -1.0, 0.0] [0]")
verdict("[1.0, -1.0, -1.0, 0.0] [1]" in run(on(command, "ch1=2047,ch2=0")).stdout, "ros.py limits its axes to -1..1")

# ---- A game controller for simulators and games

(folder / "evdev.py").write_text('''import collections
AbsInfo = collections.namedtuple("AbsInfo", "value min max fuzz flat resolution")
class ecodes:  # Linux, include/uapi/linux/input-event-codes.h
    EV_KEY, EV_ABS, BTN_TRIGGER = 1, 3, 0x120
    ABS_X, ABS_Y, ABS_Z, ABS_RX, ABS_RY, ABS_RZ, ABS_THROTTLE, ABS_RUDDER = range(8)
class UInput:
    def __init__(self, events, name):
        self.axes, self.now = dict(events[ecodes.EV_ABS]), {}
        self.known = {(ecodes.EV_ABS, axis) for axis in self.axes} | {(ecodes.EV_KEY, key) for key in events[ecodes.EV_KEY]}
    def write(self, kind, code, value):
        assert (kind, code) in self.known
        assert value in (0, 1) if kind == ecodes.EV_KEY else self.axes[code].min <= value <= self.axes[code].max
        self.now[code] = value
    def syn(self): print([self.now[code] for code in [*range(8), *range(0x120, 0x128)]], flush=True)
''')
command = taken("sbus bridge /dev/ttyUSB0 - | python3 joystick.py")
follows("joystick.py", lambda source: run(on(command, source)).stdout.splitlines(), str([1811, 992, 500] + [992] * 5 + [0] * 8),
        str([992, 992, 172] + [992] * 5 + [0] * 8))
verdict(str([1811, 172, 172] + [992] * 5 + [1, 0, 1] + [0] * 5) in run(on(command, "ch1=2047,ch2=0,ch9=1811,ch10=1402,ch11=1403")).stdout,
        "joystick.py limits its axes, and presses buttons above +50 %")

# ---- A game controller: js_event of a FIFO, which ends where a device would say that it is gone

os.mkfifo(folder / "js0")
command = taken("python3 controller.py /dev/input/js0 | sbus send - ")
command = command.replace("/dev/input/js0", "js0").replace(" --port /dev/ttyUSB0", "")


def controller_goes():
    """Returns whether the frames are right at first, with the sticks moved, and once the controller is gone. A pseudo-terminal
    whose sender has ended loses what a late reader has not read: then the last is False."""
    (folder / "terminal").write_text("")
    start(f"{command} >terminal", cwd=folder)
    AXIS, INITIAL = 2, 0x80
    with open(folder / "js0", "wb", buffering=0) as controller:
        for number in range(6):
            controller.write(struct.pack("IhBB", 1, 0, AXIS | INITIAL, number))  # Linux says 0 of a trigger that has not moved
        while not (terminal := (folder / "terminal").read_text()).endswith("\n"):
            time.sleep(0.01)
        hex_lines = start(["sbus", "hex", "--json", terminal.strip()], stdout=subprocess.PIPE, text=True)

        def wait_for(channels, failsafe):
            frames = (values for values in map(json.loads, itertools.islice(hex_lines.stdout, MANY)) if values["type"] == "frame")
            return any((values["channels"][:4], values["failsafe"]) == (channels, failsafe) for values in frames)

        closed = wait_for([992, 992, 172, 992], False)
        for number, value in (5, -32767), (5, 32767), (3, 32767), (4, -32767), (0, 16384):
            controller.write(struct.pack("IhBB", 2, value, AXIS, number))
        controller.write(struct.pack("IhBB", 3, 1, 1, 0))  # a button
        moved = wait_for([1811, 173, 1811, 1402], False)
    return closed, moved, wait_for([1811, 173, 1811, 1402], True)


for _ in range(5):
    closed, moved, lost = controller_goes()
    if not (closed and moved) or lost:
        break
verdict(closed, "controller.py keeps the throttle closed until its trigger moves")
verdict(moved, "controller.py sends the sticks")
verdict(lost, "a controller that is gone is a failsafe")

# ---- A trainer port; a Raspberry Pi's port

command = taken("sbus bridge /dev/ttyUSB0 /dev/ttyUSB1 --failsafe off")
done = run(command.replace("/dev/ttyUSB0 /dev/ttyUSB1", f"{LIVE} - --seconds 0.3") + "; " +
           command.replace("/dev/ttyUSB0 /dev/ttyUSB1", f"{FAILSAFE} - --seconds 0.3"))
frames = [line for line in done.stdout.splitlines() if '"type":"frame"' in line]
verdict(len(frames) > 10 and not any('"failsafe":true' in line for line in frames), "bridge --failsafe off sends no frame in failsafe")

done = run(taken("sbus doctor").replace("/dev/ttyAMA0", "sim --simulated-time"))
verdict(done.returncode == 0 and "All well" in done.stdout, "doctor")

verdict(not commands, f"each command of the page is run: {commands}")
