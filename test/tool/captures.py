"""Captures as instruments write them, with the trigger anywhere: every subcommand finds every frame, at the capture's own times.

captures.py SBUS WORK [LAYOUT]    prints "ok ..." or "FAILED ..." for each layout. SEED: the environment's, printed.
"""

import json, os, random, subprocess, sys

SBUS, WORK = sys.argv[1:3]
ONLY = sys.argv[3] if len(sys.argv) > 3 else ""
SEED = int(os.environ.get("SEED", "1"))
FRAMES = 3
PERIOD_US, IDLE_US = 9000, 5000  # rows of 1 us that idle: more than the 64 KiB that show a file's layout


def frame(channels):
    bits = sum(value << 11 * i for i, value in enumerate(channels))
    return bytes([0x0F]) + bits.to_bytes(22, "little") + bytes([0, 0])


def edges(frames):
    """Returns when the wire changes, in us from the capture's beginning; it idles low."""
    found, level = [], 0
    for i, each in enumerate(frames):
        us = IDLE_US + i * PERIOD_US
        for byte in each:
            bits = [0] + [byte >> bit & 1 for bit in range(8)] + [bin(byte).count("1") & 1, 1, 1]
            for bit in bits:
                if level != 1 - bit:
                    level = 1 - bit
                    found.append((us, level))
                us += 10
    return found


class Capture:
    def __init__(self, rng, trigger):
        self.frames = [frame([rng.randrange(172, 1812) for _ in range(16)]) for _ in range(FRAMES)]
        self.edges = edges(self.frames)
        self.length = IDLE_US + (FRAMES - 1) * PERIOD_US + 6000  # us
        self.zero = round(self.length * trigger)  # us from the beginning to time 0
        self.rng = rng

    def ends(self):
        """The ends of the frames, in us of the capture's time."""
        return [IDLE_US + i * PERIOD_US + 3000 - self.zero for i in range(FRAMES)]

    def levels(self):
        level, at = 0, 0
        for us in range(self.length):
            while at < len(self.edges) and self.edges[at][0] <= us:
                level = self.edges[at][1]
                at += 1
            yield us - self.zero, level

    def volts(self):
        """Samples of 8 bits over 8 V, the last bit noisy."""
        for us, level in self.levels():
            yield us, (round(3.3 * level / 8 * 256) + self.rng.randint(-1, 1)) * 8 / 256


def table(head, row, end=""):
    return lambda capture: head + "".join(row.format(s=us / 1e6, ms=us / 1e3, us=us, ns=us * 1000, v=volts, i=i)
                                          for i, (us, volts) in enumerate(capture.volts())) + end


def changes(head, row):
    return lambda capture: head + row.format(-capture.zero / 1e6, 0) + "".join(
        row.format((us - capture.zero) / 1e6, level) for us, level in capture.edges + [(capture.length, 0)])


def headed(head, row):
    """The head has the time of the first row, and between two."""
    return lambda capture: head.format(-capture.zero / 1e6) + table("", row)(capture)


def tektronix_old(capture):  # TDS1000 and TDS2000: the head stands beside the rows
    head = ["Record Length,2.5e+03", "Sample Interval,1e-06", "Trigger Point,0", "", "", "", "Source,CH1", "Vertical Units,V"]
    return "".join(f"{head[i] + ',' * (2 - head[i].count(',')) if i < len(head) else ',,'},{us / 1e6:.9f},{volts:9.5f},\n"
                   for i, (us, volts) in enumerate(capture.volts()))


def mso(capture):  # Saleae: a waveform each trigger; Trigger [s] begins again
    rows = "".join(f"{i % 7000 / 1e6:.9f},{us / 1e6:.9f},{volts:.4f}\n" for i, (us, volts) in enumerate(capture.volts()))
    return "Trigger [s],Time [s],SBUS\n" + rows


