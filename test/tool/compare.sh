#!/bin/sh
# Tests what `sbus compare` says about two lines with known differences, and says "ok ..." or "FAILED ...".
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

# line NAME SECONDS VALUES WHERE: frame i of a flight in $work/NAME, at 9 ms * i + SECONDS; VALUES changes `raw`, the value of CH1,
# `lost` and `us`; frames for which WHERE is true are left out. CH1 is a walk of a stick that seldom has a value twice.
line() {
  awk -v "seconds=$2" 'BEGIN {
    for (i = 1; i <= 3000; i++) {
      raw = (i * 37 + int(i / 50) * 11) % 2000; lost = 0; us = i * 9000 + seconds * 1000000
      '"$3"'
      if (!('"${4:-0}"')) printf "{\"type\":\"frame\",\"time_us\":%d,\"channels\":[%d,%d,172,992,992,992,992,992,992,992,992,992,992,992,992,992],\"lost_frame\":%d}\n", us, raw, i % 2000, lost
    }
  }' >"$work/$1"
}
# json A B: $work/json has the lines, $work/sum the figures of the last one
compare() {
  (cd "$work" && timeout 100 "$SBUS" compare "$@" --json) >"$work/json" 2>"$work/err"
  status=$?
  python3 -c 'import json, sys
lines = [json.loads(line) for line in sys.stdin]
c = lines[-1]
if c["type"] == "comparison":
    print(*[c[name] for name in ("frames_a", "frames_b", "alone_a", "alone_b", "same", "different", "lost_by_a", "lost_by_b")], "delay", *[round(c[name]) for name in ("delay_us", "least_delay_us", "most_delay_us")], "drift", c["drift_ppm"])
' <"$work/json" >"$work/sum"
  return $status
}
# said WANTED WHAT: the figures are these
said() {
  [ "$(cat "$work/sum")" = "$1" ] || { cat "$work/sum" "$work/err"; false; }
  verdict $? "$2: $1"
}
spans() { sed -n 's/.*"loss","by":"\(.\)","from_us":\([0-9]*\).*"to_us":\([0-9]*\).*"frames":\([0-9]*\).*/\1 \2 \3 \4/p' "$work/json"; }

line a.json 1 ''
compare a.json a.json
said "3000 3000 0 0 3000 0 0 0 delay 0 0 0 drift 0.0" "a line and itself are the same"
line b.json 1 'us += 1234'
compare a.json b.json
said "3000 3000 0 0 3000 0 0 0 delay 1234 1234 1234 drift 0.0" "a delay"
compare b.json a.json
said "3000 3000 0 0 3000 0 0 0 delay -1234 -1234 -1234 drift 0.0" "the second one may be the earlier"
for offset in 6 26; do
  line b.json $offset ''
  compare a.json b.json
  said "3000 3000 0 0 3000 0 0 0 delay $((offset - 1))000000 $((offset - 1))000000 $((offset - 1))000000 drift 0.0" "a recording that was begun $((offset - 1)) s earlier"
done
line b.json 1 'us = int(us * 1.00005)'
compare a.json b.json
said "3000 3000 0 0 3000 0 0 0 delay 725 50 1400 drift 50.0" "a clock that is 50 ppm slow"

# A line that goes on without frames has lost the other's: 100 at its beginning, 200 at its end.
"$SBUS" record sim -o "$work/a.txt" --simulated-time --seconds 9 2>"$work/err"
awk '/^#/ { print; next } $2 == "0F" { i++ } i <= 100 || i > 600 { $2 = "55"; $3 = "AA"; $0 = $1 " 55 AA 55 AA" } i <= 800 { print }' "$work/a.txt" >"$work/b.txt"
compare a.txt b.txt
read -r a b alone y same different by_a by_b rest <"$work/sum"
[ "$b $same $different $by_a" = "500 500 0 0" ] && [ "$by_b" -eq 298 ] && [ $((by_b + alone + 500)) -eq "$a" ] && [ "$(spans | wc -l)" -eq 2 ] || { cat "$work/sum" "$work/json"; false; }
verdict $? "a line without frames at its beginning and its end has lost them: $by_b, and not the $alone after its end"
line b.json 1 'us = int(us * 1.01)'
for names in "a.json b.json" "b.json a.json"; do
  compare $names
  read -r a b x y same different by_a by_b word delay rest <"$work/sum"
  [ "$same" -eq 3000 ] && [ "${delay#-}" -ge 144500 ] && [ "${delay#-}" -le 145600 ] || { cat "$work/sum"; false; }
  verdict $? "more delays than are stored individually: $(cat "$work/sum")"
