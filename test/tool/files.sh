#!/bin/sh
# Runs `sbus` on files that are not recordings: captures of the wire, and bytes without times. Says "ok ..." or "FAILED ...".
# The captures are made by `sbus wave`, which wire.sh tests; decoded, they must hold what the recordings hold.
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

# ---- Captures

for recording in paper sbus2 frsky-neutral; do
  for idle in 0 1; do
    file=$work/$recording-$idle
    "$SBUS" wave "recordings/$recording.txt$([ $idle = 0 ] || echo :uninverted)" >"$file.vcd"
    awk 'BEGIN { print "Time [s],Channel 0" } /^#/ { us = substr($0, 2) } /^[01]!/ { printf "%.6f,%s\n", us / 1e6, level = substr($0, 1, 1) }
      END { printf "%.6f,%d\n", us / 1e6, 1 - level }' "$file.vcd" >"$file.csv"
    for form in vcd csv; do
      for subcommand in 'hex' 'csv --every-frame --columns time,ch1-ch18,failsafe'; do
        # shellcheck disable=SC2086  # the arguments are words
        "$SBUS" $subcommand recordings/$recording.txt >"$work/wanted" && "$SBUS" $subcommand "$file.$form" | cmp - "$work/wanted" && [ -s "$work/wanted" ]
        verdict $? "$subcommand of $recording as $form, idle $idle, prints the same as for the recording"
      done
    done
  done
done
"$SBUS" doctor "$work/frsky-neutral-1.vcd" >"$work/doctor" 2>"$work/err" && [ ! -s "$work/err" ] && grep -qx 'All well.' "$work/doctor" &&
  tail -n 1 "$work/doctor" >"$work/last" &&
  grep -q '^100000 baud, 8E2, not inverted: [1-9][0-9]* frames' "$work/doctor" && "$SBUS" doctor recordings/frsky-neutral.txt | tail -n 1 | cmp - "$work/last"
verdict $? "doctor of a capture names the wire's settings"
"$SBUS" monitor "$work/sbus2-0.vcd" --simulated-time >"$work/lines" &&
  "$SBUS" monitor recordings/sbus2.txt --simulated-time | cmp - "$work/lines" && [ "$(wc -l <"$work/lines")" -ge 2 ]
verdict $? "monitor shows a capture like its recording"
"$SBUS" record "$work/sbus2-0.vcd" -o "$work/recorded.txt" 2>"$work/err" && bytes recordings/sbus2.txt >"$work/wanted" &&
  bytes "$work/recorded.txt" | cmp - "$work/wanted"
verdict $? "record of a capture has the recording's bytes"
player send "$work/sbus2-1.csv"
"$SBUS" record "$terminal" -o "$work/replayed.txt" 2>"$work/err" && bytes "$work/replayed.txt" | cmp - "$work/wanted"
verdict $? "send of a capture sends the recording's bytes"
wait $player

"$SBUS" wave recordings/slow/"$(ls recordings/slow | head -n 1)" --baud 200000 >"$work/fast.vcd"
[ "$("$SBUS" hex "$work/fast.vcd" | grep -c ' frame end ')" -gt 3 ] && "$SBUS" doctor "$work/fast.vcd" | grep -q '^200000 baud, 8E2, inverted: '
verdict $? "a capture of Fast S.Bus needs no option"
! "$SBUS" csv "$work/fast.vcd" --baud 100000 >"$work/out" 2>"$work/err"
verdict $? "--baud overrules the baud rate found in a capture"

# decode -o writes the recording, and no table; it keeps what came before an error.
"$SBUS" decode "$work/sbus2-1.vcd" -o "$work/decoded.txt" >"$work/out" && bytes "$work/decoded.txt" | cmp - "$work/wanted" &&
  [ "$(grep -c . "$work/out")" -eq 2 ] && grep -q ' frames, ' "$work/out" && grep -qx '# 100000 baud, 8E2, not inverted' "$work/decoded.txt" &&
  "$SBUS" hex "$work/sbus2-1.vcd" >"$work/hex" && "$SBUS" hex "$work/decoded.txt" | cmp - "$work/hex"
