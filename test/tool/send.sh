#!/bin/sh
# Tests what `sbus send` sends on pseudo-terminals, and says "ok ..." or "FAILED ...".
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

# sent ARGUMENTS...: what a port gets from `send`, as rows of all channels and flags in $work/rows. STOP=bytes: interrupts
# it after this many.
sent() {
  python3 - "$work/port.bin" "$SBUS" send "$@" 2>"$work/err" <<'END'
import os, subprocess, sys
from ports import Port
port = Port()
sender = subprocess.Popen(sys.argv[2:] + ["--port", port.name])
stop = int(os.environ.get("STOP", "0"))
got, part = b"", b""
while part or sender.poll() is None:
    part = port.read(0.1)
    got += part
    if stop and len(got) >= stop and sender.poll() is None:
        stop = sender.send_signal(2)
open(sys.argv[1], "wb").write(got)
sys.exit(sender.returncode)
END
  [ $? -eq 0 ] && grep -q "^$(wc -c <"$work/port.bin") characters sent$" "$work/err" &&
    "$SBUS" csv "$work/port.bin" --every-frame --columns ch1-ch18,failsafe,lostframe 2>"$work/note" | tr -d '\r' >"$work/rows"
}

# constant FRAMES ROW ARGUMENTS...: FRAMES frames, all of them ROW
constant() {
  frames=$1 row=$2
  shift 2
  sent "$@" --seconds 0.5 && [ "$(sort -u "$work/rows")" = "$row" ] && [ "$(wc -l <"$work/rows")" -eq "$frames" ]
  status=$?
  [ $status -eq 0 ] || { wc -l "$work/rows"; head -n 3 "$work/rows"; cat "$work/err"; }
  verdict $status "send $* sends its row"
}
rest=992,992,992,992,992,992,992,992,992,992,992,992
constant 56 992,992,0,992,$rest,0,0,0,0 ch3=0
constant 56 0,992,172,1811,$rest,0,1,0,1 ch4=on CH1=0 ch18=on lostframe=on
constant 56 992,1312,992,1811,$rest,0,0,0,0 ch2=1700us ch3=0% ch4=100%
constant 56 352,1696,1024,992,$rest,0,0,0,0 ch1=-100% ch2=on ch3=0% --range futaba
constant 56 172,992,2047,992,$rest,1,0,1,0 ch1=off ch3=2047 failsafe=on ch17=1
constant 17 992,993,172,992,$rest,0,0,0,0 ch2=993 --period 30
constant 125 992,993,172,992,$rest,0,0,0,0 ch2=993 --period 4 --baud 200000
STOP=1000 sent ch1=1000 && [ "$(sort -u "$work/rows")" = "1000,992,172,992,$rest,0,0,0,0" ] && [ "$(wc -l <"$work/rows")" -ge 40 ]
verdict $? "send ends with Ctrl-C"

record_for 0.5 ch1=1000
player send "$lasting"
"$SBUS" record "$terminal" -o "$work/terminal.txt" 2>"$work/note" && wait $player &&
  grep -v '^#' "$work/terminal.txt" | tr ' ' '\n' | grep -vc '~\|...' | grep -qx 1400
verdict $? "send without a port creates a pseudo-terminal"

# ---- Errors

while IFS='|' read -r arguments message; do
  # shellcheck disable=SC2086  # the arguments are words
  timeout 20 "$SBUS" send $arguments </dev/null >"$work/out" 2>"$work/err"
  [ $? -ne 0 ] && grep -qxFe "$message" "$work/err" && [ ! -s "$work/out" ] || { cat "$work/err"; false; }
  verdict $? "send says: $message"
done <<'END'
|SOURCE is required
golden/AllChannels.csv|sbus send: golden/AllChannels.csv: these are rows of CSV, but no frames: a time, all of CH1 to CH16, CH24 or CH32 as raw values from 0 to 2047, and rows at most 50 ms apart are expected; sbus monitor shows other rows
-|sbus send: -: is empty: bytes of a line are expected
no.csv|sbus send: no.csv: cannot be opened (No such file or directory); the name of a recording is expected
recordings/paper.txt ch1=5|ch1=5 is unexpected; only values such as ch3=172 ch5=on may be several
ch19=5|"ch19=5" sets nothing; ch1=VALUE to ch18=VALUE, failsafe=on and lostframe=on do
ch0=5|"ch0=5" sets nothing; ch1=VALUE to ch18=VALUE, failsafe=on and lostframe=on do
time=5|"time=5" sets nothing; ch1=VALUE to ch18=VALUE, failsafe=on and lostframe=on do
ch1=2048|"ch1=2048" is out of range; 0 to 2047, a pulse such as 1500us, a part such as -50%, on (1811) or off (172) is expected
ch1=1e3|"ch1=1e3" is out of range; 0 to 2047, a pulse such as 1500us, a part such as -50%, on (1811) or off (172) is expected
ch1=5.5|"ch1=5.5" is out of range; 0 to 2047, a pulse such as 1500us, a part such as -50%, on (1811) or off (172) is expected
ch1=800us|"ch1=800us" is out of range; 0 to 2047, a pulse such as 1500us, a part such as -50%, on (1811) or off (172) is expected
ch1=5 ch1=6|"ch1=6" sets ch1 twice; leave one of them out
ch5=1 ch05=2|"ch05=2" sets nothing; ch1=VALUE to ch18=VALUE, failsafe=on and lostframe=on do
failsafe=on FAILSAFE=off|"FAILSAFE=off" sets failsafe twice; leave one of them out
ch1=|"ch1=" is out of range; 0 to 2047, a pulse such as 1500us, a part such as -50%, on (1811) or off (172) is expected
ch17=2|"ch17=2" is out of range; on or off is expected
ch1=5 --period 3|--period: a frame takes 3 ms (1.5 ms at 200000 baud), and a gap follows; a longer period is expected
END
! timeout 60 "$SBUS" send sim --seconds 0.1 >"$work/out" 2>"$work/err" &&
  grep -qxE "sbus send: no program has opened $(cat "$work/out") within 0.1 s; start the reader earlier, or leave --seconds out" "$work/err" || { cat "$work/err"; false; }
verdict $? "send to a pseudo-terminal without a reader ends after --seconds: $(tail -n 1 "$work/err")"
: | timeout 20 "$SBUS" send - >"$work/out" 2>"$work/err"
[ $? -eq 1 ] && grep -qxF 'sbus send: -: is empty: bytes of a line are expected' "$work/err" && [ ! -s "$work/out" ]
verdict $? "send says that a pipe has brought nothing: $(tail -n 1 "$work/err")"
