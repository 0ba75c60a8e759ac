#!/bin/sh
# What `sbus` does on any system: Linux, macOS, Windows. Says "ok ..." or "FAILED ..."; fails if something has.
# SBUS: the program, absolute, or a command such as "wine sbus.exe"; WORK: an absolute folder for what is written.
set -u
cd "$(dirname "$0")/.." || exit 1
work=$WORK/systems
rm -rf "$work"
mkdir -p "$work"
failed=0
verdict() {  # STATUS WHAT
  if [ "$1" -eq 0 ]; then echo "ok sbus: $2"; else echo "FAILED sbus: $2"; failed=1; fi
}
# shellcheck disable=SC2086  # SBUS is words
sbus() { $SBUS "$@"; }

grep -v '^#' tool/LINES >"$work/lines"
while read -r name arguments; do
  # shellcheck disable=SC2086  # the arguments are words
  sbus $arguments </dev/null >"$work/all" && tail -n 20 "$work/all" | cmp - "tool/golden/$name.txt"
  verdict $? "$arguments prints the same as tool/golden"
done <"$work/lines"

for recording in paper frsky-neutral sbus2; do
  file=recordings/$recording.txt
  tr -d '\r' <golden/AllChannels-$recording.csv >"$work/golden"
  sbus csv $file --columns ch1-ch18 | tail -n 20 | cmp - "$work/golden"
  verdict $? "csv prints the same as golden/AllChannels-$recording.csv"
  sbus hex $file >"$work/hex"
  sbus hex - <$file | cmp - "$work/hex" && cat $file | sbus hex - | cmp - "$work/hex" &&
    gzip -c $file | sbus hex - | cmp - "$work/hex"
  verdict $? "$file gives the same by name, on standard input, from a pipe, and packed"
  sbus hex --json $file | sbus csv - --every-frame >"$work/csv"
  sbus csv $file --every-frame | cmp - "$work/csv"
  verdict $? "$file gives the same as JSON lines from a pipe"
done

# 0A, 0D and 1A end lines and files of a text on Windows.
printf '\017\012\015\012\032\015\015\012\032\012\015\012\032\012\015\012\032\012\015\012\032\012\200\000\000' >"$work/frame"
cat "$work/frame" "$work/frame" "$work/frame" >"$work/line.bin"
bytes='0F 0A 0D 0A 1A 0D 0D 0A 1A 0A 0D 0A 1A 0A 0D 0A 1A 0A 0D 0A 1A 0A 80 00 00  frame end 00'
[ "$(sbus hex "$work/line.bin" | grep -c "$bytes")" -ge 2 ] && [ "$(cat "$work/line.bin" | sbus hex - --simulated-time | grep -c "$bytes")" -ge 2 ]
verdict $? "the bytes 0A, 0D and 1A stay unchanged"

sbus record sim -o "$work/record.txt" --seconds 1 && sbus summary "$work/record.txt" -o "$work/page.html" >"$work/summary" &&
  [ "$(tr -d '[:print:]\n' <"$work/record.txt" | wc -c)" -eq 0 ] && grep -q '</html>' "$work/page.html" &&
  [ "$(grep -vc '^#' "$work/record.txt")" -ge 50 ]
verdict $? "a recording has plain lines, and a page"
! sbus record sim -o "$work/record.txt" --seconds 1 2>"$work/err" && grep -q 'already exists' "$work/err"
verdict $? "a recording is not overwritten"
cp "$work/record.txt" "$work/copy.txt"
! sbus wave "$work/copy.txt" -o "$work/copy.txt" 2>"$work/err" && grep -q 'is also the input' "$work/err" && cmp "$work/record.txt" "$work/copy.txt" &&
  sbus wave "$work/copy.txt" -o "$work/wave.vcd" && sbus decode "$work/wave.vcd" >"$work/decode" && cat "$work/wave.vcd" | sbus decode - >"$work/piped"
sed '$d' "$work/decode" >"$work/one" && sed '$d' "$work/piped" | cmp - "$work/one" && [ "$(wc -l <"$work/one")" -ge 100 ]
verdict $? "a wave is decoded by name and from a pipe, and never overwrites its source"

exit $failed
