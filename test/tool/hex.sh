#!/bin/sh
# Tests the values and times that `sbus hex` prints, and its lines when they are fitted to a width; says "ok ..." or
# "FAILED ...".
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

for channels in 16 24; do
  line="sim:noise=20,$channels --simulated-time --seconds 0.2"
  # shellcheck disable=SC2086  # the arguments are words
  "$SBUS" hex $line --values | awk -v count=$channels '/  (frame|frame24) end/ { for (i = NF - count + 1; i < NF; i++) printf "%s,", $i; print $NF }' >"$work/values" &&
    "$SBUS" csv $line --every-frame --columns ch1-ch$channels | cmp - "$work/values" && [ "$(wc -l <"$work/values")" -gt 10 ]
  verdict $? "hex --values of $channels channels agrees with csv"
done
# whole: puts the rows of each line together again, one blank between words
whole() {
  awk '{ text = substr($0, 15); bytes = ""
      while (match(text, /^[0-9A-F][0-9A-F][ !]/)) { bytes = bytes substr(text, 1, 3); text = substr(text, 4) }
      if (substr($0, 1, 12) ~ /[0-9]/) { if (NR > 1) print line rest; line = substr($0, 1, 14); rest = "" }
      line = line bytes; rest = rest " " text }
    END { print line rest }' | sed 's/  */ /g; s/ $//'
}
line="--simulated-time --seconds 10.2"
for width in 60 80 120 300; do
  for options in 16 '24 --values' '32 --values'; do
    # shellcheck disable=SC2086  # the arguments are words
    "$SBUS" hex sim:noise=20,$options $line | whole >"$work/whole" && NO_COLOR=1 on_terminal $width "$SBUS" hex sim:noise=20,$options $line >"$work/folded" &&
      whole <"$work/folded" | cmp - "$work/whole" && [ "$(wc -l <"$work/whole")" -gt 900 ] &&
      awk -v width=$width 'length($0) > width { print; exit 1 }' "$work/folded"
    verdict $? "hex on a terminal of $width columns, $options: no line is longer, and nothing is missing"
  done
done
[ "$(NO_COLOR=1 on_terminal 80 "$SBUS" hex sim --simulated-time --seconds 0.02 | head -n 2)" = "\
    0.008000  0F E0 53 2B 2B 98 C9 0A 56 80 0F 7C E0  frame end 00
              03 1F F8 C0 07 3E F0 81 0F 7C 00 00 " ]
verdict $? "hex on a terminal of 80 columns prints a frame in two rows"

# colours of the test's golden page, on a terminal that has them
coloured() { on_terminal 300 env "$@" "$SBUS" hex sim:noise=100 --simulated-time --seconds 0.05; }
coloured -u NO_COLOR TERM=xterm | cmp - tool/hex-colour.txt
verdict $? "hex has colours on a terminal"
coloured NO_COLOR=1 TERM=xterm >"$work/no-colour" && coloured -u NO_COLOR TERM=dumb | cmp - "$work/no-colour" &&
  sed 's/\x1b\[[0-9;]*m//g' tool/hex-colour.txt | cmp - "$work/no-colour"
verdict $? "hex has no colours with NO_COLOR or on a dumb terminal"
