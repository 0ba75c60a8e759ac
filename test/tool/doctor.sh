#!/bin/sh
# Runs `sbus doctor` on each line of verdicts/LINES, and on ports, and says "ok ..." or "FAILED ...".
set -u
cd "$(dirname "$0")/.." || exit 1

. tool/common.sh

# agree FILE LINE: the frames a second and the frame interval in us agree, within a frame a second; four LINES lack up to 5 %
agree() {
  case $2 in *flipped.txt | *80ms-missing.txt | *16to24.txt | *24to16.txt) lacks=1.05 ;; *) lacks=1 ;; esac
  awk -v lacks=$lacks '/ frames a second and 0 damaged, / {
    for (i = 1; i < NF; i++) { if ($(i + 1) == "frames") rate = $i; if ($i == "interval") us = $(i + 1) }
    if (rate > 1e6 / us + 1 || rate * lacks < 1e6 / us - 1) { print; exit 1 }
  }' "$1"
}

# heard STATUS FINDING FIGURES ARGUMENTS...: three lines say the finding, the remedy and the figures
heard() {
  wanted=$1 finding=$2 figures=$3
  shift 3
  timeout 60 "$SBUS" doctor "$@" >"$work/doctor.out" 2>"$work/doctor.err" </dev/null
  [ $? -eq "$wanted" ] && [ ! -s "$work/doctor.err" ] && grep -A 1 "^$finding" "$work/doctor.out" | sed -n '2s/./&/p' | grep -q . &&
    if [ "$figures" = - ]; then ! grep -q 'frames a second' "$work/doctor.out"; else grep -q "^$figures" "$work/doctor.out"; fi && agree "$work/doctor.out" "$*"
}

asked() {
  heard "$@"
  status=$?
  [ $status -eq 0 ] || cat "$work/doctor.out" "$work/doctor.err"
  shift 3
  verdict $status "doctor $* finds: $finding"
}

# A busy PC may hold up the player at a port, and the line is silent then: one of three tries must succeed.
asked_live() {
  heard "$@" || heard "$@" || { asked "$@"; return; }
  shift 3
  verdict 0 "doctor $* finds: $finding"
}

summarised() {  # WORDS, of $arguments
  "$SBUS" summary "$work/${arguments#WORK/}" 2>&1 | grep -q "$1"
}

verdicts/lines.sh "$work"
grep -v '^#' verdicts/LINES >"$work/lines"
while IFS='|' read -r finding well figures by arguments; do
  case $by in *s*) ;; *) continue ;; esac
  case $arguments in sim*) arguments="$arguments --simulated-time" ;; esac
  [ "$well" = yes ] && status=0 || status=1
  # shellcheck disable=SC2086,SC2046  # the arguments are words
  asked $status "$finding" "$figures" $(echo "$arguments" | sed "s,WORK,$work,")
  case $arguments:$finding in
    WORK*:All*) ! summarised '^finding' ;;
    WORK*:Long* | WORK*:Noise* | WORK*:"No parity"* | WORK*:Wrong\ idle* | WORK*:Not*) summarised "$finding" ;;
    *) continue ;;
  esac
  verdict $? "summary of $arguments agrees: $finding"
done <"$work/lines"

# flight PERIOD_MS: 100 frames, of which each 29th has a header 2F, as noise makes it of 0F
flight() {
  awk -v ms="$1" 'BEGIN {
    for (i = 1; i <= 100; i++) print 1000 * ms * i, (i % 29 == 20 ? "2F" : "0F"), "E5 03 1F F8 C0 07 3E F0 81 0F 7C E0 03 06 F8 80 91 3D F0 81 0F 7C 00 00"
  }' >"$work/flight.txt"
}
flight 20  # the 50th comes just before the line of 1 s
"$SBUS" monitor "$work/flight.txt" --simulated-time >"$work/monitor" && [ "$(grep -cE '^[12]\.000  ok( +[0-9]+){16}   quality' "$work/monitor")" -eq 2 ] || { cat "$work/monitor"; false; }
verdict $? "monitor shows 16 channels after a header 2F that does not come again soon"
[ "$("$SBUS" csv "$work/flight.txt" --every-frame --columns ch1,ch17 | sort -u)" = 997,0 ]
verdict $? "csv has CH17 as a switch after such a header"
! "$SBUS" csv "$work/flight.txt" --every-frame --columns ch19 >"$work/out" 2>&1 && grep -q 'ch19 is missing: this line ends at ch18' "$work/out"
verdict $? "csv has no CH19 then"
"$SBUS" doctor "$work/80ms-missing.txt" | grep -qx 'With its 80 ms: setTimeout(250)'
verdict $? "doctor tells the timeout for a long period"

