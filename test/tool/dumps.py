"""Bytes as people write them: each way is read as the four frames that it holds.

dumps.py SBUS WORK [WAY]    prints "ok ..." or "FAILED ..." for each way. The tools named are run where they are installed.
"""

import json, os, shutil, subprocess, sys

SBUS, WORK = sys.argv[1:3]
ONLY = sys.argv[3] if len(sys.argv) > 3 else ""

FRAMES = [bytes.fromhex(each) for each in (
    "0F5B2469B59198445E7A15462622A61E6B5B5982A7882D0000", "0F770C68BEA598445E7A15462622A61E6B5B5982A7882D0000",
    "0F883C69B9F398445E7A15462622A61E6B5B5982A7882D0000", "0F61146AB1B198445E7A15462622A61E6B5B5982A7882D0000")]
ALL = b"".join(FRAMES)


def lines(form, data=None):
    """A line for each frame: form(bytes, number)."""
    return "".join(form(each, i) + "\n" for i, each in enumerate(data or FRAMES))


def numbers(form, between):
    return lambda data, i=0: between.join(form % byte for byte in data)


def rows(data, size, form):
    return "".join(form(at, data[at:at + size]) + "\n" for at in range(0, len(data), size))


def strace(data, i=0):
    """As strace prints a string: octal numbers as short as they can be."""
    letters = {9: "\\t", 10: "\\n", 11: "\\v", 12: "\\f", 13: "\\r", 34: '\\"', 92: "\\\\"}
    return "".join(letters.get(byte) or (chr(byte) if 32 <= byte < 127 else
                   "\\%03o" % byte if data[at + 1:at + 2].isdigit() else "\\%o" % byte) for at, byte in enumerate(data))


def ascii(data):
    return "".join(chr(byte) if 32 <= byte < 127 else "." for byte in data)


UPPER, LOWER = numbers("%02X", " "), numbers("%02x", " ")
MARKED, COMMAS = numbers("0x%02X", " "), numbers("0x%02x", ", ")
DECIMAL = numbers("%d", ", ")
OCTAL = lambda data, i=0: "".join("\\%03o" % byte for byte in data)
ESCAPED = lambda data, i=0: "".join("\\x%02x" % byte for byte in data)