done

# table NAME CHANNELS: the flight with this many channels; those above CH16 change with each frame
table() {
  awk -v "channels=$2" 'BEGIN {
    printf "time"
    for (c = 1; c <= channels; c++) printf ",CH%d", c
    print ""
    for (i = 1; i <= 3000; i++) {
      printf "%.3f,%d,%d,172", i * 0.009 + 1, (i * 37 + int(i / 50) * 11) % 2000, i % 2000
      for (c = 4; c <= channels; c++) printf ",%d", c <= 16 ? 992 : (i * c) % 2048
      print ""
    }
  }' >"$work/$1"
}
table 16.csv 16
table 24.csv 24
table 32.csv 32
for names in "16.csv 24.csv 16 24" "24.csv 16.csv 24 16" "16.csv 32.csv 16 32" "32.csv 24.csv 32 24"; do
  read -r one other a b <<END
$names
END
  compare "$one" "$other"
  said "3000 3000 0 0 3000 0 0 0 delay 0 0 0 drift 0.0" "a line of $a channels and one of $b are compared by those that both have"
  (cd "$work" && "$SBUS" compare "$one" "$other") | grep -qx "channels     $a in A, $b in B: CH1 to CH$((a < b ? a : b)) are compared"
  verdict $? "compare says which channels of $a and $b it compares"
done
compare 24.csv 24.csv
said "3000 3000 0 0 3000 0 0 0 delay 0 0 0 drift 0.0" "two lines of 24 channels"
awk -F, -v OFS=, '$1 == "10.000" { $21 = 1 - ($21 > 0) } { print }' "$work/24.csv" >"$work/other24.csv"
compare 24.csv other24.csv
[ "$(sed -n 's/.*"difference",\(.*\)}/\1/p' "$work/json")" = '"time_us":10000000.0,"name":"CH20","a":1568,"b":0' ] || { cat "$work/json"; false; }
verdict $? "the first difference of two lines of 24 channels may be CH20"
line b.json 1 '' 'i == 100 || i > 1000 && i <= 1010'
compare a.json b.json
said "3000 2989 0 0 2989 0 0 11 delay 0 0 0 drift 0.0" "eleven frames are missing in B"
[ "$(spans | paste -sd ,)" = "B 1900000 1900000 1,B 10009000 10090000 10" ] && grep -q '"difference","time_us":1900000.0,"only":"A"' "$work/json"
verdict $? "in two spans: $(spans | paste -sd ,)"
compare b.json a.json
said "2989 3000 0 0 2989 0 11 0 delay 0 0 0 drift 0.0" "eleven frames are missing in A"
line b.json 1 'us += 7' 'i <= 500 || i > 2900'
compare a.json b.json
said "3000 2400 600 0 2400 0 0 0 delay 7 7 7 drift 0.0" "what A has before and after B is not lost"
line b.json 1 'if (i > 700 && i <= 720) { raw = (700 * 37 + 154) % 2000; lost = 1 }'
sed -i 's/\[\([0-9]*\),[0-9]*,\(.*"lost_frame":1\)/[\1,700,\2/' "$work/b.json"
compare a.json b.json
said "3000 3000 0 0 2980 0 0 20 delay 0 0 0 drift 0.0" "lost frames that repeat the values before are lost"
line b.json 1 'us += 1234; if (i == 800) raw = 2047; if (i == 900) raw = 2046'
compare a.json b.json
said "3000 3000 0 0 2998 2 0 0 delay 1234 1234 1234 drift 0.0" "two frames have another CH1"
grep -qx '{"type":"difference","time_us":8200000.0,"name":"CH1","a":1776,"b":2047}' "$work/json" || { grep difference "$work/json"; false; }
verdict $? "the first difference has its channel and values"