player send sim
asked_live 0 'All well.' 'S.BUS: 1[01][0-9] frames a second' "$terminal"
grep -qx 'This port does not tell how long it holds bytes back: gaps shorter than 19 ms are not seen.' "$work/doctor.out"
verdict $? "doctor says which gaps are not seen at a port"
kill $player
player send sim:silent
asked 1 'No signal:' - "$terminal"
kill $player
for _ in 1 2 3 4 5; do cat golden/AllChannels.csv; done >"$work/board.csv"  # longer than doctor listens
player send "$work/board.csv" --rows
asked 1 'Rows of CSV:' - "$terminal"
kill $player

# A user who is not root may be denied a port: by mode 000, or by a program that has it exclusively (TIOCEXCL).
folder=$(mktemp -d)
chmod 755 "$folder"
install -m 755 "$SBUS" "$folder/sbus"
as_user() {
  if [ "$(id -u)" -eq 0 ]; then setpriv --reuid=nobody --regid=nogroup --clear-groups "$@"; else "$@"; fi
}
player send sim
"$SBUS" hex "$terminal" >"$work/reader" 2>&1 &
reader=$!
until_true has_lines 1 "$work/reader"
"$SBUS" doctor "$terminal" 2>&1 | grep -qx "sbus doctor: $terminal: in use; close the other program that has it open"
verdict $? "doctor says that a pseudo-terminal is in use if another sbus reads it"
kill $reader
wait $reader
chmod 000 "$terminal"
as_user "$folder/sbus" doctor "$terminal" 2>"$work/err"
[ $? -eq 1 ] && grep -q "^sbus doctor: $terminal: no permission; \(join the group\|a udev rule\)" "$work/err"
verdict $? "doctor says how to get permission for a port"
chmod 666 "$terminal"
perl -e 'open(P, "+<", $ARGV[0]) && ioctl(P, 0x540C, 0) && print("mine\n") && close(STDOUT) && sleep(60)' "$terminal" >"$work/mine" &
owner=$!
until_true has_lines 1 "$work/mine"
as_user "$folder/sbus" doctor "$terminal" 2>"$work/err"
[ $? -eq 1 ] && grep -qx "sbus doctor: $terminal: in use; close the other program that has it open" "$work/err"
verdict $? "doctor says that a port is in use if another program has it exclusively"
kill $owner $player
rm -r "$folder"
"$SBUS" doctor /dev/no-such-port 2>&1 >/dev/null | grep -q 'there is no such port; plug the adapter in'
verdict $? "doctor says that a port does not exist"

# ---- A port with another protocol, or with frames that come seldom

cat >"$work/other.py" <<'END'
import subprocess, sys, time
from ports import Port
port = Port()
program = subprocess.Popen([sys.argv[1], "doctor", port.name], stdout=subprocess.PIPE, text=True)
while program.poll() is None:
    port.write(bytes.fromhex(sys.argv[2]))
    time.sleep(float(sys.argv[3]))
print(program.returncode, *program.stdout.read().split("\n")[-6:-2])
END
while IFS='|' read -r packet seconds wanted; do
  got=$(timeout 60 python3 "$work/other.py" "$SBUS" "$packet" "$seconds" 2>&1)
  case $got in "1 "*"$wanted"*) true ;; *) echo "$got"; false ;; esac
  verdict $? "doctor of a port with other packets: $got"
done <<'END'
20 40 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 51 F3|0.007|Not S.Bus: the receiver sends i-BUS, FlySky's protocol.
C8 18 16 E0 03 DF F7 C0 C7 0A F0 81 0F 7C E0 03 1F F8 C0 07 3E F0 81 0F 7C 41|0.007|Not S.Bus: the receiver sends CRSF
0F E5 03 1F F8 C0 07 3E F0 81 0F 7C E0 03 06 F8 80 91 3D F0 81 0F 7C 00 00|0.13|Long period: the link is stale
0F E5 03 1F F8 C0 07 3E F0 81 0F 7C E0 03 06 F8 80 91 3D F0 81 0F 7C 00 00|0.2|Long period: the link is stale
END
