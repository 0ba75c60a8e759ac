#!/bin/sh
# Runs `sbus summary` on a flight with known losses, and subcommands with --from and --to on files. Says "ok ..." or
# "FAILED ...".
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

# Frame i ends at 1 s + 9 ms * i. Frames 10 to 12, 50 and 88 are lost, 60 to 79 have both flags, 89 only failsafe; frame 90
# comes 0.5 s later, frame 95 3 ms later, the last two have failsafe again.
awk 'BEGIN {
  for (i = 0; i < 100; i++) {
    end = 1000000 + 9000 * i + (i >= 90) * 500000 + (i >= 95) * 3000
    lost = i >= 10 && i <= 12 || i == 50 || i == 88 || i >= 60 && i < 80
    failsafe = i >= 60 && i < 80 || i == 89 || i >= 98
    print end - 24 * 120, "0F E5 03 1F F8 C0 07 3E F0 81 0F 7C E0 03 06 F8 80 91 3D F0 81 0F 7C", sprintf("%02X", lost * 4 + failsafe * 8), "00"
  }
}' >"$work/flight.txt"
# Times from the first frame, in ms.
relative() { awk -v zero="$1" '{ while (match($0, / [0-9]+\.[0-9]+ s to +[0-9.]+ s/)) { split(substr($0, RSTART, RLENGTH), word, " "); $0 = substr($0, 1, RSTART) sprintf("%.0f to %.0f ms", (word[1] - zero) * 1000, (word[4] - zero) * 1000) substr($0, RSTART + RLENGTH) } gsub(/ +/, " "); print }'; }
zero=$("$SBUS" hex "$work/flight.txt" | awk '{ print $1; exit }')
"$SBUS" summary "$work/flight.txt" | sed 's/^[^:]*flight.txt/FILE/' | relative "$zero" >"$work/text"
cat >"$work/wanted" <<'END'
FILE: S.BUS, 100 frames, 25 with the lost-frame flag, 23 in failsafe; 0 discarded bytes, 0 character errors
frames 0 to 1394 ms
failsafe 3 times, 0.189 s in all
 540 to 720 ms 0.180 s
 801 to 801 ms 0.000 s
 1385 to 1394 ms 0.009 s
lost frames 3 times, 0.045 s in all
 90 to 117 ms 0.027 s
 450 to 459 ms 0.009 s
 792 to 801 ms 0.009 s
no frames 1 time, 0.509 s in all
 801 to 1310 ms 0.509 s
intervals from the end of a frame to the end of the next, in ms
 9 97 ##################################################
 12 1 #
END
diff "$work/wanted" "$work/text"
verdict $? "summary of a flight has its losses"
"$SBUS" summary "$work/flight.txt" --json | sed 1d | sed 's/,"\(from\|to\)_us":[0-9]*//g' >"$work/json"
cat >"$work/wanted" <<'END'
{"type":"summary","line":"S.BUS","frames":100,"lost_frames":25,"failsafe_frames":23,"discarded_bytes":0,"character_errors":0}
{"type":"span","kind":"failsafe"}
{"type":"span","kind":"failsafe"}
{"type":"span","kind":"failsafe"}
{"type":"span","kind":"lost_frames"}
{"type":"span","kind":"lost_frames"}
{"type":"span","kind":"lost_frames"}
{"type":"span","kind":"no_frames"}
{"type":"interval","ms":9,"count":97}
{"type":"interval","ms":12,"count":1}
END
diff "$work/wanted" "$work/json"
verdict $? "summary --json of a flight has the same figures"
"$SBUS" hex --json "$work/flight.txt" | head -n 51 | head -c -10 >"$work/cut.json"
"$SBUS" summary "$work/cut.json" >"$work/text" 2>"$work/err"
[ $? -eq 1 ] && grep -q ': S.BUS, 49 frames, 3 with the lost-frame flag' "$work/text" && grep -q ' is not a JSON object' "$work/err" &&
  ! "$SBUS" summary "$work/cut.json" -o "$work/cut.html" 2>"$work/err" && [ -s "$work/cut.html" ]
verdict $? "summary of truncated JSON lines has the frames up to there, and fails"
sed 's/^[0-9]* /9&/' "$work/flight.txt" >"$work/late.txt"
{ "$SBUS" summary "$work/late.txt" && "$SBUS" hex "$work/late.txt" && "$SBUS" csv "$work/late.txt" --every-frame &&
  "$SBUS" watch "$work/late.txt" --when ok -o "$work/events" && "$SBUS" compare "$work/late.txt" "$work/late.txt"; } >"$work/text" 2>"$work/err"