WAYS = {
    "two digits": lines(UPPER),
    "small letters": lines(LOWER),
    "all in one line": UPPER(ALL) + "\n",
    "without a line end": UPPER(ALL),
    "flags after the bytes": lines(lambda data, i: UPPER(data) + "  (lost=0 fs=0)"),
    "a checksum after the bytes": lines(lambda data, i: UPPER(data) + " CRC=%04X" % sum(data)),
    "a table of Markdown": "| n | bytes |\n|---|---|\n" + lines(lambda data, i: "| %d | `%s` |" % (i, UPPER(data))),
    "without blanks": lines(numbers("%02X", "")),
    "all without blanks": numbers("%02x", "")(ALL) + "\n",
    "16 a line": rows(ALL, 16, lambda at, row: UPPER(row)),
    "one a line": rows(ALL, 1, lambda at, row: UPPER(row)),
    "one digit where one is enough": lines(numbers("%X", " ")),
    "0x": lines(MARKED),
    "0x and commas": lines(COMMAS),
    "0x and commas to the end of the line": lines(lambda data, i: COMMAS(data) + ","),
    "0x without blanks": lines(numbers("0x%02X", ",")),
    "0x with one digit": lines(numbers("0x%x", ", ")),
    "commas": lines(numbers("%02X", ",")),
    "semicolons": lines(numbers("%02X", ";")),
    "hyphens": lines(numbers("%02X", "-")),
    "colons": lines(numbers("%02x", ":")),
    "underscores": lines(numbers("%02x", "_")),
    "pipes": lines(numbers("%02x", "|")),
    "dots": lines(numbers("%02x", ".")),
    "tabs": lines(numbers("%02x", "\t")),
    "\\x before": lines(ESCAPED),
    "\\x in quotation marks": lines(lambda data, i: '"' + ESCAPED(data) + '"'),
    "in brackets": lines(numbers("[%02X]", " ")),
    "in braces": lines(numbers("{%02X}", "")),
    "in quotation marks": lines(lambda data, i: '"' + UPPER(data) + '"'),
    "Python bytes": lines(lambda data, i: repr(data)),
    "Python bytearray": lines(lambda data, i: repr(bytearray(data))),
    "Python prompt": lines(lambda data, i: ">>> " + repr(data)),
    "Python bytes, all": repr(ALL) + "\n",
    "Python name": "frames = " + repr(ALL) + "\n",
    "Python list": lines(lambda data, i: repr(list(data))),
    "Python list of all": repr(list(ALL)) + "\n",
    "Python list of lists": repr([list(each) for each in FRAMES]) + "\n",
    "Python tuple": lines(lambda data, i: repr(tuple(data))),
    "Python bytes of a list": lines(lambda data, i: f"bytes({list(data)})"),
    "Python bytearray of a list": lines(lambda data, i: f"bytearray({list(data)})"),
    "Python list of hex()": lines(lambda data, i: repr([hex(byte) for byte in data])),
    "Python fromhex": lines(lambda data, i: f"bytes.fromhex('{data.hex()}')"),
    "Python hexlify": lines(lambda data, i: repr(data.hex().encode())),
    "Python list over lines": "data = [\n" + rows(ALL, 12, lambda at, row: "    " + COMMAS(row) + ",") + "]\n",
    "numpy": "[" + rows(ALL, 18, lambda at, row: " " + " ".join("%3d" % byte for byte in row))[1:-1] + "]\n",
    "numpy's repr": lines(lambda data, i: f"array([{DECIMAL(data)}], dtype=uint8)"),
    "Java, cast": lines(numbers("(byte)0x%02X", ", ")),
    "0x once": lines(lambda data, i: "0x" + data.hex()),
    "a comment's year": "/* S.BUS\n * captured 2021 */\n" + lines(COMMAS),
    "array": lines(lambda data, i: f"array('B', {list(data)})"),
    "C array": lines(lambda data, i: f"uint8_t frame{i}[25] = {{{COMMAS(data)}}};"),
    "C array over lines": "const unsigned char frames[] = {\n" + rows(ALL, 12, lambda at, row: "  " + COMMAS(row) + ",") + "};\n",
    "C array with comments": "static const uint8_t f[100] PROGMEM = { // four frames\n" + lines(lambda data, i: f"  {COMMAS(data)},  // frame {i}") + "};\n",
    "C array in decimal": lines(lambda data, i: f"byte frame[] = {{{DECIMAL(data)}}};"),
    "C string": lines(lambda data, i: f'const char *frame = "{ESCAPED(data)}";'),
    "xxd -i": "unsigned char a_bin[] = {\n" + rows(ALL, 12, lambda at, row: "  " + COMMAS(row) + ",") + "};\nunsigned int a_bin_len = 100;\n",
    "Node": lines(lambda data, i: f"<Buffer {LOWER(data)}>"),
    "JavaScript": lines(lambda data, i: f"Uint8Array(25) [ {DECIMAL(data)} ]"),
    "Go": lines(lambda data, i: "[]byte{" + ", ".join("0x%x" % byte for byte in data) + "}"),
    "Go, decimal": lines(lambda data, i: "[" + " ".join("%d" % byte for byte in data) + "]"),
    "Rust": lines(lambda data, i: "[" + ", ".join("%x" % byte for byte in data) + "]"),
    "Java, signed": lines(lambda data, i: "[" + ", ".join("%d" % (byte - 256 if byte > 127 else byte) for byte in data) + "]"),
    "decimal and commas": lines(numbers("%d", ",")),
    "decimal and blanks": lines(numbers("%d", " ")),
    "decimal, three digits": lines(numbers("%03d", " ")),
    "decimal, padded": lines(numbers("%3d", " ")),
    "decimal, all in one line": numbers("%d", " ")(ALL) + "\n",
    "label": lines(lambda data, i: "RX: " + UPPER(data)),
    "label without a blank": lines(lambda data, i: "RX:" + UPPER(data)),
    "label without a colon": lines(lambda data, i: "SBUS " + UPPER(data)),
    "label with a count": lines(lambda data, i: f"Received 25 bytes: {UPPER(data)}"),
    "label of a frame": lines(lambda data, i: f"frame {i}: {COMMAS(data)}"),
    "prompt": lines(lambda data, i: "> " + UPPER(data)),
    "arrow": lines(lambda data, i: "<- " + UPPER(data)),
    "a number and an arrow": lines(lambda data, i: f"12 -> {UPPER(data)}"),
    "Arduino's serial monitor": lines(lambda data, i: f"18:12:30.{i}45 -> {UPPER(data)}"),
    "time": lines(lambda data, i: f"18:12:30 {UPPER(data)}"),
    "time in brackets": lines(lambda data, i: f"[18:12:30.{i}45] {UPPER(data)}"),
    "date and time": lines(lambda data, i: f"2021-05-11 18:12:30,{i}45 {UPPER(data)}"),
    "date and time of ISO 8601": lines(lambda data, i: f"2021-05-11T18:12:30.{i}45Z {UPPER(data)}"),
    "date, time and direction (Docklight)": lines(lambda data, i: f"11.05.2021 18:12:30.{i}45 [RX] - {UPPER(data)}"),
    "date and time with us": rows(ALL, 7, lambda at, row: f"2021-05-11 18:12:30.{at:06d} {UPPER(row)}"),
    "ms and a comma": lines(lambda data, i: f"{123456 + 9 * i},{UPPER(data)}"),
    "a frame in parts": lines(lambda data, i: f"{UPPER(data[:1])} | {UPPER(data[1:23])} | {UPPER(data[23:])}"),
    "seconds": lines(lambda data, i: f"12.34{i} {UPPER(data)}"),
    "kernel's seconds": lines(lambda data, i: f"[   12.34{i}567] {UPPER(data)}"),
    "ms and a colon": lines(lambda data, i: f"{1000 + 9 * i}: {UPPER(data)}"),
    "ms and a colon, decimal": lines(lambda data, i: f"{1000 + 9 * i}: {DECIMAL(data)}"),
    "ESP-IDF": lines(lambda data, i: f"I (1234{i}) sbus: {LOWER(data)}"),
    "ESP-IDF, coloured": lines(lambda data, i: f"\x1b[0;32mI (1234{i}) sbus: {LOWER(data)}\x1b[0m"),
    "ESP-IDF, hexdump": rows(ALL, 16, lambda at, row: f"I (12345) sbus: 0x{0x3ffb5000 + at:08x}   {LOWER(row):<48} |{ascii(row)}|"),
    "Zephyr": lines(lambda data, i: f"[00:00:01.23{i},567] <inf> sbus: {LOWER(data)}"),
    "Zephyr, hexdump": "[00:00:01.234,567] <inf> sbus: data\n" + rows(ALL, 16, lambda at, row: " " * 31 + f"{LOWER(row[:8])}  {LOWER(row[8:]):<23} |{ascii(row[:8])} {ascii(row[8:])}|"),
    "numbered": lines(lambda data, i: f"{i + 1}) {UPPER(data)}"),
    "Wireshark": rows(ALL, 16, lambda at, row: f"{at:04x}  {LOWER(row[:8])}  {LOWER(row[8:])}   {ascii(row)}"),
    "HxD": "Offset(h) 00 01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0E 0F\n\n" + rows(ALL, 16, lambda at, row: f"{at:08X}  {UPPER(row):<47}  {ascii(row)}"),
    "offsets of four digits": rows(ALL, 16, lambda at, row: f"{at:04x}: {LOWER(row)}"),
    "offsets of four digits from 1000 on": rows(ALL, 16, lambda at, row: f"{0x1000 + at:04x}: {LOWER(row)}"),
    "gdb": rows(ALL, 8, lambda at, row: f"0x{0x20000000 + at:x}:\t" + "\t".join("0x%02x" % byte for byte in row)),
    "gdb, a string": lines(lambda data, i: f'${i + 1} = "{OCTAL(data)}"'),
    "strace": lines(lambda data, i: f'read(3, "{strace(data)}", 25) = 25'),
    "strace -xx": lines(lambda data, i: f'read(3, "{ESCAPED(data)}", 25) = 25'),
    "gdb with a name": rows(ALL, 8, lambda at, row: f"0x{0x20000000 + at:x} <frames+{at}>:\t" + "\t".join("0x%02x" % byte for byte in row)),
    "frames and CR LF": lines(lambda data, i: UPPER(data + b"\r\n")),
    "frames and zeros, as ArduPilot prints RCDA": lines(lambda data, i: COMMAS(data + bytes(15))),
    "frames and AA 55": lines(lambda data, i: UPPER(data + b"\xAA\x55")),
    "frames that end in 08, without their tail": lines(lambda data, i: UPPER(data[:-1] + b"\x08")),
    "frames and zeros in decimal": lines(lambda data, i: DECIMAL(data + bytes(7))),
    "a number and a length": lines(lambda data, i: f"{16 + i // 2} 25 {UPPER(data)}"),
    "a clock and a comma": lines(lambda data, i: f"2026-11-24 15:16:{16 + i},{UPPER(data)}"),
    "a clock and a semicolon": lines(lambda data, i: f"24.11.2026 15:16:{16 + i};{UPPER(data)}"),
    "a clock and a pipe, decimal": lines(lambda data, i: f"15:16:{16 + i} | {numbers('%d', ' ')(data)}"),
    "a count and commas, decimal": lines(lambda data, i: f"{1234 + 9 * i},{numbers('%d', ',')(data)}"),
    "zeros before frames": lines(lambda data, i: UPPER(bytes(1) + data)),
    "frames and CR LF, 16 a line": rows(b"".join(each + b"\r\n" for each in FRAMES), 16, lambda at, row: UPPER(row)),
    "C array in decimal over lines": "const uint8_t PACKETS[] = {\n" + rows(ALL, 5, lambda at, row: "    " + DECIMAL(row) + ",") + "};\n",
    "a numbered byte a line": "".join(f"[{i % 25}] = 0x{byte:02X}\n" for i, byte in enumerate(ALL)),
    "a number and a byte": "".join(f"{i:3} {byte:02X}\n" for i, byte in enumerate(ALL)),
    "seconds and a decimal byte": "".join(f"{12.345 + i // 25 * 0.009 + i % 25 * 0.00012:.6f} {byte}\n" for i, byte in enumerate(ALL)),
    "a terminal's log": "Terminal log file\nDate: 28.11.2026 - 06:10:46\n-----\n" + lines(UPPER) + "-----\nDate: 28.11.2026 - 06:10:52\nEnd log file\n",
    "socat -x": lines(lambda data, i: f"> 2026/11/24 15:16:17.{9000 * i:06}  length=25 from={25 * i} to={25 * i + 24}\n {LOWER(data)}\n--"),
    "candump": rows(ALL, 8, lambda at, row: f"  can0  123   [{len(row)}]  {UPPER(row)}"),
    "sigrok-cli -A uart=rx-data": "".join(f"uart-1: {byte:02X}\n" for byte in ALL),
    "0x and tabs": lines(numbers("0x%02X", "\t")),
}

