#!/bin/sh
# What one subcommand prints, another reads: JSON lines, rows of CSV, recordings; also while they are being written. Says
# "ok ..." or "FAILED ...".
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

# ---- A line comes back from JSON lines: its frames, telemetry, discarded bytes and times, to the tenth of a microsecond

same() {  # LINE WHAT COMMAND...: of $work/LINE.txt, standard input is JSON lines of it
  line=$1 what=$2
  shift 2
  "$SBUS" "$@" "$work/$line.txt" >"$work/wanted" 2>"$work/err"
  "$SBUS" "$@" - >"$work/came" 2>"$work/err"
  [ -s "$work/wanted" ] && cmp "$work/wanted" "$work/came"
  verdict $? "$* of $what of a line with $line"
}
for words in 16 24 32 sbus2 16,noise=30 24,noise=30 32,noise=30 sbus2,noise=30; do
  "$SBUS" record "sim:$words" -o "$work/$words.txt" --simulated-time --seconds 11 2>"$work/err"
  for command in hex 'hex --values' 'csv --every-frame --columns time,ch1-ch16,failsafe,lostframe,state' telemetry; do
    case $words$command in sbus2*) ;; *telemetry) continue ;; esac
    # shellcheck disable=SC2086  # a subcommand and its options
    "$SBUS" hex "$work/$words.txt" --json | same "$words" 'JSON lines' $command
  done
done
"$SBUS" hex "$work/sbus2.txt" >"$work/wanted" && "$SBUS" hex "$work/sbus2.txt" --json >"$work/line.json" && gzip -k "$work/line.json"
"$SBUS" hex "$work/line.json.gz" | cmp - "$work/wanted"
verdict $? "packed JSON lines are read from a file"

# ---- Rows that are frames

for line in 16 24; do
  channels=$([ $line = 16 ] && echo ch1-ch18 || echo ch1-ch24)
  "$SBUS" hex "$work/$line.txt" | grep 'frame.* end' >"$work/wanted"
  "$SBUS" csv "$work/$line.txt" --every-frame --header --columns "time,$channels,failsafe,lostframe" >"$work/rows.csv"
  [ "$("$SBUS" hex "$work/rows.csv" | grep -c 'frame.* end')" -eq "$(wc -l <"$work/wanted")" ] &&
    "$SBUS" csv "$work/rows.csv" --every-frame --columns "time,$channels" >"$work/came" &&
    "$SBUS" csv "$work/$line.txt" --every-frame --columns "time,$channels" | cmp - "$work/came"
  verdict $? "hex and csv read the rows of csv --every-frame of $line channels"
done

# ---- At any pace: the header's line, and the rows, may come in pieces

"$SBUS" csv sim --simulated-time --seconds 0.5 --every-frame --header --columns time,ch1-ch16 >"$work/paced.csv"
"$SBUS" csv "$work/paced.csv" --every-frame >"$work/wanted"
header=$(head -n 1 "$work/paced.csv" | wc -c)
# paced PLACES: writes the rows with a pause at each place, in bytes
paced() {
  at=0
  for place in "$@"; do
    tail -c +$((at + 1)) "$work/paced.csv" | head -c $((place - at))
    at=$place
    sleep 0.25
  done
  tail -c +$((at + 1)) "$work/paced.csv"
}
for places in "$header" "10 $header" "$((header + 30))" "$header $((header + 70)) $((header + 200))"; do
  # shellcheck disable=SC2086  # the places are words
  paced $places | timeout 60 "$SBUS" csv - --every-frame 2>"$work/err" | cmp - "$work/wanted" && [ "$(wc -l <"$work/wanted")" -gt 50 ] || { cat "$work/err"; false; }
  verdict $? "rows of frames are read at any pace: a pause after $places bytes"
done
(head -n 1 "$work/paced.csv"; sleep 0.25; echo 0.1,1500) | timeout 60 "$SBUS" csv - >"$work/out" 2>"$work/err"
[ $? -eq 1 ] && [ ! -s "$work/out" ]
verdict $? "rows of frames that end in the first one are an error: $(cat "$work/err")"

# ---- The end of a table: 99 may be a part of 992

"$SBUS" csv "$work/16.txt" --every-frame --header --columns time,ch1-ch16 --to 1 >"$work/whole.csv"
awk -F, 'NR > 1 { print $1 }' "$work/whole.csv" | sed '$d' >"$work/wanted"
head -c -2 "$work/whole.csv" >"$work/cut.csv"
head -c -1 "$work/whole.csv" >"$work/no-end.csv"
(cat "$work/whole.csv"; printf '#') >"$work/comment.csv"
for file in cut no-end; do
  for source in "$work/$file.csv" -; do
    "$SBUS" csv "$source" --every-frame --columns time <"$work/$file.csv" 2>"$work/err" | cmp - "$work/wanted" &&
      grep -qxF "sbus csv: $source:$(wc -l <"$work/whole.csv"): the file may be cut within this row: a line end is expected after it" "$work/err" || { cat "$work/err"; false; }
    verdict $? "a last row without a line end is no frame, but an error: $file.csv as ${source##*/}"
    cat "$work/$file.csv" | "$SBUS" csv - --every-frame --columns time 2>"$work/err" | cmp - "$work/wanted"
    verdict $? "a last row without a line end is no frame: $file.csv through a pipe"
  done