verdict $? "decode -o writes a recording"
"$SBUS" decode "$work/sbus2-1.vcd" -o "$work/decoded.txt" 2>"$work/err" >"$work/out"
[ $? -eq 1 ] && grep -q 'decoded.txt: already exists; name another file' "$work/err"
verdict $? "decode -o does not overwrite a file"
(head -n 2000 "$work/sbus2-1.vcd"; echo '#x') >"$work/broken.vcd"
"$SBUS" decode "$work/broken.vcd" -o "$work/part.txt" >"$work/out" 2>"$work/err"
[ $? -eq 1 ] && bytes "$work/part.txt" >"$work/part" && [ "$(wc -l <"$work/part")" -gt 100 ] && head -n "$(wc -l <"$work/part")" "$work/wanted" | cmp - "$work/part"
verdict $? "decode -o keeps the part before an error in the capture"
"$SBUS" csv "$work/broken.vcd" >"$work/out" 2>"$work/err"
[ $? -eq 1 ] && grep -q "^sbus csv: $work/broken.vcd:2001: .*; sbus decode -o FILE keeps the part before it$" "$work/err"
verdict $? "an error in a capture is reported with its place"

# ---- Bytes without times

frame='0F E5 03 1F F8 C0 07 3E F0 81 0F 7C E0 03 06 F8 80 91 3D F0 81 0F 7C 00 00'
octal='\017\345\003\037\370\300\007\076\360\201\017\174\340\003\006\370\200\221\075\360\201\017\174\000\000'
note='bytes without times: times are not known, frames are assumed to be back to back'
# written NAME: standard input is a file whose bytes are two frames
written() {
  cat >"$work/$1"
  "$SBUS" record "$work/$1" -o "$work/$1.recording" 2>"$work/err" && grep -qxF "$work/$1: $note" "$work/err" &&
    bytes "$work/$1.recording" | paste -sd ' ' | grep -qxF "$frame $frame" &&
    [ "$("$SBUS" csv "$work/$1" --every-frame 2>"$work/err")" = "$(printf '997,992,992,992,0,0\n997,992,992,992,0,0')" ]
  verdict $? "bytes without times are read from $1"
}
# RealTerm's window wraps lines; its capture does not.
printf '%s %s' "$frame" "$frame" | fold -w 48 | written realterm.txt
for name in bytes.bin dump.RAW; do
  # shellcheck disable=SC2059  # the frame has no %
  printf "$octal$octal" | written $name
done
# The bytes of a line that was cut look like times; a second line shows that they are bytes.
printf '03 1F %s %s\n10 %s\n' "$frame" "$frame" "$frame" >"$work/cut.txt"
"$SBUS" record "$work/cut.txt" -o - 2>"$work/err" >"$work/cut.recording" && [ "$(bytes "$work/cut.recording" | wc -l)" -eq 78 ]
verdict $? "bytes without times are recognised even if a line begins with decimal digits"
printf '80 91 3D F0 81 0F 7C 00 00 %s %s %s\n' "$frame" "$frame" "$frame" >"$work/middle.txt"
[ "$("$SBUS" hex "$work/middle.txt" 2>"$work/err" | grep -c ' frame ')" -eq 3 ] && grep -qF 'times are not known' "$work/err"
verdict $? "bytes in a single line are recognised even if it begins with decimal digits, in the middle of a frame"
printf '30 0F E5\n' >"$work/time.txt"
"$SBUS" hex "$work/time.txt" 2>"$work/err" | grep -q '  0F E5  ' && [ ! -s "$work/err" ]
verdict $? "a single time of two digits is a time"
printf '%s %s\n' "$frame" "$frame" | sed 's/1F/1F!/' >"$work/bad.txt"
"$SBUS" hex "$work/bad.txt" 2>"$work/err" | grep -q ' 1F!.*parity or framing error (byte 3)$'
verdict $? "bytes without times may include one with an error"
"$SBUS" doctor "$work/bytes.bin" >"$work/out" 2>"$work/err"
[ $? -eq 0 ] && grep -qx '100000 baud, 8E2: 2 frames, 0 discarded bytes' "$work/out" && ! grep -q 'a second' "$work/out" && grep -qxF "$work/bytes.bin: $note" "$work/err"
verdict $? "doctor prints no times for bytes without times"

# Bytes that went through UTF-8 are rejected, in a file and in a pipe.
for i in 1 2 3 4; do
  # shellcheck disable=SC2059  # the frame has no %
  printf "$octal$octal"
