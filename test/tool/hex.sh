#!/bin/sh
# Tests the values that `sbus hex` prints, and its colours, and says "ok ..." or "FAILED ...".
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
# colours of the test's golden page, on a terminal that has them
coloured() { on_terminal 300 env "$@" "$SBUS" hex sim:noise=100 --simulated-time --seconds 0.05; }
coloured -u NO_COLOR TERM=xterm | cmp - tool/hex-colour.txt
verdict $? "hex has colours on a terminal"
coloured NO_COLOR=1 TERM=xterm >"$work/no-colour" && coloured -u NO_COLOR TERM=dumb | cmp - "$work/no-colour" &&
  sed 's/\x1b\[[0-9;]*m//g' tool/hex-colour.txt | cmp - "$work/no-colour"
verdict $? "hex has no colours with NO_COLOR or on a dumb terminal"