LAYOUTS = {
    "Rigol DS1000Z": headed("X,CH1,Start,Increment,\nSequence,Volt,{:e},1.0e-06\n", "{i},{v:e},,\n"),
    "Rigol MSO5000": table("Time(s),CH1(V)\n", "{s:.6e},{v:.4f}\n"),
    "Rigol DS2000": table("Time(s),CH1V\n", "{s:e},{v:e}\n"),
    "Rigol DHO": headed("CH1V,t0 ={:e},tInc =1.0e-06,\n", "{v:e},,\n"),
    "Keysight": table("x-axis,1\nsecond,Volt\n", "{s:+.6E},{v:+.3E}\n"),
    "Keysight, two channels, a last row cut": table("x-axis,1,2\nsecond,Volt,Volt\n", "{s:+.6E},{v:+.3E},+1.0E-02\n", "+1.0E-01,+0.0E+00\n"),
    "Keysight Infiniium": headed("Revision:,0\nType:,Raw\nPoints:,25000\nXDispRange:,2.5E-02\nXInc:,1.0E-06\nXOrg:,{:E}\nYUnits:,Volts\nData:,\n", "{v:E}\n"),
    "LeCroy": table("LECROYHDO4054,12345,Waveform\nSegments,1,SegmentSize,25000\nSegment,TrigTime,TimeSinceSegment1\n"
                    "#1,11-May-2021 18:12:30,0\nTime,Ampl\n", "{s:.9e},{v:.5f}\n"),
    "PicoScope": table("Time,Channel A\n(ms),(V)\n\n", "{ms:.8f},{v:.8f}\n"),
    "PicoScope in German": table("Zeit;Kanal A\n(us);(mV)\n\n", "{us:.5f};{v:.5f}\n"),
    "R&S": table("in s,C1 in V\n", "{s:.12E},{v:.6E}\n"),
    "Siglent": table("Record Length,Analog:25k\nSample Interval,Analog:1.0e-06\nVertical Units,V\nHorizontal Units,S\n"
                     "Model Number,SDS1104X-E\nSource,CH1\nSecond,Volt\n", "{s:.11f},{v:.5f}\n"),
    "Tektronix MDO": table("Model,MDO3014\nFirmware Version,1.26\n\nPoint Format,Y,\nHorizontal Units,S,\nHorizontal Scale,0.004,\n"
                           "Sample Interval,1e-06,\n,,\nLabel,,\nTIME,CH1\n", "{s:.9e},{v:g}\n"),
    "Tektronix TDS": tektronix_old,
    "WaveForms": table("#Digilent WaveForms Oscilloscope Acquisition\n#Device Name: Discovery2\n#Trigger: Source\n\nTime (s),Channel 1 (V)\n",
                       "{s:.12f},{v:.12f}\n"),
    "Saleae, analogue": table("Time [s],Channel 0\n", "{s:.9f},{v:.9f}\n"),
    "Saleae, analogue, all in quotation marks": table('"Time [s]","Channel 0"\n', '"{s:.9f}","{v:.9f}"\n'),
    "Saleae MSO": mso,
    "Saleae, digital": changes("Time [s],Channel 0\n", "{:.9f},{}\n"),
    "Saleae, digital, two signals": changes("Time [s],SBUS,Other\n", "{:.9f},{},1\n"),
    "WaveForms, digital": changes("Time (s),DIO 0\n", "{:.9f},{}\n"),
    "GW Instek": table("Format,1.0B,\nMemory Length,25000,\nTime,CH1,\n", "{s:.9e},{v:.4f},\n"),
    "GW Instek GDS": table("Memory Length,25000,\nTrigger Level,1.0e+00,\nSource,CH1,\nVertical Units,V,\nHorizontal Units,S,\n"
                           "Sampling Period,1.0e-06,\nFirmware,V1.09,\nTime, ,\nMode,Detail,\nWaveform Data,\n", "{s:.9e},{v:.4f},\n"),
    "Rigol DS1000E": table("Time,X(CH1),X(CH2)\nSecond,Volt,Volt\n", "{s:.8e},{v:.2e},1.00e-02\n"),
    "Tektronix, digital": lambda capture: "#Model,MDO3014\n#Firmware Version,1.26\n#\n#Waveform Type,DIGITAL,,\n#Horizontal Units,s,,\n"
                          "#Sample Interval,1e-06,,\n#Label,SBUS,A\n#TIME,D1,D0\n" + "".join(f"{us / 1e6:.7e},{level},1\n" for us, level in capture.levels()),
    "TekScope, LF CR": lambda capture: table("Model,TekscopeSW\nLabel,CH1\nWaveform Type,ANALOG\nHorizontal Units,s\nSample Interval,1E-06\n"
                                             "Zero Index,100\nVertical Units,V\n,\nLabels,\nTIME,CH1\n", "{s:.9e},{v:.3f}\n")(capture).replace("\n", "\n\r"),
    "Micsig": lambda capture: "ProID,Info,,time,Vol.\n" + "".join(f"{'STO1104' if i == 0 else ''},{'x' if i == 0 else ''},,{us / 1e6:.9f},{volts:.4f}\n" for i, (us, volts) in enumerate(capture.volts())),
    "Keysight, first rows empty": lambda capture: "x-axis,1,2\nsecond,Volt,Volt\n" + "".join(
        f"{us / 1e6:+.6E},{f'{volts:+.3E}' if i > 50 else ''},{'+1.0E-02' if i > 50 else ''}\n" for i, (us, volts) in enumerate(capture.volts())),
    "Keysight, last row empty": table("x-axis,1\nsecond,Volt\n", "{s:+.6E},{v:+.3E}\n", "+9.000000E+00,\n"),
    "Hantek": table("Time,CH1\n,#timebase=5000000(ns)\n", "{s:.9f},{v:.4f}\n"),
    "times as text and decimal commas": lambda capture: table("Time (s);CH1 (V)\n", "{s:.7f};{v:.4f}\n")(capture).replace(".", ","),
}


