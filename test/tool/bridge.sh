#!/bin/sh
# Tests what `sbus bridge` sends, as JSON lines and on pseudo-terminals, and says "ok ..." or "FAILED ...".
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

# rows: the frames among JSON lines: CH1 to CH18, lost frame, failsafe; with an argument also their times
rows() {
  python3 -c 'import json, sys
for line in sys.stdin:
    o = json.loads(line)
    if o["type"] == "frame" and o["first"] == 1:
        print(*o["channels"][:16], int(o.get("ch17", 0)), int(o.get("ch18", 0)), int(o["lost_frame"]), int(o["failsafe"]), *([o["time_us"]] if len(sys.argv) > 1 else []))' "$@"
}
bridge() { timeout 60 "$SBUS" bridge "$@" --simulated-time 2>"$work/err"; }

# ---- What it leaves alone: every accepted frame, its time and its flags, and nothing that was rejected

for line in sim sim:24 sim:32 sim:noise=100 sim:24,noise=100; do
  bridge $line - --seconds 14 | grep '"frame"' >"$work/out"
  "$SBUS" hex $line --json --simulated-time --seconds 14 | grep '"frame"' >"$work/wanted"
  cmp "$work/wanted" "$work/out" && [ "$(wc -l <"$work/wanted")" -gt 300 ] && grep -q '"lost_frame":true,"failsafe":true' "$work/out"
  verdict $? "bridge $line sends exactly the frames of hex: $(wc -l <"$work/out")"
done
bridge sim:sbus2 - --seconds 2 | grep '"frame"' >"$work/out"
"$SBUS" hex sim:sbus2 --json --simulated-time --seconds 2 | grep '"frame"' | sed 's/"end":"[0-9A-F]*"/"end":"00"/' | cmp - "$work/out" && [ -s "$work/out" ]
verdict $? "bridge sim:sbus2 does not announce telemetry, since it sends none"

# ---- Maps and limits: a FrSky's half travel is 820, a Futaba's 672

while IFS='|' read -r source arguments wanted; do
  # shellcheck disable=SC2086  # the arguments are words
  got=$(bridge "$source" - --seconds 0.1 $arguments | rows | cut -d' ' -f1-6 | sort -u)
  [ "$got" = "$wanted" ] || { echo "$got"; cat "$work/err"; false; }
  verdict $? "bridge $source $arguments: $wanted"
done <<'END'
ch1=172,ch2=1811,ch3=400|--map 2,1|1811 172 400 992 992 992
ch1=172,ch2=1811,ch3=400|--map -1,-2,-3|1811 172 1583 992 992 992
ch1=0,ch2=2047|--map -2,-1|0 1983 172 992 992 992
ch1=10,ch2=20,ch6=60|--map 6,6,1|60 60 10 992 992 60
ch1=1402|--map 2,1 --limit ch2=200..1300|992 1300 172 992 992 992
ch3=1811|--limit ch3=172..1500us|992 992 992 992 992 992
ch3=100,ch1=1500|--limit ch3=-100%..50%,ch1=0..1000|1000 992 172 992 992 992
ch1=1900,ch2=100|--limit ch1=-100%..100%,ch2=-100%..100% --range 1811,992,172|1811 172 172 992 992 992
ch1=352,ch2=100%|--map -1,-2 --range futaba|1696 352 172 992 992 992
ch3=1811,failsafe=on|--limit ch3=0..500 --failsafe ch3=900|992 992 900 992 992 992
END
[ "$(bridge sim:32 - --seconds 1 --map 2,1 | grep '"first":17')" = "$(bridge sim:32 - --seconds 1 | grep '"first":17')" ]
verdict $? "--map leaves CH17 to CH32 as they are"

# ---- jq in the loop, as extras/cli/README.md has it