# Frames that look like what they are not: sticks in the middle, values of 0, and two lines like offsets.
CENTRED = [bytes.fromhex("0FE5031FF8C0073EF0810F7CE00306F880913DF0810F7C0000")] * 4
ZEROS = [bytes.fromhex("0F" + "00" * 24)] * 4
GROWING = [bytes([each[0], 0x10 + 23 * (i == 1), *each[2:]]) for i, each in enumerate(FRAMES * 2)]
OTHERS = {
    "UltraEdit": (rows(b"".join(CENTRED), 16, lambda at, row: f"{at:08X}h: {UPPER(row):<47} ; {ascii(row)}"), CENTRED),
    "a dump with blank lines": (rows(b"".join(CENTRED), 16, lambda at, row: f"{at:08x}: {LOWER(row):<47}  {ascii(row)}\n"), CENTRED),
    "a numbered list, and then bytes": ("".join(f"{i}: 50\n" for i in range(26)) + lines(UPPER, FRAMES * 7), FRAMES * 7),
    "groups of four bytes": (lines(lambda data, i: data.hex(" ", -4), ZEROS), ZEROS),
    "lines that look like offsets once": (lines(lambda data, i: data.hex(" ", -2), GROWING), GROWING),
}

# What tools print, by the tools. {} is the file.
TOOLS = ["xxd {}", "xxd -c 25 {}", "xxd -c 7 {}", "xxd -g 1 {}", "xxd -g 4 {}", "xxd -u {}", "xxd -e {}", "xxd -e -g 2 {}", "xxd -e -g 8 -c 24 {}", "xxd -p {}", "xxd -ps -c 25 {}", "xxd -i {}",
         "hexdump -v -C {}", "hexdump -v {}", "hexdump -v -x {}", "hexdump -v -e '25/1 \"%02X \" \"\\n\"' {}",
         "od -v -x {}", "od -v -t x1 {}", "od -v -A x -t x1 {}", "od -v -A d -t x1 {}", "od -A n -v -t x1 {}", "od -An -v -tx1 -w25 {}"]