done | iconv -f latin1 -t utf-8 >"$work/utf8.bin"
for file in "$work/utf8.bin" -; do
  # shellcheck disable=SC2002  # a pipe, not a file
  ! cat "$work/utf8.bin" | "$SBUS" hex "$file" >"$work/out" 2>"$work/err" && [ ! -s "$work/out" ] &&
    grep -qxF "sbus hex: $file: its bytes went through UTF-8: a program took them for text; write them to the file as they are" "$work/err"
  verdict $? "bytes that went through UTF-8 are rejected: ${file##*/}"
done

# Frames that lack a byte; no byte is 11 or 13. What they lack cannot be put back, and doctor and summary say what it is.
for i in 1 2 3 4; do
  # shellcheck disable=SC2059  # the frame has no %
  printf "$octal${octal%'\174\000\000'}\000\000"
done >"$work/xonxoff.bin"
said='Changed bytes: 11 and 13 are missing throughout, and frames are too short: they are taken for XON and XOFF'
"$SBUS" doctor "$work/xonxoff.bin" >"$work/out" 2>"$work/err"
[ $? -eq 1 ] && grep -qxF "$said." "$work/out" && grep -qx 'Turn software flow control off in the program that wrote it.' "$work/out" &&
  "$SBUS" summary "$work/xonxoff.bin" 2>"$work/err" | grep -qxF "finding      $said." &&
  [ "$("$SBUS" hex "$work/xonxoff.bin" 2>"$work/err" | grep ' frame ' | cut -c15-88 | sort -u)" = "$frame" ]
verdict $? "doctor and summary say that 11 and 13 are missing, and hex shows the whole frames"

# A line without an end is named, after what was good before it, and is not kept.
{ cat recordings/paper.txt; head -c 40000000 /dev/zero | tr '\0' 7; } >"$work/endless.txt"
lines=$(wc -l <recordings/paper.txt)
"$SBUS" hex recordings/paper.txt >"$work/wanted"
for source in "$work/endless.txt" -; do
  "$SBUS" hex "$source" <"$work/endless.txt" >"$work/out" 2>"$work/err"
  [ $? -eq 1 ] && cmp "$work/out" "$work/wanted" &&
    grep -qxF "sbus hex: $source:$((lines + 1)): the line is longer than 16777216 characters: line ends are expected" "$work/err"
  verdict $? "a line of 40000000 characters is named with its place: $(cat "$work/err")"
done

# Lines that a terminal program writes around bytes, prose around what is posted, and a declaration are no bytes.
printf 'CoolTerm Capture (a.txt) 2021-05-11 18:12:30\n%s\n%s\n' "$frame" "$frame" | written coolterm.txt
printf '\033[0;32mRX: %s\033[0m\n\033[0;32mRX: %s\033[0m\n' "$frame" "$frame" | tee "$work/piped.txt" | written colours.txt
# shellcheck disable=SC2002  # a pipe, not a file
"$SBUS" hex "$work/piped.txt" >"$work/wanted" 2>"$work/err" && cat "$work/piped.txt" | "$SBUS" hex - 2>"$work/err" | cmp - "$work/wanted"
verdict $? "a terminal's colours are no bytes of a line, by a pipe either"
printf 'I get this:\n```\n%s\n%s\n```\nWhat is wrong?\n' "$frame" "$frame" | written post.txt
# What looks like a CAN bus's log, or like a decoder's bits, for one line or for half of them.
printf '[12.345] port #1 open\n%s\n%s\n' "$frame" "$frame" | written port.txt
printf 'UART: 1\nUART: 0\n[12.345] open\n%s\n%s\n' "$frame" "$frame" >"$work/uart.txt" &&
  [ "$("$SBUS" hex "$work/uart.txt" 2>"$work/err" | grep -c " $frame  frame end 00$")" -eq 2 ]
verdict $? "bytes are read from below two settings of a UART"
echo "$frame $frame" | tr ' ' '\n' | sed 's/.*/uart-1: Start bit\nuart-1: &/' | written starts.txt
# Of words that are no frames in either order, the bytes are in the order in which they stand; two digits are a byte.
printf '00000000: 0fe5 031f f8c0 073e 0fe5 031f f8c0 073e  ................\n00000010: 0fe5 031f  ....\n' >"$work/words.txt"
printf '00 01 00 00 01\n01 00 00 01 01\n' >"$work/zeros.txt"
for line in 'words.txt|0F E5 03 1F F8 C0 07 3E 0F E5 03 1F F8 C0 07 3E 0F E5 03 1F' 'zeros.txt|00 01 00 00 01 01 00 00 01 01'; do
  "$SBUS" hex "$work/${line%%|*}" 2>"$work/err" | grep -q "^ *-  ${line#*|} " || { cat "$work/err"; false; }
  verdict $? "bytes that are no frame are shown as they stand in ${line%%|*}"