program=$(sed -n "/^sbus bridge .* jq /,/sbus send/p" ../extras/cli/README.md | tr '\n' ' ' | sed "s/.* jq -c --unbuffered '\(.*\)' | sbus send .*/\1/")
while IFS='|' read -r source wanted; do
  got=$(bridge "$source" - --seconds 0.1 | jq -c --unbuffered "$program" | "$SBUS" hex - --json 2>"$work/err" | rows | sort -u)
  [ "$got" = "$wanted" ] || { echo "$got"; cat "$work/err"; false; }
  verdict $? "jq changes $source: $wanted"
done <<'END'
ch1=172,ch2=1811,ch3=400,ch18=on|1811 172 1500 992 992 992 992 992 992 992 992 992 992 992 992 992 0 1 0 0
ch1=0,ch2=2047,ch3=2047,failsafe=on|2047 0 0 992 992 992 992 992 992 992 992 992 992 992 992 992 0 0 0 1
END
bridge sim:32 - --seconds 1 | jq -c --unbuffered "$program" | "$SBUS" hex - --json 2>"$work/err" >"$work/out" &&
  [ "$(grep -c '"first":17' "$work/out")" -eq "$(bridge sim:32 - --seconds 1 | grep -c '"first":17')" ]
verdict $? "jq leaves frames with header 2F and the line of type end as they are"

# ---- Failsafe of 32 channels: frames 101 to 300 are lost, without the failsafe flag; CH20 counts

awk 'BEGIN {
  printf "time"
  for (c = 1; c <= 32; c++) printf ",CH%d", c
  print ",DG1,lostframe,failsafe"
  for (i = 1; i <= 300; i++) {
    printf "%.3f", i * 0.009
    for (c = 1; c <= 32; c++) printf ",%d", c == 20 ? i : 992
    printf ",%d,%d,0\n", (i > 100), (i > 100)
  }
}' >"$work/32.csv"
# extras: what is sent as frames with header 2F: CH20, DG1, lost frame, failsafe, each once, and how often
extras() {
  python3 -c 'import json, sys
for o in map(json.loads, sys.stdin):
    if o["type"] == "frame" and o["first"] == 17:
        print(o["channels"][3], int(o["dg1"]), int(o["lost_frame"]), int(o["failsafe"]))'
}
while IFS='|' read -r arguments wanted; do
  # shellcheck disable=SC2086  # the arguments are words
  bridge "$work/32.csv" - $arguments | tee "$work/out" | extras | awk '{ flags = $2 " " $3 " " $4; if (flags != last && NR > 1) printf "%s to %s; ", last, ch20; last = flags; ch20 = $1 }
    END { printf "%s to %s", last, ch20 }' >"$work/extras"
  [ "$(cat "$work/extras")" = "$wanted" ] || { cat "$work/extras" "$work/err"; false; }
  verdict $? "bridge $arguments: DG1, lost frame and failsafe of frames with header 2F are $wanted (CH20)"
done <<'END'
|0 0 0 to 100; 1 1 0 to 300
--failsafe ch3=172|0 0 0 to 100; 1 1 0 to 200; 1 1 1 to 300
--failsafe hold|0 0 0 to 100; 1 1 0 to 200; 1 1 1 to 200
--failsafe off|0 0 0 to 100; 1 1 0 to 200
END

# ---- Failsafe: the radio of sim is off now and then

bridge sim - --seconds 14 | rows >"$work/plain"
bridge sim - --seconds 14 --failsafe off | rows >"$work/off"
grep -v ' 1$' "$work/plain" | cmp - "$work/off" && grep -q ' 1$' "$work/plain"
verdict $? "--failsafe off sends nothing in failsafe: $(wc -l <"$work/off") of $(wc -l <"$work/plain") frames"
bridge sim - --seconds 14 --failsafe ch3=500,ch5=on | rows >"$work/set"
awk '/ 1$/ { $3 = 500; $5 = 1811 } { print }' "$work/plain" | cmp - "$work/set"
verdict $? "--failsafe ch3=500,ch5=on replaces these two in failsafe, and keeps the flags"
bridge sim - --seconds 14 --failsafe hold | rows >"$work/held"
awk '/ 1$/ { flags = $19 " " $20; $0 = before " " flags; print; next } { print; $20 = $19 = ""; sub(/ *$/, ""); before = $0 }' "$work/plain" | cmp - "$work/held" && ! cmp -s "$work/plain" "$work/held"
verdict $? "--failsafe hold repeats the last values, with the flags"

