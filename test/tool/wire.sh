#!/bin/sh
# Runs `sbus decode` and `sbus wave`, and says "ok ..." or "FAILED ...". An independent decoder, sigrok's uart, also reads
# each recording's VCD, and must find the same bytes.
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

# The rows of frames, or of characters, in the table of decode.
rows() { grep -E '^ +[0-9.]+  +[0-9A-F]' "$@"; }
decoded() { "$SBUS" decode "$@" | rows; }
golden=$work/golden
rows tool/golden/decode-sbus2.table >"$golden"

# Prints what sigrok's uart decodes from a VCD, one byte a line.
sigrok() {  # VCD BAUD INVERTED [ANNOTATION]
  sigrok-cli -I vcd -i "$1" -P "uart:rx=SBUS:baudrate=$2:parity=even:stop_bits=1.0:invert_rx=$3:format=hex" -A "uart=${4:-rx-data}" |
    sed 's/.* //'
}

# sigrok-cli must be able to read the file; some builds have no decoders.
if ! "$SBUS" wave recordings/paper.txt -o "$work/try.vcd" || ! sigrok "$work/try.vcd" 100000 yes 2>/dev/null | grep -q 0F; then
  echo "skipped sbus: no sigrok-cli with its uart decoder is here"
  have_sigrok=
else
  have_sigrok=yes
fi

# waved RECORDING BAUD INVERTED OPTIONS...: its VCD holds its bytes
waved() {
  recording=$1 baud=$2 inverted=$3
  shift 3
  bytes "${recording%:*}" >"$work/bytes"
  "$SBUS" wave "$recording" --baud "$baud" "$@" -o "$work/wire.vcd" &&
    decoded "$work/wire.vcd" --characters | awk '{ print $2 }' | cmp - "$work/bytes"
  verdict $? "decode reads the wave of $recording, $baud baud, inverted: $inverted"
  [ -n "$have_sigrok" ] || return
  sigrok "$work/wire.vcd" "$baud" "$inverted" | cmp - "$work/bytes"
  verdict $? "sigrok reads the wave of $recording, $baud baud, inverted: $inverted"
}
for recording in recordings/*.txt recordings/slow/*.txt; do
  waved "$recording" 100000 yes
done
waved recordings/sbus2.txt 200000 yes
waved recordings/sbus2.txt:uninverted 100000 no

sed 's/ 1F / 1F! /' recordings/paper.txt >"$work/bad.txt"
"$SBUS" wave "$work/bad.txt" >"$work/bad.vcd" &&
  [ "$("$SBUS" decode "$work/bad.vcd" --characters | grep -c '  1F  parity error, .* expected$')" -eq "$(grep -c '!' "$work/bad.txt")" ]
verdict $? "a character with an error in a recording has a wrong parity bit on the wire"
if [ -n "$have_sigrok" ]; then
  [ "$(sigrok "$work/bad.vcd" 100000 yes rx-parity-err | wc -l)" -eq "$(grep -c '!' "$work/bad.txt")" ]
  verdict $? "sigrok also finds the wrong parity bit"
fi

# Frames of S.BUS2.
"$SBUS" wave recordings/sbus2.txt -o "$work/sbus2.vcd"
(cd "$work" && "$SBUS" decode sbus2.vcd) | cmp - tool/golden/decode-sbus2.table
verdict $? "decode prints tool/golden/decode-sbus2.table"

awk '$1 >= 150 && $1 <= 400' "$golden" >"$work/part.want"
decoded "$work/sbus2.vcd" --from 0.15 --to 0.4 | cmp - "$work/part.want" && [ "$(wc -l <"$work/part.want")" -gt 5 ]
verdict $? "decode --from --to prints the frames of a part: $(wc -l <"$work/part.want") lines"
! "$SBUS" decode "$work/sbus2.vcd" --from 5 >"$work/out" 2>"$work/err" && grep -qE '^sbus decode: .*: has no characters there; it has characters from 0.*' "$work/err"
verdict $? "decode of an empty part says what there is: $(cat "$work/err")"

# A line of 32 channels: half of them are in frames with header 2F, each half under its own title.
"$SBUS" record sim:32 --simulated-time --seconds 0.3 -o "$work/32.txt" 2>/dev/null && "$SBUS" wave "$work/32.txt" -o "$work/32.vcd" &&
  "$SBUS" hex "$work/32.vcd" --json | sed -n 's/.*"channels":\[\([0-9,]*\)\].*/\1/p' | tr , ' ' >"$work/32.want" &&
  decoded "$work/32.vcd" | awk '{ row = $2; for (i = 3; i <= 17; i++) row = row " " $i; print row }' | cmp - "$work/32.want" &&
  [ "$("$SBUS" decode "$work/32.vcd" | grep -c ' CH17 .* CH32   DG1  DG2  end$')" -ge 10 ]