[ $? -eq 0 ] && [ ! -s "$work/err" ] || { cat "$work/err"; false; }
verdict $? "a recording with times that begin late does not count as silent"

# ---- The report: the same flight as a page

"$SBUS" summary "$work/flight.txt" -o "$work/flight.html" && sed 's/<[^>]*>/ /g' "$work/flight.html" >"$work/words"
while read -r words; do
  grep -q "$words" "$work/words"
  verdict $? "the report has: $words"
done <<'END'
Failsafe 3 times, longest 0.2 s; no frames 1 time, longest 0.5 s; 25.00 % of the frames lost\.
1\.394 s long: 100 frames, 111\.. a second; 25 with the lost-frame flag, 0 missing, 23 in failsafe; 0 discarded bytes, 0 character errors
S\.BUS, 100000 baud, 8E2, inverted
Failsafe: 3 times, 0\.189 s in all
No frames: 1 time, 0\.509 s in all
Lost frames: 3 times, 0\.045 s in all
END
[ "$(grep -c '<rect class="failsafe" x=' "$work/flight.html")" -eq 2 ] && grep -q '<title>1.000 s: 41.4 % lost' "$work/flight.html" &&
  grep -q '<title>2.000 s: 76.7 % lost' "$work/flight.html"
verdict $? "the report's strip shows both seconds and their losses"
[ "$(grep -c 'class="curve ' "$work/flight.html")" -eq 4 ] && ! grep -q 'https*://' "$work/flight.html"
verdict $? "the report has four curves, and needs no other file"
"$SBUS" record sim -o "$work/well.txt" --simulated-time --seconds 9 2>"$work/err" && sed '/ 0[4-7] 00$/d' "$work/well.txt" >"$work/gaps.txt"
for line in 'gaps.txt|warning' 'well.txt|warning' 'clean.txt|good'; do
  case $line in clean*) awk '/^#/ { print; next } { $25 = "00"; print }' "$work/well.txt" >"$work/clean.txt" ;; esac
  "$SBUS" summary "$work/${line%|*}" -o - | grep -o 'class="verdict [a-z]*">[^<]*' | tee "$work/verdict" | grep -q "verdict ${line#*|}\""
  verdict $? "the report's verdict on ${line%|*}: $(sed 's/.*>//' "$work/verdict")"
done
[ "$("$SBUS" summary "$work/gaps.txt" -o - | grep -c '<rect class="lost"')" -ge 7 ]
verdict $? "the report's strip shows missing frames"
[ "$("$SBUS" summary sim --simulated-time --seconds 60 | grep -A 21 '^lost frames' | grep -c ' s to ')" -eq 20 ] &&
  "$SBUS" summary sim --simulated-time --seconds 60 | grep -qE '^lost frames +[0-9]+ times, .* s in all; the longest are$'
verdict $? "summary lists the twenty longest losses"
# A clean line of 9 ms; the PC is busy for 300 ms eleven times, and then reads at once what has come. Then the wire is cut for 0.5 s.
awk 'BEGIN {
  frame = "0F E5 03 1F F8 C0 07 3E F0 81 0F 7C E0 03 06 F8 80 91 3D F0 81 0F 7C 00 00"
  for (i = 0; i < 1500; i++) {
    end = 9000 * (i + 1) + (i >= 1450) * 500000
    read = i % 120 < 33 && i >= 120 && i < 1440 ? 9000 * (int(i / 120) * 120 + 33) - 3000 * (32 - i % 120) : end
    print read - 24 * 120 "~" (read > end || i % 120 == 32 && i >= 120 && i < 1440 ? 318000 : 35000), frame
  }
}' >"$work/stalls.txt"
"$SBUS" summary "$work/stalls.txt" | sed -E 's/^(PC late|no frames)( +[0-9]+ times?), [0-9.]+ s in all$/\1\2/' >"$work/text"
[ "$(grep -cE '^PC late +11 times$|^no frames +1 time$' "$work/text")" -eq 2 ] && grep -q ' 1500 frames, ' "$work/text" &&
  [ "$("$SBUS" summary --json "$work/stalls.txt" | grep -c '"kind":"late"')" -eq 11 ]
verdict $? "summary of a clean line read late by a busy PC has only the silence of a cut wire"
# Frames from 1 s to 2 s; before them, after them, or both, bytes that are none for 1 s.
for part in head tail both; do
  awk -v "part=$part" 'BEGIN {
    for (us = 120; us < 3000000; us += 9000) {
      second = int(us / 1000000)
      if (second == 1) print us, "0F E5 03 1F F8 C0 07 3E F0 81 0F 7C E0 03 06 F8 80 91 3D F0 81 0F 7C 00 00"
      else if (part == "both" || part == (second == 0 ? "head" : "tail")) print us, "55 AA 55 AA 55 AA 55"
    }
  }' >"$work/$part.txt"
  "$SBUS" summary "$work/$part.txt" -o - | sed -n 's/.*class="verdict bad">\([^<]*\)<.*/\1/p; s/^<p>\([0-9.]* s long\): .*/\1/p' >"$work/$part.words"