# Frames to 0.45 s, silence to 1 s, frames again; the value of CH1 is 1 in the first half, 2 in the second.
awk 'BEGIN { for (i = 1; i <= 100; i++) { us = i * 9000 + (i > 50) * 550000; printf "{\"type\":\"frame\",\"time_us\":%d,\"channels\":[%d,992,172,992,992,992,992,992,992,992,992,992,992,992,992,992]}\n", us, (i > 50 ? 2 : 1) } }' >"$work/gap.json"
bridge "$work/gap.json" - | rows time >"$work/out"
awk '{ kind = $1 " " $19 $20 } kind != before { print kind, $NF } { before = kind; n[kind]++ } END { for (k in n) print "n", k, n[k] }' "$work/out" | sort >"$work/got"
printf '%s\n' '1 00 9000.0' '1 11 550000.0' '2 00 1009000.0' 'n 1 00 50' 'n 1 11 51' 'n 2 00 50' | sort | diff - "$work/got"
verdict $? "0.1 s after the last frame it sends both flags every 9 ms, until there are frames again; nothing after the end"
[ "$(bridge "$work/gap.json" - --failsafe off | rows | wc -l)" -eq 100 ] &&
  [ "$(bridge "$work/gap.json" - --failsafe ch1=3 | rows | grep -c '^3 .* 1 1$')" -eq 51 ]
verdict $? "--failsafe also applies to a time without frames"

# A receiver that never sets the failsafe flag: after 100 lost frames values are failsafe's.
awk 'BEGIN { for (i = 1; i <= 250; i++) printf "{\"type\":\"frame\",\"time_us\":%d,\"channels\":[5,992,172,992,992,992,992,992,992,992,992,992,992,992,992,992],\"lost_frame\":%d}\n", 9000 * i, (i > 100) }' >"$work/lost.json"
[ "$(bridge "$work/lost.json" - --failsafe ch1=3 | rows | cut -d' ' -f1,19,20 | uniq -c | awk '{ printf "%s:%s,%s,%s ", $1, $2, $3, $4 }')" = "100:5,0,0 99:5,1,0 51:3,1,1 " ]
verdict $? "100 lost frames in a row are failsafe"

# ---- Two receivers

chosen() { rows time | awk '{ who = $1 " " $19 $20 } who != before { printf "%s at %d ms; ", who, $NF / 1000 } { before = who }'; }
# Its frames end 0.5 ms after those of the second one: both come within one step of the program.
awk 'BEGIN { for (i = 1; i <= 250; i++) printf "{\"type\":\"frame\",\"time_us\":%d,\"channels\":[1,992,172,992,992,992,992,992,992,992,992,992,992,992,992,992]}\n", i * 9000 + 700 + (i > 50) * 549000 }' >"$work/back.json"
awk 'BEGIN { for (i = 1; i <= 400; i++) printf "{\"type\":\"frame\",\"time_us\":%d,\"channels\":[7,992,172,992,992,992,992,992,992,992,992,992,992,992,992,992]}\n", i * 9000 + 200 }' >"$work/beside.json"
while IFS='|' read -r first second seconds wanted said what; do
  got=$(cd "$work" && bridge "$first" - --second "$second" --seconds "$seconds" | chosen)
  [ "$got" = "$wanted " ] && [ "$(sed '1d;$d' "$work/err" | grep -v ' no frames yet; run ' | tr '\n' ';')" = "$said" ] || { echo "$got"; cat "$work/err"; false; }
  verdict $? "two receivers: $what"