# A resting stick does not distinguish frames: their times do, once the delay is known.
line a.json 1 'if (i > 1500) raw = 5'
sed -i 's/\[5,[0-9]*,/[5,5,/' "$work/a.json"
sed '1700d; 1800,1809d' "$work/a.json" >"$work/b.json"
compare a.json b.json
said "3000 2989 0 0 2989 0 0 11 delay 0 0 0 drift 0.0" "frames that are all alike"
# Receivers with clocks that differ by 0.1 %; a new value every 18 ms.
awk 'BEGIN { for (t = 0; t < 60000; t += 9) { raw = int(t / 18) * 37 % 2000; printf "{\"type\":\"frame\",\"time_us\":%d,\"channels\":[%d,%d,172,992,992,992,992,992,992,992,992,992,992,992,992,992]}\n", 1000000 + t * 1000, raw, int(t / 18) % 2000 } }' >"$work/a.json"
awk 'BEGIN { for (t = 3; t < 60000; t += 9.01) { raw = int(t / 18) * 37 % 2000; printf "{\"type\":\"frame\",\"time_us\":%d,\"channels\":[%d,%d,172,992,992,992,992,992,992,992,992,992,992,992,992,992]}\n", 1000000 + t * 1000, raw, int(t / 18) % 2000 } }' >"$work/b.json"
compare a.json b.json
read -r a b x y same different by_a by_b rest <"$work/sum"
[ "$a" -eq 6667 ] && [ "$same" -ge 6600 ] && [ "$different" -eq 0 ] && [ $((by_a + by_b)) -le 60 ] || { cat "$work/sum"; false; }
verdict $? "receivers with clocks that differ by 0.1 %: $(cat "$work/sum")"

# Receivers that send at other rates, or scale the sticks differently: neither is a loss.
# waves NAME PERIOD_MS LOW HIGH SAMPLED_MS: CH1 moves to and fro between its ends
waves() {
  awk -v "ms=$2" -v "low=$3" -v "high=$4" -v "each=${5:-1}" 'BEGIN { for (t = ms; t < 20000; t += ms) printf "{\"type\":\"frame\",\"time_us\":%d,\"channels\":[%d,992,172,992,992,992,992,992,992,992,992,992,992,992,992,992]}\n", t * 1000, low + (high - low) * (1 + sin(int(t / each) * each / 400)) / 2 + 0.5 }' >"$work/$1"
}
waves slow.json 9 172 1811 36
waves fast.json 14 172 1811 36
waves scaled.json 9 192 1792
waves plain.json 9 172 1811
while IFS='|' read -r a b name why; do
  (cd "$work" && "$SBUS" compare $a $b) >"$work/text" 2>&1
  sed -n "s/.* have no frame in common\. //p; s/^$name  *//p" "$work/text" >"$work/came"
  [ "$(cat "$work/came")" = "$why" ] || { cat "$work/text"; false; }
  verdict $? "compare of $a and $b says why frames differ: ${why:-nothing}"
done <<'END'
slow.json|fast.json|rates|A sends every 9.00 ms, B every 14.00 ms: frames differ while sticks move.
plain.json|scaled.json|scales|CH1 goes from 172 to 1811 in A, from 192 to 1792 in B: their scales differ.
plain.json|plain.json|scales|
plain.json|plain.json|rates|
END
compare slow.json fast.json
grep -q '"rates":"A sends every 9.00 ms, B every 14.00 ms: frames differ while sticks move.","scales":""' "$work/json" || { cat "$work/json"; false; }
verdict $? "compare --json says it, too"