verdict $? "decode prints 32 channels: $(wc -l <"$work/32.want") frames"

# The last frame waits for the silence after it: the capture ends with an edge.
awk 'NF == 26 { print; exit }' recordings/frsky-neutral.txt >"$work/one.txt"
"$SBUS" wave "$work/one.txt" | sed '$d' >"$work/one.vcd"
[ "$(decoded "$work/one.vcd" | wc -l)" -eq 1 ]
verdict $? "decode finds a single frame"

# In a capture without a frame no signal carries S.Bus: decode fails, and says what it looked for.
echo '120 0F E3 03 1F 2B C0 C7 0A' >"$work/eight.txt" && "$SBUS" wave "$work/eight.txt" -o "$work/eight.vcd"
"$SBUS" decode "$work/eight.vcd" >"$work/out" 2>"$work/err"
[ $? -eq 1 ] && ! grep -q 'carries S.Bus' "$work/out" &&
  grep -q 'signal SBUS has 8 characters at 100000 baud, 8E2, inverted, but no frame of S.Bus: a frame is 25 characters' "$work/err"
verdict $? "decode of a capture without a frame fails, and says what a frame is"
"$SBUS" decode "$work/eight.vcd" --characters >/dev/null
verdict $? "decode --characters needs no frame"

# Options overrule what decode finds.
overruled() {  # FRAMES ARGUMENTS...
  frames=$1
  shift
  [ "$(decoded "$@" 2>/dev/null | wc -l)" -eq "$frames" ]
  verdict $? "decode $* has $frames frames"
}
all=$(wc -l <"$golden")
overruled "$all" "$work/sbus2.vcd"
overruled "$all" "$work/sbus2.vcd" --baud 100000
overruled 0 "$work/sbus2.vcd" --baud 200000
awk '/^#/ { for (us = substr($0, 2) + 0; at < us; at++) print level }
  /^[01]!/ { level = substr($0, 1, 1) }' "$work/sbus2.vcd" | sed 1d >"$work/samples.csv"
sed 's/.*/&.5/; 1s/^/volt\n/' "$work/samples.csv" >"$work/volts.csv"
overruled 0 "$work/samples.csv"
overruled "$all" "$work/samples.csv" --sample-rate 1000000
overruled "$all" "$work/volts.csv" --sample-rate 1e6
overruled "$all" "$work/volts.csv" --sample-rate 1e6 --threshold 1.4
overruled 0 "$work/volts.csv" --sample-rate 1e6 --threshold 1.6

(cat "$work/sbus2.vcd"; printf '#') | "$SBUS" decode - >"$work/out" 2>"$work/err"
[ $? -eq 1 ] && rows "$work/out" | cmp - "$golden" &&
  grep -qx "sbus decode: -:$(($(wc -l <"$work/sbus2.vcd") + 1)): the capture ends within this line: .* decoded above" "$work/err"
verdict $? "decode of a truncated capture on standard input prints its frames, and fails"
(cat "$work/sbus2.vcd"; echo '#') | "$SBUS" decode - >"$work/out" 2>"$work/err"
[ $? -eq 1 ] && ! grep -q 'ends within' "$work/err"
verdict $? "decode reports a last line that is wrong, but complete"

# Standard input that stays open: frames come before its end, of a VCD and of CSV; here of 4 times the capture, far less than a
# block.
begin=$(sed -n '1,/^#/p' "$work/sbus2.vcd" | sed '$d')
awk '!/^#/ && !lines { next } { line[lines++] = $0 } /^#/ { end = substr($0, 2) + 0 }
  END {
    for (; from < 4 * end; from += end) {
      for (i = 0; i < lines - 1; i++) print line[i] ~ /^#/ ? "#" from + substr(line[i], 2) : line[i]
    }
  }' "$work/sbus2.vcd" >"$work/body"
(echo "$begin"; cat "$work/body") >"$work/live.vcd"
awk 'BEGIN { print "Time [s],SBUS" } /^#/ { us = substr($0, 2) } /^[01]!/ { printf "%.6f,%s\n", us / 1e6, substr($0, 1, 1) }' \
  "$work/live.vcd" >"$work/live.csv"