done <<'END'
gap.json|ch1=7|2.5|7 00 at 3 ms; 1 00 at 9 ms; 7 00 at 552 ms;|0.003 s: ch1=7 takes over;0.009 s: gap.json takes over;0.550 s: ch1=7 takes over;|the second takes over after 0.1 s without frames
back.json|beside.json|2.5|7 00 at 9 ms; 1 00 at 9 ms; 7 00 at 558 ms; 1 00 at 2016 ms;|0.009 s: beside.json takes over;0.010 s: back.json takes over;0.551 s: beside.json takes over;2.008 s: back.json takes over;|the first is used again after 1 s, however close its frames are to the second one's
ch1=7|lost.json|2|7 00 at 3 ms;||a second that loses frames is not used
lost.json|ch1=7|2|7 00 at 3 ms; 5 00 at 9 ms; 5 10 at 909 ms; 7 00 at 1092 ms;|0.003 s: ch1=7 takes over;0.009 s: lost.json takes over;1.090 s: ch1=7 takes over;|the second takes over after 0.2 s of lost frames
ch1=4,failsafe=on|ch1=7|0.5|4 01 at 3 ms; 7 00 at 3 ms;|0.003 s: ch1=7 takes over;|in failsafe the second takes over at once
ch1=4,failsafe=on|ch1=7,failsafe=on|0.5|4 01 at 3 ms;||a second in failsafe does not take over
ch1=4,failsafe=on|sim:24|0.5|4 01 at 3 ms;|sim: left out, since ch1=4,failsafe=on sends another number of channels;|a second with 24 channels does not take over
ch1=4,failsafe=on|sim:uninverted|3|4 01 at 3 ms;||nor does an inverted one
END
bridge ch1=4,failsafe=on - --second sim:uninverted --seconds 3 >"$work/out"
grep -qx 'sim: no frames yet; run sbus doctor sim' "$work/err"
verdict $? "of a second without frames it says so"
futaba=$(echo 'ch1=7,ch2=Z,ch4=Z,ch5=Z,ch6=Z,ch7=Z,ch8=Z,ch9=Z,ch10=Z,ch11=Z,ch12=Z,ch13=Z,ch14=Z,ch15=Z,ch16=Z' | sed 's/Z/1024/g')
[ "$(bridge ch1=4,failsafe=on - --second "$futaba" --seconds 0.5 | chosen)" = "4 01 at 3 ms; " ] &&
  grep -qx "$futaba: left out, since ch1=4,failsafe=on sends the other make's range" "$work/err" || { cat "$work/err"; false; }
verdict $? "a second of the other make does not take over"

# ---- A trainer: CH8 is the teacher's switch