# Dates align recordings with different beginnings.
line a.json 1 'raw = 5'
for name in a b; do sed -i 's/,[0-9]*,172/,6,172/' "$work/a.json"; done
"$SBUS" hex "$work/a.json" --json | sed -n 1p >"$work/head"
(sed 's/}$/,"start":"2026-11-24T10:00:00.000000Z"}/' "$work/head"; cat "$work/a.json") >"$work/a-dated.json"
(sed 's/}$/,"start":"2026-11-24T10:10:00.000000Z"}/' "$work/head"; awk -F'[:,]' -v OFS= '{ us = $4 - 600000000; if (us > 0) print }' "$work/a.json") >"$work/b-dated.json"
line c.json 601 'raw = 5'
sed -i 's/,[0-9]*,172/,6,172/' "$work/c.json"
(sed 's/}$/,"start":"2026-11-24T09:50:00.000000Z"}/' "$work/head"; cat "$work/c.json") >"$work/c-dated.json"
compare a-dated.json c-dated.json
said "3000 3000 0 0 3000 0 0 0 delay 0 0 0 drift 0.0" "ten minutes between the beginnings, by their dates"
grep -q '"by_contents":false,"certain":false' "$work/json"
verdict $? "it says that the contents did not show the delay, and that it is not certain"

# ---- The wire and a port, files and sources of other kinds

"$SBUS" record sim -o "$work/sim.txt" --simulated-time --seconds 14 2>"$work/err"
"$SBUS" wave "$work/sim.txt" -o "$work/sim.vcd"
compare sim.txt sim.vcd
read -r a b x y same rest <"$work/sum"
[ "$a $b $same" = "1555 1555 1555" ]
verdict $? "a recording and a capture of it are the same: $(cat "$work/sum")"
# A capture of both: B is 1234 us later, and noise hits neither.
awk -v OFS= 'FNR == NR { if (/^#/) us = substr($0, 2); else if (/^[01]!/) print us, " ", $0; next }
  /^#/ { us = substr($0, 2) + 1234; next } /^[01]!/ { sub("!", "\""); print us, " ", $0 }' "$work/sim.vcd" "$work/sim.vcd" | sort -sn |
  awk 'BEGIN { print "$timescale 1 us $end\n$var wire 1 ! WIRE $end\n$var wire 1 \" PORT $end\n$enddefinitions $end" }
    { if ($1 != us) print "#" $1; us = $1; print $2 }' >"$work/two.vcd"
compare two.vcd two.vcd --signal WIRE --signal-b PORT
said "1555 1555 0 0 1555 0 0 0 delay 1234 1234 1234 drift 0.0" "two signals of one capture"
compare two.vcd two.vcd --signal PORT --signal-b WIRE
said "1555 1555 0 0 1555 0 0 0 delay -1234 -1234 -1234 drift 0.0" "the same, the other way round"
compare sim.txt two.vcd --signal-b PORT
[ "$(cut -d' ' -f 5 "$work/sum")" = 1555 ] && grep -q '"certain":true' "$work/json" || { cat "$work/sum" "$work/err"; false; }
verdict $? "a recording and a signal of a capture: $(cat "$work/sum")"
compare sim sim:noise=50 --simulated-time --seconds 14
"$SBUS" hex sim:noise=50 --simulated-time --seconds 14 --json | grep -c '"type":"frame"' >"$work/noisy"
read -r a b alone y same different by_a by_b rest <"$work/sum"
[ "$a $b $different $by_a" = "1555 $(cat "$work/noisy") 0 0" ] && [ $((same + by_b + alone)) -eq 1555 ] && [ "$same" -eq "$b" ]
verdict $? "every frame of a noisy line is matched: $(cat "$work/sum")"