done
cat "$work/head.words" "$work/tail.words" "$work/both.words" >"$work/text"
cat >"$work/wanted" <<'END'
2.001 s long
No frames 1 time, longest 1.0 s, at the beginning; 0.00 % of the frames lost.
1.986 s long
No frames 1 time, longest 1.0 s, at the end; 0.00 % of the frames lost.
2.997 s long
No frames 2 times, longest 1.0 s, at the beginning and at the end; 0.00 % of the frames lost.
END
diff "$work/wanted" "$work/text" && "$SBUS" summary "$work/head.txt" | grep -A 1 '^no frames    1 time, 1.011 s in all' | grep -q ' 0.000 s to *1.011 s' &&
  "$SBUS" summary "$work/tail.txt" | grep -q '^finding      No frames at the end: for the last 0.9[89][0-9] s bytes come, but no frame.$'
verdict $? "bytes without a frame before the first one and after the last one count"
# Bytes of one length after the frames do not make the frames wrong; and one byte does not make a silence a line.
{ cat "$work/clean.txt"; awk 'END { for (us = $1; us < 1e6 + $1; us += 9000) { printf us + 9000; for (i = 0; i < 25; i++) printf " 00"; print "" } }' "$work/clean.txt"; } >"$work/zeros.txt"
{ cat "$work/clean.txt"; awk 'END { print $1 + 3e6, "00" }' "$work/clean.txt"; } >"$work/stray.txt"
for name in zeros stray; do "$SBUS" summary "$work/$name.txt" | grep '^finding'; done | sed -E 's/[0-9]\.[0-9]+ s/S/' >"$work/text"
printf 'finding      No frames at the end: for the last S %s.\n' 'bytes come, but no frame' 'the line is silent' | diff - "$work/text"
verdict $? "a flight that ends in bytes of one length, or in a silence with a byte in it, is named for what it is"
# A capture whose wire goes silent before its end: an edge of another signal tells that it goes on.
"$SBUS" wave "$work/clean.txt" -o "$work/clean.vcd" && sed 's/^\$enddefinitions/$var wire 1 x OTHER $end\n&/; $a#12000000\n0x' "$work/clean.vcd" >"$work/silent.vcd"
"$SBUS" summary "$work/silent.vcd" >"$work/text"; "$SBUS" doctor "$work/silent.vcd" >>"$work/text"
grep -qE '^finding      No frames at the end: for the last (2.9[0-9]*|3.0[0-9]*) s the line is silent.$' "$work/text" &&
  grep -qE '^Frames stop: for the last (2.9|3.0) s the line is silent.$' "$work/text" || { cat "$work/text"; false; }
verdict $? "a wire that falls silent before its capture ends has no frames there, for summary and doctor"
# The same frames as in test/scope/held.mjs: 150 lost ones in a row are failsafe from the hundredth on.
awk 'BEGIN {
  for (i = 0; i < 160; i++) {
    print 9000 * (i + 1), "0F E5 03 1F F8 C0 07 3E F0 81 0F 7C E0 03 06 F8 80 91 3D F0 81 0F 7C", i < 10 ? "00" : "04", "00"
  }
}' >"$work/losses.txt"
"$SBUS" csv "$work/losses.txt" --every-frame --columns failsafe | awk '$1 == 1 { count++; first = first ? first : NR } END { exit !(count == 51 && first == 110) }' &&
  "$SBUS" summary "$work/losses.txt" | grep -A 1 '^failsafe  *1 time, 0.450 s in all$' | grep -qE '^ +0.993 s to +1.443 s'
