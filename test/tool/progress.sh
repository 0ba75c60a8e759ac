#!/bin/sh
# Tests that long work shows on a terminal how much of it is done, and says "ok ..." or "FAILED ...".
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

"$SBUS" record sim -o "$work/flight.txt" --simulated-time --seconds 2000 2>"$work/err"

# progress.py KIND ARGUMENTS...: standard error is a terminal. KIND "long": waits for the progress, and ends the program;
# "file": the program stops for 2 s while it reads the file that is the last argument, and then reads on to its end.
cat >"$work/progress.py" <<'END'
import os, pty, re, signal, subprocess, sys, time, tty
kind, *words = sys.argv[1:]
master, slave = pty.openpty()
tty.setraw(slave)
program = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=slave)
os.close(slave)
def reads():
    try:
        return any(os.readlink("/proc/%d/fd/%s" % (program.pid, fd)) == words[-1] for fd in os.listdir("/proc/%d/fd" % program.pid))
    except FileNotFoundError:
        return False
if kind == "file":
    while not reads():
        pass
    program.send_signal(signal.SIGSTOP)
    time.sleep(2.1)
    program.send_signal(signal.SIGCONT)
text = ""
while kind == "file" or not re.search(r"%|of the line", text):
    try:
        text += os.read(master, 4096).decode()
    except OSError:
        break
program.send_signal(signal.SIGTERM)
status = program.wait()
last = text.split("\r")
print(repr("|".join(last[:4])), status, "cleared" if kind == "file" and last[-2].strip() == "" and last[-1] == "" else "")
END
shows() {  # WANTED WHAT KIND ARGUMENTS...
  wanted=$1 what=$2
  shift 2
  got=$(timeout 120 python3 "$work/progress.py" "$@" 2>&1)
  printf '%s\n' "$got" | grep -qE "$wanted"
  verdict $? "$what: $got"
}
shows "[0-9]+ % done" "hex of a simulated year shows how much is done" long "$SBUS" hex sim --simulated-time --seconds 31536000
shows "[0-9]+ s of the line" "summary without an end shows how far it is" long "$SBUS" summary sim --simulated-time
shows "flight.txt: [0-9]+ % read.*0 cleared" "summary of a file shows how much is read, and removes it at the end" file "$SBUS" summary "$work/flight.txt"
shows "flight.txt: [0-9]+ % read.*0 cleared" "csv of a file likewise" file "$SBUS" csv "$work/flight.txt"
"$SBUS" summary "$work/flight.txt" >"$work/out" 2>"$work/err" && [ ! -s "$work/err" ]
verdict $? "nothing is shown where no terminal is"

# ---- What takes its time on purpose says so

! timeout 60 "$SBUS" send sim --seconds 0.1 >"$work/out" 2>"$work/err" &&
  grep -qxE "sbus send: no program has opened $(cat "$work/out") within 0.1 s; start the reader earlier, or leave --seconds out" "$work/err" || { cat "$work/err"; false; }
verdict $? "send to a pseudo-terminal without a reader ends after --seconds: $(tail -n 1 "$work/err")"
"$SBUS" hex sim --simulated-time --seconds 1 | cut -c 15-90 | python3 -c 'import sys; sys.stdout.buffer.write(bytes.fromhex(sys.stdin.read()))' >"$work/line.bin"
sh -c 'cat "$0" | "$1" hex -' "$work/line.bin" "$SBUS" >"$work/piped" 2>"$work/err"
grep -qx -- '-: bytes without times: times are not known, played as fast as a line' "$work/err" && [ "$(grep -c ' frame ' "$work/piped")" -eq 111 ]
verdict $? "bytes that come at once through a pipe play at the line's rate, which is said: $(cat "$work/err")"
