#!/bin/sh
# Tests the recordings that `sbus watch` makes of events, and says "ok ..." or "FAILED ...".
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

watch() { timeout 60 "$SBUS" watch "$@" 2>"$work/err"; }

# Prints the events as "begin 1.000 end 2.000".
events() { awk '{ printf "%s %s ", $3, $1 }'; }

# ---- Conditions, whose language is tested in host/ConditionTest: frame i of 1000 ends at 9 ms * i, and has CH1 = i; CH17 is on from 300 on; frames 401 to 410 are lost, 501
# to 510 in failsafe; 0.5 s pass before frame 701. The end of a file is no silence.

awk 'BEGIN { for (i = 1; i <= 1000; i++) printf "{\"type\":\"frame\",\"time_us\":%d,\"channels\":[%d,992,172,992,992,992,992,992,992,992,992,992,992,992,992,992],\"ch17\":%d,\"lost_frame\":%d,\"failsafe\":%d}\n", i * 9000 + (i > 700) * 500000, i, (i >= 300), (i > 400 && i <= 410), (i > 500 && i <= 510) }' >"$work/flight.json"
while IFS='|' read -r condition wanted; do
  rm -rf "$work/dir"
  got=$(watch "$work/flight.json" --when "$(echo "$condition" | tr '/' '|')" -o "$work/dir" --after 0 | events)
  [ "$got" = "$wanted" ] || { echo "$got"; cat "$work/err"; false; }
  verdict $? "$(echo "$condition" | tr '/' '|'): $wanted"
done <<'END'
failsafe|begin 4.509 end 4.599 
lostframe|begin 3.609 end 3.699 
lossy|begin 3.690 end 4.509 
stale|begin 6.400 end 6.809 
ch17|begin 2.700 end 9.500 
!ok|begin 3.690 end 4.790 begin 6.400 end 6.809 
ch1!=2 && ch1<4|begin 0.009 end 0.018 begin 0.027 end 0.036 
ch1>1498us|begin 9.410 end 9.500 
ch24>0|
age>50ms|begin 6.351 end 6.809 
quality<95 && ch1<600|begin 3.645 end 5.400 
failsafe // ch1<3 && ch17|begin 4.509 end 4.599 
END

rm -rf "$work/dir"
watch "$work/flight.json" --when 'ch1==500 || ch1==600' -o "$work/dir" --before 0 --after 0 >"$work/out"
[ "$("$SBUS" csv "$work/dir/sbus-000002.txt" --every-frame --columns ch1 | tr '\n' ' ')" = "600 601 " ] && "$SBUS" summary "$work/dir/sbus-000002.txt" | grep -q ' 0 discarded bytes'
verdict $? "with --before 0 a recording begins with the event's frame"
rm -rf "$work/dir"
watch "$work/flight.json" --when 'ch1==500 || ch1==600' -o "$work/dir" --before 600 --after 0 >"$work/out"
[ "$(cat "$work"/dir/*.txt >"$work/all.txt"; "$SBUS" csv "$work/all.txt" --every-frame --columns ch1)" = "$(seq 601)" ]
verdict $? "no frame is missing between the recordings of two events"
rm -rf "$work/dir"
(ulimit -f 8; timeout 60 "$SBUS" watch "$work/flight.json" --when 'failsafe || ch1==900' -o "$work/dir" --before 3 --after 0 >"$work/out" 2>"$work/err")
[ $? -eq 1 ] && grep -q 'could not be written' "$work/err" && [ "$("$SBUS" hex "$work/dir/sbus-000001.txt" 2>&1 | grep -c ' frame ')" -gt 20 ] && "$SBUS" hex "$work/dir/sbus-000002.txt" | grep -q ' frame '
verdict $? "a limit on file size ends a recording like a full disk; the next event has one again"

while IFS='|' read -r condition message; do
  watch sim --when "$condition" -o "$work/none" >"$work/out"
  [ $? -eq 2 ] && [ "$(head -n 1 "$work/err")" = "--when: \"$condition\": at character $message is expected" ] && [ ! -d "$work/none" ] || { cat "$work/err"; false; }
  verdict $? "--when \"$condition\": at character $message is expected"
