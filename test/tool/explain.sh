#!/bin/sh
# Runs `sbus explain` on frames that this script packs, and says "ok ..." or "FAILED ..." of:
#   each channel's raw value, its microseconds, its bits, and what each byte says that it holds
#   tool/EXPLAINED   what it says about bytes that are not a frame, and how far it explains them
set -u
cd "$(dirname "$0")/.." || exit 1

. tool/common.sh

# packed HEADER FIRST STEP CHANNELS FLAGS END: a frame in hexadecimal, its channels FIRST, FIRST + STEP ...
packed() {
  awk -v header="$1" -v first="$2" -v step="$3" -v channels="$4" -v flags="$5" -v end="$6" 'BEGIN {
    printf "%s", header
    for (bit = 0; bit < 11 * channels; bit++) {
      value = first + step * int(bit / 11)
      byte += int(value / 2 ^ (bit % 11)) % 2 * 2 ^ (bit % 8)
      if (bit % 8 == 7) { printf " %02X", byte; byte = 0 }
    }
    print " " flags " " end
  }'
}

# explained NAME FIRST STEP: the tables in explain.txt hold these values, and their bits agree with the bytes
explained() {
  awk -v name="$1" -v first="$2" -v step="$3" '
    $1 ~ /^[0-9]+$/ && / CH.* bit / {
      bytes = $3 bytes
      $1 = $2 = $3 = ""
      sub(/^ +/, "")
      for (i = split($0, piece, ", "); i > 0; i--) {
        split(piece[i], word, " ")
        last = split(word[3], ends, "[.][.]")
        for (bit = ends[last]; bit <= ends[1] + 0; bit++) held = held " " word[1] "." bit
      }
      next
    }
    /^CH/ {
      value = first + step * count++
      us = 5 * value / 8 + 880  # as Betaflight has it
      if ($1 != "CH" (name + count - 1) || $2 != value || $3 > us + 1 || $3 < us - 1) wrong = wrong " " $1
      for (bit = 0; bit < 11; bit++) wanted = wanted " " $1 "." bit
      bits = ""
      for (i = 4; i <= NF; i += 4) bits = bits $i
      channels = bits channels
    }
    END {
      if (wrong != "" || channels != bytes || held != wanted || count < 16) { print "values:" wrong; print channels; print bytes; print held; exit 1 }
    }' "$work/explain.txt"
}

# frame TITLE HEADER FIRST STEP CHANNELS FLAGS END NAME: all of it is right; NAME is the first channel's number
frame() {
  title=$1 name=$8
  shift
  packed "$1" "$2" "$3" "$4" "$5" "$6" >"$work/frame.hex"
  # shellcheck disable=SC2046  # the bytes are words
  "$SBUS" explain $(cat "$work/frame.hex") >"$work/explain.txt" && explained "$name" "$2" "$3" &&
    "$SBUS" explain "$(tr -d ' ' <"$work/frame.hex")" | cmp - "$work/explain.txt" &&
    "$SBUS" explain <"$work/frame.hex" | cmp - "$work/explain.txt" &&
    sed 's/^/{0x/; s/ /, 0x/g' "$work/frame.hex" | "$SBUS" explain - | cmp - "$work/explain.txt"
  verdict $? "explain is right about $title"
}
says() {
  grep -qx " *$1 .*  $2" "$work/explain.txt"
  verdict $? "explain says: $2"
}
frame "16 channels" 0F 0 136 16 0B 14 1
says 0 "header"
says 23 "flags: CH17 on, CH18 on, frame not lost, failsafe"
says 24 "end byte: S.BUS2, telemetry slots 8 to 15"
frame "the channels of header 2F" 2F 2047 -120 16 04 00 17
says 0 "header of an extra frame: CH17 to CH32 of Futaba FASSTest 26"
says 23 "flags: frame lost, no failsafe"
says 24 "end byte: S.BUS"
frame "24 channels" 0F 172 70 24 08 00 1
says 34 "flags: frame not lost, failsafe"

# The rows of both tables, the exit status, and a message a line on standard error.
grep -v '^#' tool/EXPLAINED >"$work/explained"
while IFS='|' read -r bytes rows channels messages; do
  "$SBUS" explain "$bytes" >"$work/explain.txt" 2>"$work/err"
  [ $? -eq "$([ -z "$messages" ] && echo 0 || echo 1)" ] &&
    [ "$(grep -cE '^ *[0-9]+  ' "$work/explain.txt") $(grep -c '^CH' "$work/explain.txt")" = "$rows $channels" ] &&
    [ "$(sed 's/^sbus explain: //' "$work/err" | paste -sd ';')" = "$messages" ]
  verdict $? "explain $bytes has the rows and messages of tool/EXPLAINED"
done <"$work/explained"