(cd "$work" && "$SBUS" compare sim.txt sim.txt) >"$work/text"
cat >"$work/wanted" <<'END'
A            sim.txt: 1555 frames
B            sim.txt: 1555 frames
same         1555 frames
different    0 frames
lost by A    0 frames in 0 spans
lost by B    0 frames in 0 spans
first        none
delay        of B: median 0 us, 0 to 0 us, drift 0.0 us/s, found by the contents: 1200 of 1200 agree
END
diff "$work/wanted" "$work/text"
verdict $? "compare prints a text"

# ---- Two ports at once

cat >"$work/live.py" <<'END'
import json, subprocess, sys, time
from ports import Port, frame
a, b = Port(), Port()
program = subprocess.Popen([sys.argv[1], "compare", a.name, b.name, "--json"], stdout=subprocess.PIPE, text=True)
time.sleep(0.7)
for i in range(400):
    a.write(frame(i * 37 % 2000, i))
    if not 200 <= i < 210:
        b.write(frame(i * 37 % 2000, i))
    time.sleep(0.009)
time.sleep(0.3)
program.send_signal(2)
c = json.loads(program.stdout.read().split("\n")[-2])
print(c["same"], c["different"], c["lost_by_a"], c["lost_by_b"], c["delay_us"])
END
for _ in 1 2 3; do # what a busy PC reads late is not compared
  python3 "$work/live.py" "$SBUS" >"$work/live" 2>"$work/err"
  read -r same different by_a by_b delay <"$work/live"
  [ "$same" -ge 380 ] && [ "$by_b" -ge 10 ] && break
done
[ "$same" -ge 380 ] && [ "$different $by_a" = "0 0" ] && [ "$by_b" -ge 10 ] && [ "$by_b" -le 12 ] || { cat "$work/live" "$work/err"; false; }
verdict $? "two ports at once: $same identical frames, $by_b lost by B, delay $delay us"

# ---- The PC is late: what comes meanwhile is read at once, and says so