done
printf '%s\n%s\nis it a dead cafe be or not, who knows\n' "$frame" "$frame" | written prose.txt
# rejected NAME MESSAGE: standard input is a file of another kind
rejected() {
  cat >"$work/$1"
  "$SBUS" hex "$work/$1" >"$work/out" 2>"$work/err"
  [ $? -eq 1 ] && grep -qxF "sbus hex: $work/$1$2" "$work/err" || { cat "$work/err"; false; }
  verdict $? "rejects $1"
}
want=' is not hexadecimal; bytes of two digits are expected, such as 0F E3; # begins a comment'
printf '0F E5 03\nF8 0G 07\n' | rejected letter.txt ":2: \"0G\"$want"
printf '0F E5 03\nand so on\n' | rejected words.txt ":2: \"and\"$want"

printf 'uart-1: Start bit\nuart-1: 1\nuart-1: 1\nuart-1: 1\nuart-1: 1\nuart-1: 0\nuart-1: 0\nuart-1: 0\nuart-1: 0\nuart-1: 0F\n' |
  rejected sigrok.txt ": is sigrok's annotations of bits: export the bytes alone, with sigrok-cli -A uart=rx-data"
printf 'libsigrok 0.5.2\nAcquisition with 1/1 channels at 1 MHz\nSBUS:00000000 00000000\n' |
  rejected samples.txt ": is sigrok-cli's print of samples: -O vcd -o FILE.vcd makes a capture of them, -A uart=rx-data prints a decoder's bytes"
printf '(1436509052.249713) can0 123#0FE5031FF8C0073E\n' | rejected candump.log ": is candump's log: log2long < FILE prints bytes that are read"
printf '  can0  123   [8]  0F E5 03 1F F8 C0 07 3E\n  can0  18FEF100   [4]  0F E5 03 1F\n' |
  rejected candump.txt ": is candump's print, and no frames are in it: sbus record makes a recording of a receiver's line"
printf '  can0  18FEF100   [8]  0F E5 03 1F F8 C0 07 3E\n' |
  rejected candump-29.txt ": is candump's print, and no frames are in it: sbus record makes a recording of a receiver's line"
printf " (000.000000)  can0  123   [3]  0F E5 03    '...'\n" |
  rejected candump-a.txt ": is candump's print with characters beside the bytes: without -a it prints bytes that are read"
printf ':10000000%s00\n:00000001FF\n' "$(echo "$frame" | tr -d ' ' | cut -c1-32)" |
  rejected firmware.hex ": is a file of Intel HEX: objcopy -I ihex -O binary FILE.hex FILE.bin makes bytes of it"
dump=': is a dump of bits, characters, or numbers that are not hexadecimal: xxd, hexdump -C or od -v -t x1 prints one that is read'
for tool in od 'od -b' 'od -c' 'od -t u1' 'hexdump -b' 'xxd -b'; do
  # shellcheck disable=SC2086  # the tool's arguments are words
  ! command -v "${tool%% *}" >"$work/out" || $tool "$work/bytes.bin" | rejected "$(echo "$tool" | tr ' ' _).txt" "$dump"
done
printf '00001111 11100000\n' | rejected bits.txt "$dump"
printf '0b00001111, 0b11100000\n' | rejected marked-bits.txt "$dump"
printf '# nothing\n' | rejected nothing.txt ': is empty: at least one line "microseconds byte byte ..." is expected'
printf '\376\377\0000\000F' | rejected utf16.txt ': is text in UTF-16 with the mark FE FF: save it as UTF-8'
printf '0Fh E3h\n' | rejected suffix.txt ':1: "0Fh" is not a time: a whole number of microseconds is expected, or a # comment; without times, bytes such as 0F E3'
printf '[\n  {\n    "type": "frame",\n    "channels": [\n      997,\n' |
  rejected array.json ':1: "[" is not a JSON object; JSON lines as sbus hex --json writes them are expected'
printf '<SALEAE>\000\000' | rejected digital_0.bin ": is Logic 2's binary export: export it as CSV"
printf 'BZh91AY&SY\001\002\003' | rejected flight.bz2 ': is packed in a way that is not read here: unpack it, or pack it as .gz or .zip'
printf '' | rejected empty.bin ': is empty: at least one line "microseconds byte byte ..." is expected'