verdict $? "csv and summary agree on failsafe after too many lost frames"
cut -d' ' -f2- "$work/flight.txt" >"$work/bytes.txt"
[ "$("$SBUS" summary "$work/bytes.txt" 2>"$work/err")" = "$work/bytes.txt: S.BUS, 100 frames, 25 with the lost-frame flag, 23 in failsafe; 0 discarded bytes, 0 character errors
frames       -, times are not known" ]
verdict $? "summary of bytes without times has no times"
"$SBUS" summary sim:silent --simulated-time --seconds 1 2>"$work/err"
[ $? -eq 1 ] && grep -qx 'sbus summary: sim: no frames received; run sbus doctor' "$work/err"
verdict $? "summary without a frame fails"

# ---- Parts of a file

"$SBUS" record sim -o "$work/sim.txt" --simulated-time --seconds 12 2>"$work/err"
"$SBUS" wave "$work/sim.txt" -o "$work/sim.vcd"
for file in sim.txt sim.vcd; do
  "$SBUS" hex "$work/$file" | awk '$1 - 0.003 >= 9.305 && $1 <= 10.697 && / frame end /' >"$work/wanted" && [ "$(wc -l <"$work/wanted")" -ge 150 ] &&
    "$SBUS" hex "$work/$file" --from 9.305 --to 10.697 | grep ' frame end ' | cmp - "$work/wanted"
  verdict $? "hex --from --to of $file has the frames of that time, and their times"
  "$SBUS" csv "$work/$file" --columns time,ch1-ch18,failsafe | awk -F, '$1 > 9.5 && $1 <= 10.7' >"$work/wanted" && [ -s "$work/wanted" ] &&
    "$SBUS" csv "$work/$file" --columns time,ch1-ch18,failsafe --from 9.3 --to 10.7 | awk -F, '$1 > 9.5 && $1 <= 10.7' | cmp - "$work/wanted"
  verdict $? "csv --from --to of $file has the frames of that time"
done
# 1.001 times 1e6 is less than 1001000 in floating point.
awk 'BEGIN { for (us = 1001000; us < 1100000; us += 9000) printf "{\"type\":\"frame\",\"time_us\":%d,\"channels\":[0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15]}\n", us }' >"$work/even.json"
"$SBUS" hex "$work/even.json" | awk '{ print $1 }' >"$work/wanted"
while read -r time; do "$SBUS" hex "$work/even.json" --to "$time" | awk 'END { print $1 }'; done <"$work/wanted" | cmp - "$work/wanted" && has_lines 11 "$work/wanted"
verdict $? "--to with a time that hex prints includes the frame of that time"
"$SBUS" summary "$work/sim.txt" --from 5 --seconds 1 | grep -qE '^frames +5\.0[0-9]* s to 5\.99[0-9] s$' &&
  "$SBUS" summary "$work/sim.txt" --to 1 | grep -qE '^frames +0\.0[0-9]* s to 0\.99[0-9] s$'
verdict $? "--from with --seconds, and --to alone, take a part of a file"
"$SBUS" monitor "$work/sim.txt" --from 11 2>"$work/err" | sed -n 1p | grep -q '^11\.000 ' && [ ! -s "$work/err" ]
verdict $? "monitor --from begins at that time"
"$SBUS" monitor "$work/sim.txt" --from 9.95 --to 11 --simulated-time | cut -d' ' -f1,3 | paste -sd ' ' | grep -qE '^9.950 never 9.9[0-9]* lossy 10.000 lossy 10.0[0-9]* failsafe 11.000 '
verdict $? "monitor --from --to prints a line a second"
"$SBUS" hex "$work/sim.txt" --from 11 2>&1 >"$work/out" | cmp - /dev/null
verdict $? "--from of a file reports no silence"

# ---- Raw 0 without a flag, for a second

awk 'BEGIN { for (i = 0; i < 400; i++) printf "{\"type\":\"frame\",\"time_us\":%d,\"channels\":[%s992,992,992,992,992,992,992,992,992,992,992,992]}\n", 9000 * i + 4000, (i >= 200 && i < 311 ? "0,0,0,0," : "992,992,172,992,") }' >"$work/pulses.json"
"$SBUS" summary "$work/pulses.json" >"$work/out" && grep -A 1 '^no pulses' "$work/out" | paste -sd ' ' | grep -qx 'no pulses    1 time, 0.999 s in all          1.804 s to      2.803 s      0.999 s' &&
  "$SBUS" summary "$work/pulses.json" --json | grep -qx '{"type":"span","kind":"no_pulses","from_us":1804000,"to_us":2803000}' &&
  "$SBUS" summary "$work/pulses.json" -o - | grep -q 'No pulses (0 on CH1 to CH4, without a flag) 1 time, longest 1.0 s' || { cat "$work/out"; false; }
verdict $? "summary lists 0 on CH1 to CH4 without a flag: $(grep -A 1 '^no pulses' "$work/out" | tr -s ' ')"
(cd "$work" && "$SBUS" watch pulses.json --when nopulses -o pulses --before 0 --after 0 --json) >"$work/out" 2>"$work/err"
[ "$(sed -n 's/.*"event","time_us":\([0-9]*\).*"kind":"\([a-z]*\)".*/\1 \2/p' "$work/out" | paste -sd ,)" = "1804000 begin,2803000 end" ] || { cat "$work/out" "$work/err"; false; }
verdict $? "watch --when nopulses records them"