python3 - "$work/late-a.txt" "$work/late-b.txt" <<'END'
import sys
from ports import frame
def write(name, later_us, lost, late):
    with open(name, "w") as file:
        for i in range(3000):
            end = 9000 * (i + 1) + later_us + 2880
            if i in lost:
                continue
            stamp = "%d" % (end - 2880)
            for begin, stop in late:
                if begin <= end < stop:
                    stamp = "%d~%d" % (stop - ((stop - end) // 9000 + 2) * 3000, stop - begin)
            file.write(stamp + " " + frame(i * 37 % 2000, i % 2000).hex(" ") + "\n")
stalls = [(3000000, 3300000), (9000000, 9120000), (15000000, 17000000)]
write(sys.argv[1], 0, range(2000, 2010), stalls[1:])
write(sys.argv[2], 1500, range(2500, 2520), stalls)
END
(cd "$work" && "$SBUS" compare late-a.txt late-b.txt) >"$work/out" && compare late-a.txt late-b.txt
read -r a b x y same different by_a by_b word delay least most rest <"$work/sum"
[ "$a $b $same $different $by_a $by_b" = "2990 2980 2970 0 10 20" ] && [ "$delay" -ge 1400 ] && [ "$delay" -le 1600 ] && [ "$least" -ge -50000 ] && [ "$most" -le 50000 ] || { cat "$work/sum" "$work/out"; false; }
verdict $? "what a PC read late is no loss: $(cat "$work/sum")"

# A PC that was late all the time: the frames are the same for all that, and the delay is said to be inaccurate.
for name in a b; do sed 's/ /~70000 /' "$work/late-$name.txt" | sed 's/~[0-9]*~70000/~70000/' >"$work/always-$name.txt"; done
(cd "$work" && "$SBUS" compare always-a.txt always-b.txt) >"$work/out" 2>&1
grep -qE '^same         2[89][0-9]{2} frames$' "$work/out" && grep -qE '^lost by B    0 frames' "$work/out" && grep -qE '^not compared [1-9][0-9]* of A, [1-9][0-9]* of B: the PC was late$' "$work/out" &&
  grep -qE '^delay .*, found by the contents: [0-9]+ of [0-9]+ agree; inaccurate, since the PC was late$' "$work/out" || { cat "$work/out"; false; }
verdict $? "two recordings of a PC that was always late have frames in common: $(grep -o '.*not compared.*' "$work/out")"

# ---- Memory

python3 - "$work/sim.txt" "$work/long-a.txt" "$work/long-b.txt" <<'END'
import sys
lines = [line.split(" ", 1) for line in open(sys.argv[1]) if line[0] != "#"]
with open(sys.argv[2], "w") as a, open(sys.argv[3], "w") as b:
    for i in range(130):
        for time, rest in lines:
            us = i * 14000000 + int(time)
            a.write("%d %s" % (us, rest))
            if us // 9000 % 50:
                b.write("%d %s" % (us * 1.00003 + 3000000, rest))
END
short=$(peak compare "$work/sim.txt" "$work/sim.vcd")
long=$(peak compare "$work/long-a.txt" "$work/long-b.txt")
kept=8192  # KB: a minute of frames, and what the address sanitizer adds to each; all of them would need 30000
[ "$long" -lt $((short + kept)) ]
verdict $? "compare of half an hour: $long KB, of 14 s: $short KB"
# The second one began ten minutes later.
(echo '# format 1, began 2026-11-24T10:00:00.000000Z'; cat "$work/long-a.txt") >"$work/long-c.txt"
(echo '# format 1, began 2026-11-24T10:10:00.000000Z'; awk '$1 > 600000000 { $1 -= 600000000; print }' "$work/long-a.txt") >"$work/long-d.txt"
long=$(peak compare "$work/long-c.txt" "$work/long-d.txt")
compare long-c.txt long-d.txt
[ "$long" -lt $((short + kept)) ] && read -r a b alone y same rest <"$work/sum" && [ "$b" -gt 135000 ] && [ "$same" -eq "$b" ] && [ $((alone + b)) -eq "$a" ] || { cat "$work/sum"; false; }
verdict $? "compare of recordings ten minutes apart: $long KB, $(cat "$work/sum")"
rm "$work"/long-*

# ---- Errors

(grep -v '^#' "$work/sim.txt" && echo wrong) >"$work/wrong.txt"
for arguments in "sim.txt wrong.txt" "wrong.txt sim.txt"; do
  # shellcheck disable=SC2086  # they are words
  ! (cd "$work" && "$SBUS" compare $arguments) >"$work/out" 2>"$work/err" && grep -q '^same  *[1-9][0-9]* frames' "$work/out" &&
    grep -q '^wrong.txt:[0-9]*: "wrong" is not a time' "$work/err" || { cat "$work/out" "$work/err"; false; }
  verdict $? "compare $arguments prints what precedes a wrong line: $(head -n 3 "$work/out" | tail -n 1)"
done

printf '0F E5 03 1F F8 C0 07 3E F0 81 0F 7C E0 03 06 F8 80 91 3D F0 81 0F 7C 00 00\n%.0s' 1 2 3 >"$work/bytes.txt"
while IFS='|' read -r arguments message; do
  # shellcheck disable=SC2086  # the arguments are words
  (cd "$work" && timeout 60 "$SBUS" compare $arguments) >"$work/out" 2>"$work/err" </dev/null
  [ $? -ne 0 ] && grep -qxFe "$message" "$work/err" && [ ! -s "$work/out" ] || { cat "$work/err"; false; }
  verdict $? "compare says: $message"
done <<'END'
sim|B is required
- -|-: cannot be read twice; name another source
sim.txt bytes.txt|sbus compare: bytes.txt: has no times; a port, a recording or a capture is expected
sim.txt no-such.txt|sbus compare: no-such.txt: cannot be opened (No such file or directory); the name of a recording is expected
two.vcd two.vcd --signal-b OTHER|sbus compare: two.vcd: there is no signal OTHER: one of WIRE, PORT is expected
sim.txt c.json|sbus compare: sim.txt and c.json have no frame in common
END