def run(*arguments):
    done = subprocess.run([SBUS, *arguments], cwd=WORK, capture_output=True, text=True)
    return done.stdout, done.stderr


def frames_in(lines):
    """The frames in JSON lines: time in us, channels."""
    return [(each["time_us"], each["channels"]) for each in map(json.loads, filter(None, lines.splitlines())) if each["type"] == "frame"]


def frames_of(how, file, *options):
    """What decode prints as a table, and hex as JSON lines."""
    out, err = run(how, file, *options, *(["--json"] if how == "hex" else []))
    if how == "hex":
        return frames_in(out), err
    rows = [line.split() for line in out.splitlines() if line.startswith("  ") and line.split()[1].isdigit()]
    return [(float(row[0]) * 1000, list(map(int, row[1:17]))) for row in rows], err


def channels(raw):
    bits = int.from_bytes(raw[1:23], "little")
    return [bits >> 11 * i & 2047 for i in range(16)]


def check(name, file, capture):
    """Returns what is wrong, and how many of the frames each subcommand found."""
    wanted = [channels(each) for each in capture.frames]
    found, wrong = {}, []
    for how in "decode", "hex":
        got, err = frames_of(how, file)
        found[how] = sum(values in wanted for _, values in got)
        if [values for _, values in got] != wanted or any(abs(us - end) > 3 for (us, _), end in zip(got, capture.ends())):
            wrong.append(f"{how}: {[round(us) for us, _ in got]} for {capture.ends()} us: {err.strip()[:100]}")
    counts = {"doctor": (r"%d frames", ("doctor", file)), "summary": ("%d frames", ("summary", file)),
              "record": ("%d frames", ("record", file)), "compare": ("", ("compare", file, file)),
              "csv": ("", ("csv", file, "--every-frame", "--columns", "time,ch1-ch16"))}
    for how, (text, arguments) in counts.items():
        out, err = run(*arguments)
        if how == "csv":
            found[how] = len(out.splitlines())
            times = [float(row.split(",")[0]) * 1e6 for row in out.splitlines()]
            good = found[how] == FRAMES and all(abs(us - end) < 3 for us, end in zip(times, capture.ends()))
        elif how == "compare":
            good = f"same         {FRAMES} frames" in out and not err
        else:
            good = text % FRAMES in out + err
        if not good:
            wrong.append(f"{how}: {(out + err).strip()[-150:]}")
    # A recording keeps the capture's times, and so does what is read from it.
    out, err = run("decode", file, "-o", "again.txt")
    again, err2 = run("hex", "again.txt", "--json")
    os.path.exists(f"{WORK}/again.txt") and os.remove(f"{WORK}/again.txt")
    if [round(us) for us, _ in frames_in(again)] != [round(us) for us, _ in frames_in(run("hex", file, "--json")[0])] or len(frames_in(again)) != FRAMES:
        wrong.append(f"decode -o: {(err + err2).strip()[:150]}")
    # --from and --to are of the capture's time, also below 0.
    first = capture.ends()[0]
    for how in "decode", "hex":
        got, err = frames_of(how, file, f"--from={first / 1e6 - 0.0031}", f"--to={first / 1e6 + 0.0001}")
        if [values for _, values in got] != wanted[:1]:
            wrong.append(f"{how} --from: {err.strip()[:150]}")
    return found, wrong


def main():
    print(f"captures: SEED={SEED}")
    sent = got = 0
    for name, text in LAYOUTS.items():
        if ONLY not in name:
            continue
        problems = []
        for trigger in 0, 0.1, 0.5, 1:
            capture = Capture(random.Random(f"{SEED} {name} {trigger}"), trigger)
            with open(f"{WORK}/capture.csv", "w") as file:
                file.write(text(capture))
            found, wrong = check(name, "capture.csv", capture)
            sent += FRAMES
            got += found["decode"]
            problems += [f"trigger at {trigger * 100:.0f} %: {each}" for each in wrong]
        if problems:
            print("\n".join(problems))
        print(f"{'FAILED' if problems else 'ok'} sbus: every subcommand reads a capture of {name}, wherever its trigger is")
    print(f"captures: {got} of {sent} frames")


main()