for capture in live.vcd live.csv; do
  rm -f "$work/fifo"
  mkfifo "$work/fifo"
  "$SBUS" decode - <"$work/fifo" >"$work/live.out" &
  decoder=$!
  exec 7>"$work/fifo"
  cat "$work/$capture" >&7
  until_true has_lines 11 "$work/live.out" && kill -0 $decoder
  early=$?
  exec 7>&-
  wait $decoder && [ $early -eq 0 ] && "$SBUS" decode "$work/$capture" | sed '$d' >"$work/wanted" && sed '$d' "$work/live.out" | cmp - "$work/wanted"
  verdict $? "decode of standard input prints the frames of $capture as they arrive"
done

# Packed, in a file and through a pipe; if it is cut off, decode prints what came before.
for capture in sbus2.vcd live.csv; do
  gzip -c "$work/$capture" >"$work/$capture.gz"
  decoded "$work/$capture" >"$work/plain" && decoded "$work/$capture.gz" | cmp - "$work/plain" &&
    gzip -c "$work/$capture" | decoded - | cmp - "$work/plain"
  verdict $? "decode reads $capture.gz"
done
(echo '; Samplerate: 1 MHz'; echo logic; cat "$work/samples.csv" "$work/samples.csv") >"$work/long.csv"
decoded "$work/long.csv" >"$work/plain"
gzip -c "$work/long.csv" >"$work/long.gz"
head -c $(($(wc -c <"$work/long.gz") * 9 / 10)) "$work/long.gz" >"$work/cut.gz"
"$SBUS" decode "$work/cut.gz" >"$work/all" 2>"$work/err"
[ $? -eq 1 ] && rows "$work/all" >"$work/out" && [ "$(wc -l <"$work/out")" -gt 10 ] && head -n "$(wc -l <"$work/out")" "$work/plain" | cmp - "$work/out" &&
  grep -qx "sbus decode: $work/cut.gz: cannot be read to its end (truncated gzip input); the part before it is decoded above" "$work/err"
verdict $? "decode of a truncated .gz prints the part before, and fails"

# Sessions of sigrok and PulseView. Real sessions (sigrokproject/sigrok-dumps) have their entries in each of these orders.
session() {  # FILE ENTRY...: logic-1 has all samples, logic-1-N a part of them
  python3 - "$work" "$@" <<'EOF'
import sys, zipfile
work, file, *entries = sys.argv[1:]
samples = bytes(int(level) << 4 for level in open(work + "/samples.csv").read().split())
size = len(samples) // max(1, sum(entry.startswith("logic-1-") for entry in entries)) + 1
with zipfile.ZipFile(work + "/" + file, "w", zipfile.ZIP_DEFLATED) as session:
    for entry in entries:
        part = int(entry[8:] or 0) if entry.startswith("logic-1") else 0
        session.writestr(entry, {
            "version": "2",
            "metadata": "[global]\nsigrok version=0.5.2\n\n[device 1]\ncapturefile=logic-1\ntotal probes=8\n"
                        "samplerate=1 MHz\ntotal analog=0\nprobe5=SBUS\nunitsize=1\n",
            "logic-1": samples}.get(entry, samples[size * (part - 1):size * part]))
EOF
}
decoded "$work/samples.csv" --sample-rate 1e6 >"$work/plain"
sessions=0
while read -r entries; do
  sessions=$((sessions + 1))
  # shellcheck disable=SC2086
  session $sessions.sr $entries && decoded "$work/$sessions.sr" | cmp - "$work/plain" &&
    decoded - <"$work/$sessions.sr" | cmp - "$work/plain"
  verdict $? "decode reads a session: $entries"
done <<'EOF'
version metadata logic-1-1 logic-1-2 logic-1-3 logic-1-4 logic-1-5 logic-1-6 logic-1-7 logic-1-8 logic-1-9 logic-1-10 logic-1-11
version logic-1 metadata
logic-1-6 logic-1-7 logic-1-8 logic-1-9 metadata logic-1-10 logic-1-11 version logic-1-1 logic-1-2 logic-1-3 logic-1-4 logic-1-5
EOF
cat "$work/2.sr" | decoded - | cmp - "$work/plain"
verdict $? "decode reads a session through a pipe"
session other.zip version logic-1
! "$SBUS" decode "$work/other.zip" 2>"$work/err" &&
  grep -qx "sbus decode: $work/other.zip: is a ZIP of several files, but not a session of sigrok or PulseView: unpack it, and name one" "$work/err"
verdict $? "decode rejects a ZIP that is not a session"
session empty.sr version metadata
! "$SBUS" decode "$work/empty.sr" 2>"$work/err" &&
  grep -qx "sbus decode: $work/empty.sr: has no samples: logic-1 or logic-1-1 is expected in it" "$work/err"