def frames_of(text, how):
    with open(f"{WORK}/ways.txt", "w", encoding="latin-1", newline="") as file:
        file.write(text)
    out = subprocess.run([SBUS, *how, "ways.txt", "--json"], cwd=WORK, capture_output=True, text=True)
    read = [json.loads(line) for line in out.stdout.splitlines()]
    return [each["channels"] for each in read if each["type"] == "frame"], out.stderr.strip()


def channels(raw):
    bits = int.from_bytes(raw[1:23], "little")
    return [bits >> 11 * i & 2047 for i in range(16)]


def main():
    ways = dict(WAYS) | {name: text for name, (text, _) in OTHERS.items()}
    for name, data in ("frames", ALL), ("a frame thrice", FRAMES[0] * 13), ("frame.bin", FRAMES[0]):
        with open(f"{WORK}/a.bin", "wb") as file:
            file.write(data)
        for tool in TOOLS:
            isPadded = name == "frame.bin" and tool in ("hexdump -v {}", "hexdump -v -x {}", "od -v -x {}")  # to whole words
            if shutil.which(tool.split()[0]) and not isPadded:
                ways[f"{tool.format('FILE')} of {name}"] = subprocess.run(tool.format("a.bin"), shell=True, cwd=WORK, capture_output=True, text=True, encoding="latin-1").stdout
    good = 0
    tried = 0
    for name, text in ways.items():
        if ONLY not in name:
            continue
        wanted = [channels(each) for each in OTHERS.get(name, ("", FRAMES))[1]]
        wanted = wanted[:1] * 13 if "thrice" in name else wanted[:1] if "frame.bin" in name else wanted
        got, err = frames_of(text, ["hex"])
        tried += 1
        # One number a line may be a voltage.
        said = subprocess.run([SBUS, "decode", "ways.txt"], cwd=WORK, capture_output=True, text=True).stderr
        if not name.startswith("one a line") and "is bytes, not a capture of the wire" not in said:
            print(f"FAILED sbus: decode says that bytes are no capture: {name}: {said.strip()}")
        good += got == wanted
        if got != wanted:
            print(f"  {len(got)} of {len(wanted)} frames, {sum(each in wanted for each in got)} right: {err[:200]}\n  " + text[:120].replace("\n", "\n  "))
        print(f"{'ok' if got == wanted else 'FAILED'} sbus: bytes are read as {name}")
    print(f"dumps: {good} of {tried} ways")


main()