awk 'BEGIN { for (i = 1; i <= 100; i++) printf "{\"type\":\"frame\",\"channels\":[1,1,1,1,1,1,1,%d,1,1,1,1,1,1,1,1],\"failsafe\":%d}\n", (i > 40 ? 1811 : 992), (i > 80) }' >"$work/teacher.json"
trained() { bridge "$work/teacher.json" - --second "$@" | rows | cut -d' ' -f1-5 | uniq -c | awk '{ $1 = $1 ":"; printf "%s; ", $0 }'; }
[ "$(trained ch1=7,ch2=7,ch3=7,ch4=7 --trainer ch8 --seconds 0.9)" = "40: 1 1 1 1 1; 40: 7 7 7 7 1; 20: 1 1 1 1 1; " ]
verdict $? "the pupil controls CH1 to CH4 while the switch is on, but not in the teacher's failsafe"
[ "$(trained ch1=7,ch2=7,ch3=7,ch4=7 --trainer ch8=ch2,ch4 --seconds 0.9)" = "40: 1 1 1 1 1; 40: 1 7 1 7 1; 20: 1 1 1 1 1; " ]
verdict $? "the pupil controls the named channels"
[ "$(trained ch1=7,failsafe=on --trainer ch8 --seconds 0.9)" = "100: 1 1 1 1 1; " ]
verdict $? "a pupil in failsafe controls no channels"
[ "$(bridge ch8=1811 - --second "$futaba" --trainer ch8 --seconds 0.5 | rows | cut -d' ' -f1-4 | sort -u)" = "992 992 172 992" ]
verdict $? "nor does one of the other make"
sed 's/"failsafe":0/"lost_frame":1,&/' "$work/teacher.json" | awk 'NR <= 45 { sub(/"lost_frame":1,/, "") } { sub(/\[1,1,1,1/, "[7,7,7,7"); print }' >"$work/lossy.json"
[ "$(trained "$work/lossy.json" --trainer ch8 --seconds 0.9)" = "40: 1 1 1 1 1; 16: 7 7 7 7 1; 44: 1 1 1 1 1; " ]
verdict $? "nor does one that has had only lost frames for 0.1 s"
# A program that is killed within a line ends its own receiver only, whichever it is.
(head -n 60 "$work/teacher.json" | tr 1 7 && printf '{"type":"fra') | sed 's/7877/1811/g' >"$work/half.json"
while IFS='|' read -r arguments wanted; do
  # shellcheck disable=SC2086  # the arguments are words
  got=$(cd "$work" && bridge $arguments | tee "$work/out" | rows | cut -d' ' -f1,19,20 | uniq -c |
    awk '{ printf "%s:%s,%s,%s ", $1, $2, $3, $4 }'; grep -c '"type":"end"' "$work/out")
  [ "$got" = "$wanted" ] && tail -n 1 "$work/err" | grep -q '^sbus bridge: half.json:61: .* is not a JSON object' || { echo "$got"; cat "$work/err"; false; }
  verdict $? "bridge $arguments: $wanted line of type end, and the error at last"
done <<'END'
teacher.json - --second half.json --trainer ch8|40:1,0,0 31:7,0,0 9:1,0,0 20:1,0,1 1
half.json - --second teacher.json|60:7,0,0 9:1,0,0 20:1,0,1 0
half.json -|60:7,0,0 0
END
sed 's/,1811,/,172,/' "$work/teacher.json" >"$work/reversed.json"
trained() { bridge "$work/reversed.json" - --second "$@" | rows | cut -d' ' -f1-5 | uniq -c | awk '{ $1 = $1 ":"; printf "%s; ", $0 }'; }
[ "$(trained ch1=7,ch2=7,ch3=7,ch4=7 --trainer ch8 --range 1811,992,172 --seconds 0.9)" = "40: 1 1 1 1 1; 40: 7 7 7 7 1; 20: 1 1 1 1 1; " ]
verdict $? "a teacher's switch with a reversed range is on at +100 %"

# ---- On a wire

