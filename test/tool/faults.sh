#!/bin/sh
# Lets the PC sleep and files fail, and says "ok ..." or "FAILED ..." of what `sbus` makes of it.
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

g++ -std=c++17 -Wall -Wextra -O1 -fPIC -shared tool/Faults.cpp -o "$work/faults.so"
verdict $? "tool/Faults builds"
preload="$(g++ -print-file-name=libasan.so) $work/faults.so"

# ---- The date, and a PC that sleeps

# The age of a frame and the times of a line are differences of clocks that no date sets. The date itself is read in one
# place, for the beginning of a recording: so whatever the date does, frames keep their ages.
[ "$(grep -rlE 'system_clock|CLOCK_REALTIME|gettimeofday|[^a-zA-Z_]time\((0|NULL|nullptr)' ../src ../extras/line ../extras/cli)" = ../extras/cli/options/SourceOption.cpp ]
verdict $? "the date is read in one place"
record_for 3 sim
player send "$lasting"
ASLEEP=1500,3600 LD_PRELOAD="$preload" timeout 60 "$SBUS" record "$terminal" -o "$work/asleep.txt" 2>"$work/err"
wait "$player"
"$SBUS" csv "$work/asleep.txt" --every-frame --columns time >"$work/times" && awk '$1 - before > 3600 && before { found = NR } { before = $1 }
  END { exit !(found > 50 && NR > found + 50) }' "$work/times" && "$SBUS" summary "$work/asleep.txt" >"$work/out"
verdict $? "a recording goes on after the PC has slept, an hour later: $(grep -A 1 -E 'no frames|PC late' "$work/out" | tr -s ' \n' ' ')"

frames=$(ASLEEP=500,36000 LD_PRELOAD="$preload" timeout 60 "$SBUS" csv sim --seconds 2 --every-frame --columns time | tail -n 1)
[ "${frames%.*}" -lt 3 ]
verdict $? "a simulation pauses while the PC sleeps: it ends at $frames s"

# ---- Files

"$SBUS" record sim -o "$work/sim.txt" --simulated-time --seconds 60 2>"$work/err"
"$SBUS" csv sim --simulated-time --seconds 1.8 --every-frame --columns ch1 >"$work/wanted"
# faulty EIO ARGUMENTS...: its output in $work/out and $work/err
faulty() {
  eio=$1
  shift
  (cd "$work" && EIO=$eio LD_PRELOAD="$preload" timeout 60 "$SBUS" "$@") >"$work/out" 2>"$work/err"
}
# says MESSAGE: it is the last one
says() { [ "$(tail -n 1 "$work/err")" = "$1" ] || { tail -n 3 "$work/err"; false; }; }
# begins FILE: with the rows of the first seconds
begins() { [ "$(head -n "$(wc -l <"$work/wanted")" "$1" | cksum)" = "$(cksum <"$work/wanted")" ]; }

! faulty read,sim.txt,700000 csv sim.txt --every-frame --columns ch1 &&
  says "sbus csv: sim.txt: cannot be read to its end (Input/output error)" && begins "$work/out"
verdict $? "a disk that fails within a recording: $(wc -l <"$work/out") frames before that, and the reason"
! faulty read,sim.txt,700000 summary sim.txt && says "sbus summary: sim.txt: cannot be read to its end (Input/output error)" && grep -q '^sim.txt: S.BUS, [0-9]' "$work/out"
verdict $? "summary of a disk that fails has the frames before that"
mkfifo "$work/pipe"
timeout 60 head -n 4000 "$work/sim.txt" >"$work/pipe" 2>"$work/note" &
! faulty read,pipe,50000 hex pipe && grep -q '^sbus hex: pipe: cannot be read .*(Input/output error)' "$work/err" || { cat "$work/err"; false; }
verdict $? "a pipe that fails is named: $(tail -n 1 "$work/err")"
wait
! faulty write,out.txt,100000 record sim -o out.txt --simulated-time --seconds 60 &&
  says "sbus record: out.txt: could not be written completely (Input/output error); what was written before is valid; check the disk, or write elsewhere" &&
  "$SBUS" csv "$work/out.txt" --every-frame --columns ch1 >"$work/rows" && begins "$work/rows"
verdict $? "a recording on a disk that fails ends there, and is valid"
! faulty write,dir,60000 watch sim --simulated-time --seconds 60 --when failsafe -o dir && says "sbus watch: dir: 4 recordings are incomplete; the reasons are above" &&
  [ "$(ls "$work/dir")" = sbus-000001.txt ] && "$SBUS" summary "$work/dir/sbus-000001.txt" >"$work/out"
verdict $? "watch on a disk that fails: each event says so, the first file is valid, and no file is empty"
rm -rf "$work/dir"
! faulty fsync,dir,0 watch sim --simulated-time --seconds 60 --when failsafe -o dir && grep -q 'sbus-000001.txt: could not be written completely (Input/output error)' "$work/err" &&
  for each in "$work"/dir/*; do "$SBUS" summary "$each" >"$work/out" || break; done
verdict $? "watch on a disk that does not keep what it was given"