done <<'END'
|1 a channel such as ch5, failsafe, nopulses, lostframe, rejected, jump, ok, lossy, stale, state, age, quality, ! or (
failsafe && ch33>1|13 a channel from ch1 to ch32
quality<x|9 a number of percent
END

# ---- What is in a file

rm -rf "$work/dir"
watch "$work/flight.json" --when 'failsafe' -o "$work/dir" --before 1 --after 2 >"$work/out"
"$SBUS" hex "$work/flight.json" | awk '$1 - 0.003 >= 3.509 && $1 <= 6.6' >"$work/part"
"$SBUS" hex "$work/dir/sbus-000001.txt" >"$work/hex"
[ "$(sed -n 1p "$work/hex")" = "$(sed -n 1p "$work/part")" ] && [ "$(tail -n 1 "$work/hex")" = "$(grep '^ *6.300000' "$work/part")" ] &&
  ! grep -vxFf "$work/part" "$work/hex" && ! grep -q ' - ' "$work/hex"
verdict $? "a file has whole frames, from --before to --after: $(wc -l <"$work/hex") frames"
rm -rf "$work/dir"
watch "$work/flight.json" --when 'lostframe || failsafe' -o "$work/dir" --after 1 | events >"$work/out"
[ "$(cat "$work/out")" = "begin 3.609 end 5.599 " ] && [ "$(ls "$work/dir")" = sbus-000001.txt ]
verdict $? "an event within --after continues in the same file: $(cat "$work/out")"
rm -rf "$work/dir"
watch "$work/flight.json" --when ch17 -o "$work/dir" --longest 2 --before 0.1 >"$work/out"
for file in "$work"/dir/*; do "$SBUS" csv "$file" --every-frame --columns ch1; done >"$work/values"
seq 290 1000 | diff - "$work/values" && [ "$(grep -c continued "$work/out")" -eq 3 ]
verdict $? "a long event continues in other files, without a gap: $(ls "$work/dir" | wc -l) files"

record_for 14 sim
player send "$lasting"
"$SBUS" watch "$terminal" --when failsafe -o "$work/dated" --before 1 --after 0.5 --json >"$work/json" 2>"$work/err"
wait "$player"
file=$(ls "$work"/dated/*)
began=$(sed -n 's/^# format 1, began //p' "$file")
[ "$(sed -n 's/.*"kind":"begin".*"file":"\(.*\)"}/\1/p' "$work/json")" = "$file" ] && [ "$work/dated/sbus-000001-$(echo "${began%.*}" | tr : -)Z.txt" = "$file" ] &&
  [ "$(sed -n 's/^\([0-9][0-9]*\).*/\1/p' "$file" | head -n 1)" -lt 20000 ] && [ "$(grep -c '"event"' "$work/json")" -eq 2 ]
verdict $? "a port's file has a date in its name and in its head, and its times count from it: ${file##*/}"
python3 - "$work/json" "$file" <<'END'
import json, sys, datetime
read = lambda text: datetime.datetime.strptime(text, "%Y-%m-%dT%H:%M:%S.%fZ")
head = [line.split(", began ")[1].strip() for line in open(sys.argv[2]) if ", began " in line][0]
events = [json.loads(line) for line in open(sys.argv[1])]
begin, end = [e for e in events if e["type"] == "event"]
before = (read(begin["date"]) - read(head)).total_seconds()
start = (read(begin["date"]) - read(events[0]["start"])).total_seconds()
sys.exit(not (0.9 < before < 1.5 and abs(start - begin["time_us"] / 1e6) < 1e-4 and end["kind"] == "end" and end["file"] == begin["file"]))
END
verdict $? "the event is --before after the file's date"

# pieces FRAMES ARGUMENTS...: watches a port that delivers numbered frames in pieces, like an adapter: CH1 is the number, CH2 is
# 2000 in each fourth group of ten
pieces() {
  rm -rf "$work/dir"
  python3 - "$SBUS" "$work/dir" "$@" >"$work/out" 2>"$work/err" <<'END'
import subprocess, sys, time
from ports import Port, frame
port = Port()
sbus, folder, count = sys.argv[1:4]
watch = subprocess.Popen([sbus, "watch", port.name, "-o", folder] + sys.argv[4:])
time.sleep(1)
line = b"".join(frame(n, 2000 if n // 10 % 4 == 3 else 0) for n in range(1, int(count) + 1))
start = time.monotonic()
for at in range(0, len(line), 44):  # every 16 ms, whatever a frame's end is
    time.sleep(max(0, start + at / 44 * 0.016 - time.monotonic()))
    port.write(line[at:at + 44])
time.sleep(0.2)
watch.send_signal(2)
watch.wait()
END
}
pieces 600 --when 'ch1>0' --longest 1 --before 1
# ends: the first and the last line of each file that are no frames; a busy PC may tear frames apart elsewhere
ends() { for file in "$work"/dir/*; do "$SBUS" hex "$file" | sed -n '1p;$p'; done | grep -c ' - '; }
for file in "$work"/dir/*; do "$SBUS" csv "$file" --every-frame --columns ch1 | sed -n '1p;$p'; done | tr '\n' ' ' >"$work/seams"
[ "$(ends)" -eq 0 ] && [ "$(grep -c continued "$work/out")" -ge 4 ] &&
  awk '{ for (i = 2; i < NF; i += 2) bad += $(i + 1) != $i + 1; exit bad || $1 != 1 || $NF != 600 }' "$work/seams"
verdict $? "if a port delivers pieces of frames, a file still goes on in the next one: $(cat "$work/seams")"
pieces 400 --when 'ch2>1000' --before 0.02 --after 0.02
[ "$(ls "$work/dir" | wc -l)" -eq 10 ] && [ "$(ends)" -eq 0 ]
verdict $? "its events begin and end between two frames: $(ls "$work/dir" | wc -l) events"

# Eight receivers of one transmitter have the same events at the same time.
rm -rf "$work/dir"
python3 - "$SBUS" "$work/dir" >"$work/out" 2>"$work/err" <<'END'
import subprocess, sys, time
from ports import Port, frame
ports = [Port() for _ in range(8)]
watches = [subprocess.Popen([sys.argv[1], "watch", port.name, "--when", "ch1>1000", "-o", sys.argv[2], "--before", "0", "--after", "0"],
                            stdout=subprocess.PIPE, text=True) for port in ports]
for raw in range(600):
    for port in ports:
        port.write(frame(raw // 20 % 2 * 1500))
    time.sleep(0.009)
for watch in watches:
    watch.send_signal(2)
    print("".join(line.split("/")[-1] + "\n" for line in watch.communicate()[0].splitlines() if " begin " in line), end="")
END
[ "$(wc -l <"$work/out")" -ge 40 ] && [ -z "$(sort "$work/out" | uniq -d)" ] || { sort "$work/out" | uniq -d; cat "$work/err"; false; }
verdict $? "eight watches of one folder never share a file: $(wc -l <"$work/out") events"

# ---- The disk

# How often watch has called fsync() while 2 s of a port came: one is for the folder, one at the end.
printf '%s\n' '#include <stdio.h>' 'extern "C" int fsync(int) { return puts("fsync") < 0; }' |
  g++ -shared -fPIC -x c++ - -o "$work/fsync.so"
rm -rf "$work/dir"
syncs=$(ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD="$work/fsync.so" timeout 60 "$SBUS" watch sim --seconds 2.5 --when 'ch1>0' -o "$work/dir" 2>"$work/err" | grep -c fsync)
[ "$syncs" -ge 3 ] && [ "$syncs" -le 5 ]
verdict $? "a file is written to the disk itself once a second"
"$SBUS" record sim -o "$work/whole.txt" --simulated-time --seconds 2 2>"$work/err"
frames=$("$SBUS" hex "$work/whole.txt" | grep -c ' frame ')
for at in 5000 9000 end; do
  python3 - "$work/whole.txt" "$work/nul.txt" $at <<'END'
import sys
text = open(sys.argv[1], "rb").read()
at = len(text) if sys.argv[3] == "end" else int(sys.argv[3])
open(sys.argv[2], "wb").write(text[:at] + bytes(700) + text[at + 700:])
END
  got=$("$SBUS" hex "$work/nul.txt" 2>"$work/err" | grep -c ' frame ')
  [ "$got" -ge $((frames - 13)) ] && [ "$got" -le "$frames" ] &&
    grep -qxF "$work/nul.txt: 700 NULs were left out, and the lines that they cut: did the power fail?" "$work/err" || { cat "$work/err"; false; }
  verdict $? "NULs at $at in a recording are read around: $got of $frames frames"
done

# ---- Rotation

rm -rf "$work/dir"
mkdir "$work/dir"
touch "$work/dir/sbus-000007-2020-01-01T00-00-00Z.txt" "$work/dir/sbus-notes.txt" "$work/dir/other.txt" "$work/dir/sbus-000001.txt.gz"
watch "$work/flight.json" --when 'ch1<10 || ch1>100 && ch1<110 || ch1>200 && ch1<210 || ch1>300 && ch1<310' -o "$work/dir" --before 0 --after 0 --most 0.00240 >"$work/out"
[ "$(ls "$work/dir" | paste -sd ' ')" = "other.txt sbus-000001.txt.gz sbus-000009.txt sbus-000010.txt sbus-000011.txt sbus-notes.txt" ]
verdict $? "--most 0.00240 keeps the newest, and other files: $(ls -s "$work/dir" | paste -sd ' ')"
rm -rf "$work/dir"
mkdir "$work/dir"
touch "$work/dir/sbus-999998.txt"
watch "$work/flight.json" --when 'ch1<10 || ch1>100 && ch1<110 || ch1>200 && ch1<210' -o "$work/dir" --before 0 --after 0 --most 0.00146 >"$work/out" &&
  [ "$(ls "$work/dir" | paste -sd ' ')" = "sbus-1000000.txt sbus-1000001.txt" ]
verdict $? "numbers go on after 999999: $(ls "$work/dir" | paste -sd ' ')"
rm -rf "$work/dir"
watch sim --simulated-time --seconds 100 --when failsafe -o "$work/dir" --most 0.2 >"$work/out"
[ "$(grep -c begin "$work/out")" -eq 6 ] && [ "$(ls "$work/dir" | paste -sd ' ')" = "sbus-000004.txt sbus-000005.txt sbus-000006.txt" ]
verdict $? "--most 0.2 removes the oldest until there are 0.2 MB: $(du -bc "$work"/dir/* | tail -n 1 | cut -f1) bytes"

# ---- Whatever happens

player send sim
"$SBUS" watch "$terminal" --when 'ch1>0' -o "$work/killed" >"$work/out" 2>"$work/err" &
watcher=$!
is_long() { [ "$(cat "$work"/killed/* 2>/dev/null | wc -l)" -gt 100 ]; }
until_true is_long
kill -KILL $watcher
wait $watcher 2>/dev/null
kill -INT "$player"
wait "$player"
[ -z "$(tail -c 1 "$work"/killed/*)" ] && "$SBUS" hex "$work"/killed/* >"$work/hex" && [ "$(grep -c ' frame ' "$work/hex")" -ge 90 ]
verdict $? "a file is whole after SIGKILL: $(grep -c ' frame ' "$work/hex") frames"
(trap '' XFSZ; ulimit -f 16; "$SBUS" watch sim --simulated-time --seconds 40 --when failsafe -o "$work/full") >"$work/out" 2>"$work/err"
[ $? -eq 1 ] && [ "$(grep -c 'sbus-00000[12].txt: could not be written completely (File too large); what was written before is valid' "$work/err")" -eq 2 ] &&
  [ "$(tail -n 1 "$work/err")" = "sbus watch: $work/full: 2 recordings are incomplete; the reasons are above" ] &&
  for file in "$work"/full/*; do [ -z "$(tail -c 1 "$file")" ] && "$SBUS" hex "$file" 2>&1 | grep -q ' frame ' || break; done
verdict $? "a full disk is an error for each file, which is whole up to that point, and watching continues"
touch "$work/file"
for folder in "$work/file" "$work/no/such"; do
  ! watch sim --when failsafe -o "$folder" --simulated-time --seconds 1 >"$work/out" && grep -q "^sbus watch: $folder: cannot be created (.*); name a folder that can be written$" "$work/err"
  verdict $? "watch says: $(cat "$work/err")"
done

(cat "$work/flight.json" && echo wrong) >"$work/wrong.json"
rm -rf "$work/dir"
! watch "$work/wrong.json" --when failsafe -o "$work/dir" --after 100 >"$work/out" && grep -q 'wrong.json:1001: "wrong" is not' "$work/err" && tail -n 1 "$work/out" | grep -q ' end .*, [1-9][0-9]* frames$'
verdict $? "a wrong line ends an event: $(tail -n 1 "$work/out")"

# ---- Memory

watched() { peak watch "$1" --when 'ch1<300' -o "$work/dir" --most 0.2; }
"$SBUS" record sim -o "$work/short.txt" --simulated-time --seconds 20 2>"$work/err"
python3 - "$work/short.txt" "$work/long.txt" <<'END'
import sys
lines = [line.split(" ", 1) for line in open(sys.argv[1]) if line[0] != "#"]
with open(sys.argv[2], "w") as out:
    for i in range(90):
        out.writelines("%d %s" % (i * 20000000 + int(time), rest) for time, rest in lines)
END
short=$(watched "$work/short.txt")
long=$(watched "$work/long.txt")
[ "$long" -lt $((short + 4096)) ]
verdict $? "watch of half an hour: $long KB, of 20 s: $short KB"
rm "$work/long.txt"