verdict $? "decode rejects a session without samples"
head -c $(($(wc -c <"$work/1.sr") * 2 / 3)) "$work/1.sr" >"$work/cut.sr"
"$SBUS" decode "$work/cut.sr" >"$work/all" 2>"$work/err"
[ $? -eq 1 ] && rows "$work/all" >"$work/out" && [ "$(wc -l <"$work/out")" -gt 3 ] && head -n "$(wc -l <"$work/out")" "$work/plain" | cmp - "$work/out" &&
  grep -q "cut.sr: cannot be read to its end (.*; the part before it is decoded above" "$work/err"
verdict $? "decode reports a truncated session"
if [ -n "$have_sigrok" ]; then
  sigrok-cli -I vcd -i "$work/sbus2.vcd" -o "$work/sigrok.sr" && decoded "$work/sigrok.sr" |
    cmp - "$golden"
  verdict $? "decode reads a session written by sigrok"
  for form in csv vcd; do
    sigrok-cli -i "$work/sigrok.sr" -O $form | decoded - | cmp - "$golden"
    verdict $? "decode reads the output of sigrok-cli -O $form"
  done
  sigrok-cli -I vcd -i "$work/sbus2.vcd" -O csv >"$work/meta.csv" && grep -q '^META samplerate' "$work/meta.csv" && decoded "$work/meta.csv" | cmp - "$golden"
  verdict $? "decode reads sigrok-cli's CSV with the line META samplerate in it"
fi

# The tables of Saleae's analyser say nothing about the wire.
decoded "$work/sbus2.vcd" --characters >"$work/characters"
awk 'BEGIN { print "Time [s],Value,Parity Error,Framing Error" } { printf "%.15f,0x%s,,\n", $1 / 1e3, $2 }' "$work/characters" >"$work/logic1.csv"
awk 'BEGIN { print "name,type,start_time,duration,\"data\",\"error\"" }
  { printf "\"Async Serial\",\"data\",%.9g,0.000115,0x%s,\n", $1 / 1e3, $2 }' "$work/characters" >"$work/logic2.csv"
for capture in logic1.csv logic2.csv; do
  decoded "$work/$capture" | cmp - "$golden" &&
    [ "$("$SBUS" decode "$work/$capture" | head -n 1)" = 'signal Async Serial carries S.Bus, as decoded by the analyser' ]
  verdict $? "decode reads the characters of $capture"
done
[ "$(sed '30s/,,$/,Error,Error/' "$work/logic1.csv" | "$SBUS" decode - --characters | grep -c '  parity error; framing error$')" -eq 1 ]
verdict $? "decode shows both errors of a character marked by Saleae's analyser"

# The last line but one is the last edge of the last character: the capture ended there, or more was lost.
sed '$d' "$work/sbus2.vcd" >"$work/edge.vcd"
(cat "$work/edge.vcd"; printf '#') | decoded - --characters >"$work/out" 2>"$work/err"
decoded "$work/edge.vcd" --characters | sed '$d' | cmp - "$work/out"
verdict $? "decode leaves out the last character of a capture that may have lost its end"

# A sample every 4 us, of bits of 10 us.
awk 'BEGIN { print "; Samplerate: 250 kHz\nlogic" }
  /^#/ { for (us = substr($0, 2) + 0; at < us; at += 4) print level }
  /^[01]!/ { level = substr($0, 1, 1) }' "$work/sbus2.vcd" >"$work/slow.csv"
"$SBUS" decode "$work/slow.csv" >"$work/out" 2>"$work/err"
[ $? -eq 1 ] && [ "$(rows "$work/out" | wc -l)" -eq "$(wc -l <"$golden")" ] &&
  grep -qx "sbus decode: $work/slow.csv: was sampled every 4.0 us, but a bit lasts 10.0 us: .* What could be decoded is above" "$work/err"
verdict $? "decode of a capture sampled too slowly prints its frames, and fails"
# A file that is read piece by piece: the capture, repeated, up to a line that is wrong.
awk '!/^#/ && !lines { print; next } { line[lines++] = $0 } /^#/ { end = substr($0, 2) + 0 }
  END {
    for (; from < 120 * end; from += end) {
      for (i = 0; i < lines - 1; i++) print line[i] ~ /^#/ ? "#" from + substr(line[i], 2) : line[i]
    }
    print "#"
  }' "$work/sbus2.vcd" >"$work/large.vcd"
decoded "$work/large.vcd" --characters 2>"$work/err" >"$work/out"
[ "$(wc -l <"$work/out")" -eq $((120 * $(wc -l <"$work/characters") - 1)) ] && [ "$(wc -c <"$work/large.vcd")" -gt 2000000 ] &&
  grep -q "large.vcd:$(wc -l <"$work/large.vcd"): " "$work/err"
verdict $? "decode finds every character of a capture of 2 MB, and reports its last line"