# wire PIECES: writes frames with the values 1, 2, ... to a port in PIECES, each once the last frame of the one before has come
# out; prints how many frames came out, and whether they were in order
wire() {
  python3 - "$SBUS" "$1" <<'END' 2>"$work/err"
import subprocess, sys, time
from ports import Port, frame, value_of
port, out = Port(), Port()
bridge = subprocess.Popen([sys.argv[1], "bridge", port.name, out.name], stderr=subprocess.PIPE, text=True)
while "forwarding its frames" not in bridge.stderr.readline():
    pass
at_once = int(sys.argv[2])
got = b""
# Returns what has come out; frames with flags are sent while none come.
def values():
    frames = [got[i:i + 25] for i in range(0, len(got), 25)]
    return [value_of(f) for f in frames if len(f) == 25 and f[0] == 15 and f[23] == 0]
# Writes these frames. Returns true once the last one has come out, and false if it has not done so in time.
def passes(first, count, seconds):
    global got
    end = time.monotonic() + seconds
    port.write(b"".join(frame(first + k) for k in range(count)))
    while first + count - 1 not in values():
        part = out.read(end - time.monotonic())
        if not part:
            return False
        got += part
    return True
while not passes(0, 1, 0.02):  # until it is in sync
    pass
got = got[len(got) // 25 * 25:]  # a read may end within a frame
for i in range(1, 101, at_once):
    time.sleep(0.009)
    passes(i, at_once, 3)
bridge.send_signal(2)
text = bridge.stderr.read()
values = [value for value in values() if value > 0]
print(len(values), values == sorted(set(values)))
print(text, file=sys.stderr)
END
}
got=$(wire 1)
set -- $got
[ "$1" -ge 90 ] && [ "$2" = True ] || { echo "$got"; cat "$work/err"; false; }
verdict $? "frames from a port are forwarded: $1 of 100"
got=$(wire 4)
set -- $got
[ "$1" -ge 25 ] && [ "$1" -le 60 ] && [ "$2" = True ] && grep -qE '[0-9]+ frames sent, [1-9][0-9]* replaced by newer ones before their turn$' "$work/err" || { echo "$got"; cat "$work/err"; false; }
verdict $? "of four frames that an adapter delivers at once, two are sent, on a busy PC the newest: $1 of 100"

python3 -c 'import sys, ports
sys.stdout.buffer.write(b"".join(ports.frame(raw) for raw in range(200)))' >"$work/bytes.bin"
# shellcheck disable=SC2002  # a pipe
[ "$(cat "$work/bytes.bin" | timeout 60 "$SBUS" bridge - - 2>"$work/err" | rows | grep -c ' 0 0$')" -eq 200 ]
verdict $? "all frames in bytes that a pipe delivers at once are sent"
# ended SECONDS FILE ARGUMENTS...: counts the frames without and with failsafe of $work/bytes.bin or $work/frames.json, through
# a pipe that stays open for so long; with 0, it has ended before it is read, also on a busy PC
ended() {
  seconds=$1
  file=$2
  shift 2
  (cat "$work/$file"; sleep "$seconds") | { [ "$seconds" -gt 0 ] || sleep 1; timeout 60 "$SBUS" bridge - - "$@" 2>"$work/err"; } | rows | cut -d' ' -f20 | sort | uniq -c |
    awk '{ n[$2] = $1 } END { print n[0] + 0, n[1] + 0 }'
}
head -n 50 "$work/gap.json" >"$work/frames.json"
[ "$(ended 0 bytes.bin)" = "200 0" ] && [ "$(ended 0 frames.json)" = "50 0" ] && [ "$(ended 0 bytes.bin --second "$work/frames.json")" = "200 0" ]
verdict $? "after the end of a pipe no failsafe is sent"
for file in bytes.bin frames.json; do
  got=$(ended 4 $file)
  set -- $got
  [ "$1" -eq 0 ] && [ "$2" -gt 100 ]
  verdict $? "of what a live pipe brings at once nothing is sent, but failsafe: $2 frames"
done

player bridge sim
"$SBUS" csv "$terminal" --every-frame --columns ch1-ch16 >"$work/rows" 2>"$work/err" &
reader=$!
until_true has_lines 201 "$work/rows"
kill -INT "$player"
wait "$player" "$reader"
"$SBUS" csv sim --simulated-time --seconds 80 --every-frame --columns ch1-ch16 >"$work/wanted"
[ "$(wc -l <"$work/rows")" -gt 200 ] && ! grep -vxFf "$work/wanted" "$work/rows"
verdict $? "without a DEVICE bridge creates a pseudo-terminal: $(wc -l <"$work/rows") frames"

player bridge sim:32
"$SBUS" hex "$terminal" --values >"$work/hex" 2>"$work/err" &
reader=$!
until_true has_lines 100 "$work/hex"
kill -INT "$player"
wait "$player" "$reader"
"$SBUS" hex sim:32 --simulated-time --seconds 80 --values | grep ' extra ' | cut -c15- >"$work/wanted"
# On a busy PC one may have become old, and has both flags.
grep ' extra ' "$work/hex" | cut -c15- | grep -v '^2F.* 0C 00  extra ' >"$work/extra"
[ "$(wc -l <"$work/extra")" -gt 20 ] && ! grep -vxFf "$work/wanted" "$work/extra"
verdict $? "frames with header 2F are sent unchanged: $(wc -l <"$work/extra") frames"

# ---- Errors

while IFS='|' read -r arguments message; do
  # shellcheck disable=SC2086  # the arguments are words
  timeout 60 "$SBUS" bridge $arguments >"$work/out" 2>"$work/err" </dev/null
  [ $? -ne 0 ] && grep -qxFe "$message" "$work/err" && [ ! -s "$work/out" ] || { cat "$work/err"; false; }
  verdict $? "bridge says: $message"
done <<'END'
|SOURCE is required
sim --map 1,x|--map: up to 16 channels, 1 to 16 or reversed -1 to -16, such as 2,1,-3, are expected, not "x"
sim --map 17|--map: up to 16 channels, 1 to 16 or reversed -1 to -16, such as 2,1,-3, are expected, not "17"
sim --map 1,1.5|--map: up to 16 channels, 1 to 16 or reversed -1 to -16, such as 2,1,-3, are expected, not "1.5"
sim --map 1,,2|--map: up to 16 channels, 1 to 16 or reversed -1 to -16, such as 2,1,-3, are expected, not ""
sim --map 1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,2|--map: up to 16 channels, 1 to 16 or reversed -1 to -16, such as 2,1,-3, are expected, not "2"
sim --limit ch1=5|--limit: the lower and the upper end of ch1 to ch16, each once, such as ch3=172..1500 or ch3=-100%..50%, are expected, not "ch1=5"
sim --limit ch1=9..5|--limit: the lower and the upper end of ch1 to ch16, each once, such as ch3=172..1500 or ch3=-100%..50%, are expected, not "ch1=9..5"
sim --limit ch1=9..5000|--limit: the lower and the upper end of ch1 to ch16, each once, such as ch3=172..1500 or ch3=-100%..50%, are expected, not "ch1=9..5000"
sim --limit ch17=0..5|--limit: the lower and the upper end of ch1 to ch16, each once, such as ch3=172..1500 or ch3=-100%..50%, are expected, not "ch17=0..5"
sim --limit ch1=0..5,ch1=1..2|--limit: the lower and the upper end of ch1 to ch16, each once, such as ch3=172..1500 or ch3=-100%..50%, are expected, not "ch1=1..2"
sim --failsafe ch3=1,ch3=2|--failsafe: "ch3=2" sets a channel twice; leave one of them out
sim --failsafe on|--failsafe: off, hold or values of ch1 to ch16 such as ch3=172 are expected, not on
sim --failsafe ch3=3000|--failsafe: "ch3=3000" is out of range; 0 to 2047, a pulse such as 1500us, a part such as -50%, on (1811) or off (172) is expected
sim --trainer ch5|--trainer: --second is the pupil's receiver; name it
sim --second ch1=1 --trainer ch5=2|--trainer: channels of ch1 to ch16, such as ch8 or ch8=ch1,ch2, are expected, not "2"
sim --second ch1=1 --trainer ch17|--trainer: channels of ch1 to ch16, such as ch8 or ch8=ch1,ch2, are expected, not "ch17"
sim --second ch1=1 --trainer ch5=ch1,|--trainer: channels of ch1 to ch16, such as ch8 or ch8=ch1,ch2, are expected, not ""
- --second -|-: cannot be read twice; name another source
sim /dev/null|sbus bridge: /dev/null: not a serial port that can be opened (unknown to the system); name the adapter's port
no-such-file.txt -|sbus bridge: no-such-file.txt: cannot be opened (No such file or directory); the name of a recording is expected
END