done
[ "$("$SBUS" csv "$work/comment.csv" --every-frame --columns time 2>"$work/err" | wc -l)" -eq $(($(wc -l <"$work/wanted") + 1)) ] && [ ! -s "$work/err" ]
verdict $? "a comment needs no line end"
printf 'CH1,CH2\n1,992\n2,992\n3,99' >"$work/sketch.csv"
"$SBUS" monitor "$work/sketch.csv" --simulated-time >"$work/out" && grep -q ' ok  2 992 ' "$work/out" && ! grep -q ' 3 99 ' "$work/out" &&
  "$SBUS" record "$work/sketch.csv" -o - 2>"$work/err" | grep -c ,99 | grep -qx 2
verdict $? "a sketch's last row without a line end is not shown, and not recorded"

# ---- While it is being written: each frame has passed all stages before the next one is sent

live() {  # WHAT STAGES: from a pseudo-terminal, through STAGES, to csv
  python3 - "$SBUS" "$2" <<'END' >"$work/out" 2>"$work/err"
import os, select, subprocess, sys, time
from ports import Port, frame
sbus, stages = sys.argv[1:]
port = Port()
line = subprocess.Popen(["sh", "-c", stages.replace("PORT", port.name)], stdout=subprocess.PIPE, env=dict(os.environ, SBUS=sbus))
# Sends a frame. Returns true once it has passed, and false if it has not done so in time.
def passes(raw, seconds):
    global text
    end = time.monotonic() + seconds
    port.write(frame(raw))
    while b"\n%d\n" % raw not in text:
        if not select.select([line.stdout], [], [], max(0, end - time.monotonic()))[0]:
            return False
        part = os.read(line.stdout.fileno(), 4096)
        if not part:
            sys.exit("the stages have ended")
        text += part
    return True
text = b"\n"
tries = 0
while not passes(999, 0.02):  # until all stages have begun, and are in sync
    tries += 1
    if tries > 3000:
        sys.exit("no frame passes")
passed, late = 0, []
for i in range(100):
    time.sleep(0.012)
    begin = time.monotonic()
    if passes(1000 + i, 3):
        passed += 1
        late.append(time.monotonic() - begin)
line.terminate()
late.sort()
print("%d of 100 frames before the next one; median %.2f ms" % (passed, 1000 * late[len(late) // 2] if late else -1))
sys.exit(passed < 90)
END
  status=$?
  [ $status -eq 0 ] || cat "$work/err"
  verdict $status "$1: $(cat "$work/out")"
}
# shellcheck disable=SC2016  # SBUS is set where they run
live 'hex --json, csv' '"$SBUS" hex --json PORT | "$SBUS" csv - --every-frame --columns ch1'
# shellcheck disable=SC2016
live 'hex --json, jq, csv' '"$SBUS" hex --json PORT | jq -c --unbuffered "select(.type == \"frame\") | .channels[1] = 1811" | "$SBUS" csv - --every-frame --columns ch1'
# shellcheck disable=SC2016
live 'record, csv' '"$SBUS" record PORT -o - | "$SBUS" csv - --every-frame --columns ch1'
# shellcheck disable=SC2016
live 'rows of csv, csv' '"$SBUS" csv PORT --every-frame --header --columns time,ch1-ch16 | "$SBUS" csv - --every-frame --columns ch1'

# ---- Errors

while IFS='|' read -r text message; do
  printf '%s\n' "$text" >"$work/x.json"
  (cd "$work" && timeout 60 "$SBUS" hex x.json) >"$work/out" 2>"$work/err"
  [ $? -eq 1 ] && grep -qxF "sbus hex: x.json:$message" "$work/err" || { cat "$work/err"; false; }
  verdict $? "JSON lines: $message"
done <<'END'
{"type":"frame"}|1: a frame has channels: an array of 16 numbers, or of 24
{"type":"frame","channels":[992]}|1: a frame has channels: an array of 16 numbers, or of 24
{"type":"frame","channels":[0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,2048]}|1: channels[15]: 2048 is not a whole number from 0 to 2047
{"type":"frame","channels":[0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,1.5]}|1: channels[15]: 1.5 is not a whole number from 0 to 2047
{"type":"frame","channels":[0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,"15"]}|1: channels[15]: "15" is not a whole number from 0 to 2047
{"type":"frame","channels":[0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15],"failsafe":"no"}|1: failsafe: "no" is not true or false
{"type":"frame","channels":[0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15],"first":2}|1: first: 2 is not 1, or 17 of a frame with header 2F
{"type":"frame","channels":[0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15],"end":4}|1: end: 4 is not an end byte in hexadecimal, such as "00"
{"type":"frame","channels":[0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15],"time_us":-1e99}|1: time_us: -1e+99 is not a time in microseconds
{"type":"slot","slot":32,"data":[1,2]}|1: a slot has slot, 0 to 31, and data, two numbers from 0 to 255
{"type":"no_frame","bytes":"0G"}|1: bytes: bytes in hexadecimal are expected, such as "0F E3"
{"type":frame}|1: "{"type":frame}" is not a JSON object; JSON lines as sbus hex --json writes them are expected
{"type":"end"}| has no frames; JSON lines as sbus hex --json writes them are expected
{"type":"frame"|1: "{"type":"frame"" is not a JSON object; JSON lines as sbus hex --json writes them are expected
END
rest=992,992,992,992,992,992,992,992,992,992,992,992,992,992,992
"$SBUS" csv "$work/16.txt" --every-frame --header --columns time,ch1-ch16,failsafe --to 1 >"$work/good.csv"
while IFS='|' read -r row message; do
  (cat "$work/good.csv"; echo "$row") >"$work/x.csv"
  (cd "$work" && timeout 60 "$SBUS" hex x.csv) >"$work/out" 2>"$work/err"
  [ $? -eq 1 ] && grep -qxF "sbus hex: x.csv:$(wc -l <"$work/x.csv"): $message" "$work/err" || { cat "$work/err"; false; }
  verdict $? "rows that are frames: $message"
done <<END
2,992|has 2 fields; 18 are expected
2,2048,$rest,0|"2048" is not a value for column 2; 0 to 2047 is expected
2,1.5,$rest,0|"1.5" is not a value for column 2; 0 to 2047 is expected
2,992,$rest,2|"2" is not a value for column 18; 0 or 1 is expected
soon,992,$rest,0|"soon" is not a value for column 1; a time in seconds is expected
0.5,992,$rest,0|its time is before that of the previous row
END
head -n 3 "$work/line.json" >"$work/two.json" && echo '["frame"]' >>"$work/two.json"
"$SBUS" hex "$work/two.json" >"$work/out" 2>"$work/err"
[ $? -eq 1 ] && [ "$(grep -c ' end ' "$work/out")" -ge 1 ] && grep -q ':4: "\["frame"\]" is not a JSON object' "$work/err"
verdict $? "the part before a wrong object is printed"

frames() {  # TIMES...: JSON lines
  for us in "$@"; do echo "{\"type\":\"frame\",\"time_us\":$us,\"channels\":[0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15]}"; done
}
frames 9000 18000 18500 30000 | "$SBUS" hex - 2>"$work/err" | cut -c1-12 | tr -d ' ' | tr '\n' ' ' >"$work/out"
[ "$(cat "$work/out")" = "0.009000 0.018000 0.021000 0.030000 " ] && [ "$(cat "$work/err")" = "-:3: its time, 18500 us, overlaps what comes before it: moved by 2500 us, and others may be" ] || { cat "$work/out" "$work/err"; false; }
verdict $? "a frame that overlaps the one before it is moved, and a message says so"
frames 20000000 9000 | "$SBUS" hex - >"$work/out" 2>"$work/err"
[ $? -eq 1 ] && grep -qxF 'sbus hex: -:2: its time, 9000 us, is not after the previous one, 20000000 us' "$work/err"
verdict $? "a time of another line is an error"

# ---- When it was

"$SBUS" record sim -o "$work/dated.txt" --seconds 0.2 2>"$work/err"
grep -qE '^# format 1, began 20[0-9]{2}-[01][0-9]-[0-3][0-9]T[0-2][0-9]:[0-5][0-9]:[0-5][0-9]\.[0-9]{6}Z$' "$work/dated.txt" &&
  [ "$(sed -n 's/^# format 1, began //p' "$work/dated.txt")" = "$("$SBUS" hex "$work/dated.txt" --json | sed -n '1s/.*"start":"\([^"]*\)".*/\1/p')" ]
verdict $? "a recording has its date, and hex --json repeats it"
"$SBUS" record "$work/dated.txt" -o "$work/copy.txt" 2>"$work/err" && grep -v '^# sbus' "$work/dated.txt" >"$work/wanted" &&
  grep -v '^# sbus' "$work/copy.txt" | cmp - "$work/wanted"
verdict $? "a copy of a recording keeps its date"
! "$SBUS" hex recordings/paper.txt --json | grep -q '"start"'
verdict $? "a recording without a date has none"

# ---- A long recording costs no memory: ten hours, 340 MB

if [ "${LONG:-}" ]; then hours=10; else hours=1; fi
python3 - "$work/16.txt" "$work/long.txt" $hours <<'END'
import sys
lines = [line.split(" ", 1) for line in open(sys.argv[1]) if line[0] != "#"]
with open(sys.argv[2], "w") as out:
    at = 0
    while at < int(sys.argv[3]) * 3600e6:
        out.writelines("%d %s" % (at + int(time), rest) for time, rest in lines)
        at += 11000000
END
short=$(peak hex "$work/16.txt")
for command in hex 'csv --every-frame' 'hex --from 3000 --to 3001'; do
  # shellcheck disable=SC2086  # a subcommand and its options
  long=$(peak $command "$work/long.txt")
  [ "$long" -lt $((short + 4096)) ]
  verdict $? "$command of $hours h of $(($(wc -c <"$work/long.txt") / 1000000)) MB: $long KB, of 11 s: $short KB"
done
rm "$work/long.txt"
