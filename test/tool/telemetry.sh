#!/bin/sh
# Runs `sbus telemetry` on lines of S.BUS2. Says "ok ..." or "FAILED ...".
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

# Frames of 15 ms; after each that ends in 04 the receiver's voltage, an SBS-01V in slots 1 and 2, and in the third round 4
# characters too few; after 34 a current sensor in slots 24 to 26.
awk 'BEGIN {
  for (i = 0; i < 20; i++) {
    start = 120 + 15000 * i
    print start, "0F 11 04 20 A8 01 08 16 50 03 10 80 00 04 20 00 01 08 40 00 02 10 80 00", (i % 4) "4"
    if (i % 4 == 0) print start + 5030, "03 C0 2E"
    if (i % 4 == 0 && i != 8) { print start + 5690, "83 80 38"; print start + 6350, "43 00 7D" }
    if (i == 8) print start + 5690, "83 80"
    if (i % 4 == 3) { print start + 5030, "1B 49 29"; print start + 5690, "9B 04 D2"; print start + 6350, "5B 05 DC" }
  }
}' >"$work/line.txt"

"$SBUS" telemetry "$work/line.txt" --sensor 1=sbs-01v --sensor 24=F1678 >"$work/rows"
cat >"$work/wanted" <<'END'
time_s,slot,data0,data1,quantity,value,unit
0.005390,0,192,46,receiver voltage,4.6,V
0.006050,1,128,56,battery voltage,5.6,V
0.006710,2,0,125,external voltage,12.5,V
0.050390,24,73,41,current,23.45,A
0.051050,25,4,210,voltage,12.34,V
0.051710,26,5,220,charge,1500,mAh
END
head -n 7 "$work/rows" | diff "$work/wanted" -
verdict $? "telemetry prints slots, and the quantities of named sensors"
[ "$(cut -d, -f2 "$work/rows" | tr '\n' ' ')" = "slot 0 1 2 24 25 26 0 1 2 24 25 26 24 25 26 0 1 2 24 25 26 0 1 2 24 25 26 " ]
verdict $? "telemetry does not print a group that lacks a character, but one that ends the line"

[ "$("$SBUS" telemetry "$work/line.txt" --to 0.04 | tail -n 1)" = "0.006710,2,0,125,,," ]
verdict $? "telemetry prints no quantity for a slot without a name"

grep -v '^#' recordings/paper.txt >"$work/paper.txt"
"$SBUS" telemetry "$work/paper.txt" >"$work/out" 2>"$work/err"
[ $? -eq 1 ] && grep -qxF "sbus telemetry: $work/paper.txt: no frame announces a telemetry slot: this is not an S.BUS2 line" "$work/err"
verdict $? "telemetry fails on a line without telemetry"
sed '/^[0-9]* \(03\|83\|43\|1B\|9B\|5B\)/d' "$work/line.txt" >"$work/silent.txt"
"$SBUS" telemetry "$work/silent.txt" >"$work/out" 2>"$work/err"
[ $? -eq 1 ] && grep -qxF "sbus telemetry: $work/silent.txt: no telemetry slot follows the frames: is the receiver in a mode with telemetry?" "$work/err"
verdict $? "telemetry fails on an S.BUS2 line without answers"

while IFS='|' read -r sensor words; do
  "$SBUS" telemetry "$work/line.txt" --sensor "$sensor" >"$work/out" 2>"$work/err"
  [ $? -eq 2 ] && [ ! -s "$work/out" ] && grep -qF -- "$words" "$work/err"
  verdict $? "telemetry --sensor $sensor is rejected: $words"
done <<'END'
1=SBS-01X|is not a known sensor; these are: receiver, SBS-01T
SBS-01V|is not a slot and name, such as 1=SBS-01V
32=SBS-01V|slots are 0 to 31
x=SBS-01V|is not a slot and name
6=F1678|F1678 has 3 slots, which do not fit into the group of slots 0 to 7 from slot 6 on
9=F1675|F1675 has 8 slots
0=SBS-01V|slot 0 is a slot of receiver
END

"$SBUS" hex "$work/line.txt" | awk '/83 80/ { sub(/^.*- /, ""); print }' >"$work/out"
printf '%s\n' 'telemetry slots 0, 1, 2' 'telemetry slots 0, 1, 2' 'no header' 'telemetry slots 0, 1, 2' 'telemetry slots 0, 1, 2' | diff - "$work/out"
verdict $? "hex names the slots, and rejects a group that lacks characters"

"$SBUS" doctor "$work/line.txt" >"$work/out"
grep -qF '20 frames, 81 bytes of telemetry, 5 discarded bytes' "$work/out" && grep -qxF 'Telemetry: receiver voltage 4.6 V; slots 0, 1, 2, 24, 25, 26; 1 of 10 groups rejected: a byte is missing or too many, or two sensors share a slot' "$work/out"
verdict $? "doctor names slots and the receiver's voltage, and counts rejected groups and bytes that are neither a frame nor telemetry"

# A break, 00, after each transmission.
while IFS='|' read -r slots expected finding telemetry; do
  awk -v slots="$slots" 'BEGIN { for (i = 0; i < 80; i++) {
    print 120 + 15000 * i, "0F 11 04 20 A8 01 08 16 50 03 10 80 00 04 20 00 01 08 40 00 02 10 80 00", (i % 4) "4 00"
    if (i % 4 == 0) print 5150 + 15000 * i, slots } }' >"$work/breaks.txt"
  "$SBUS" doctor "$work/breaks.txt" >"$work/out"
  [ $? -eq "$expected" ] && grep -qxF "$finding" "$work/out" && grep -qxF "Telemetry: $telemetry" "$work/out"
  verdict $? "doctor, breaks and after 04 the bytes $slots: $finding"
done <<'END'
03 C0 2E 00|0|All well, and other bytes come between the frames.|receiver voltage 4.6 V; slot 0
03 C0|1|Telemetry rejected: the frames are good, but the bytes after them are not just slots.|19 of 19 groups rejected: a byte is missing or too many, or two sensors share a slot
END

{ cat "$work/line.txt"; awk 'BEGIN { for (i = 20; i < 120; i++) print 120 + 15000 * i, "0F 11 04 20 A8 01 08 16 50 03 10 80 00 04 20 00 01 08 40 00 02 10 80 00", (i % 4) "4" }'; } >"$work/long.txt"
"$SBUS" monitor "$work/long.txt" --sensor 24=F1678 >"$work/out"
grep -qF 'bytes discarded 5, ' "$work/out" &&
  grep -qF 'receiver voltage 4.6 V, current 23.45 A, voltage 12.34 V, charge 1500 mAh, slots 0, 1, 2, 24, 25, 26, no end byte ' "$work/out" &&
  tail -n 1 "$work/out" | grep -qF ', no telemetry, '
verdict $? "monitor shows telemetry until it is a second old"

"$SBUS" telemetry sim:sbus2 --simulated-time --seconds 0.1 --sensor 1=SBS-01V | cut -d, -f2,5-7 | tail -n +2 | tr '\n' ';' >"$work/sim"
echo "0,receiver voltage,4.6,V;1,battery voltage,5.6,V;2,external voltage,12.5,V;0,external voltage,24.1,V;\
1,battery voltage,5.6,V;2,external voltage,12.5,V;" | tr -d '\n' | diff - "$work/sim"
verdict $? "telemetry prints the slots of the built-in receiver sim:sbus2, and of its sensor"
