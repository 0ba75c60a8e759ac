#!/bin/sh
# Runs the examples, as they stand, on a simulated Arduino Mega, and says "ok mega: ..." or "FAILED mega: ..." of each
# check. BUILD is the folder for what is built, absolute; CXX a compiler for this PC.
#
# What the examples print is compared with golden/*.csv, which is what they print on the host (golden.sh sees to that).
# Diagnose names the settings that it tries, and a plain core has fewer: it is compared with the host's plain core.
set -u
cd "$(dirname "$0")" || exit 1
out="${BUILD:-$PWD/../../../build/test}/mega"
golden=../../golden
recordings=../../recordings

build() {
  "${MAKE:-make}" --no-print-directory -f build.mk OUT="$out" CXX="${CXX:-g++}" "$@"
}

verdict() {  # STATUS WHAT
  if [ "$1" -eq 0 ]; then echo "ok mega: $2"; else echo "FAILED mega: $2"; fi
}

# on_mega NAME SKETCH OPTIONS...: runs the sketch; leaves NAME.csv, and in NAME.err what the runner says
on_mega() {
  name=$1
  sketch=$2
  shift 2
  timeout 120 "$out/runner" "$out/$sketch.elf" "$@" >"$out/$name.csv" 2>"$out/$name.err" || {
    cat "$out/$name.err"
    false
  }
}

# same FILE FILE
same() {
  diff "$1" "$2" >"$out/diff" || {
    head -n 10 "$out/diff"
    false
  }
}

# An example that prints five lines a second.
example() {
  on_mega "$1" "$1" && same "$out/$1.csv" "$golden/$1.csv"
  verdict $? "$1 prints what it prints on the host, number for number"
  for recording in "$recordings"/*.txt; do
    name="$1-$(basename "$recording" .txt)"
    on_mega "$name" "$1" --recording "$recording" && same "$out/$name.csv" "$golden/$name.csv"
    verdict $? "$1 prints of ${recording##*/} what it prints on the host, number for number"
  done
}

# diagnose_alike NAME OPTIONS...: the same line on host and Mega. The host ends the pass of loop() in which the line
# ends, so the Mega runs for longer, and may print more.
diagnose_alike() {
  name="Diagnose-$1"
  shift
  timeout 60 "$out/host/Diagnose" --simulated-time --seconds 2 "$@" >"$out/$name.host" 2>/dev/null &&
    on_mega "$name" Diagnose --any-settings --seconds 3 "$@" && [ -s "$out/$name.host" ] &&
    head -n "$(wc -l <"$out/$name.host")" "$out/$name.csv" >"$out/$name.head" &&
    same "$out/$name.head" "$out/$name.host"
}

words() {  # what Diagnose says, without its numbers
  grep '^[A-Z]' "$1"
}

# The numbers of Diagnose with the simulated receiver are the Mega's own: what it prints takes 9.6 ms of its cycle of
# two seconds, and none on the host, so it listens to other stretches of the line, and has to count what came in these.
diagnose() {
  for recording in "$recordings"/*.txt; do
    diagnose_alike "$(basename "$recording" .txt)" --recording "$recording"
    verdict $? "Diagnose prints of ${recording##*/} what it prints on the host, number for number"
  done
  diagnose_alike silent --silent
  verdict $? "Diagnose prints of a silent line what it prints on the host"

  timeout 60 "$out/host/Diagnose" --simulated-time --seconds 13 2>/dev/null >"$out/Diagnose.host"
  on_mega Diagnose Diagnose --any-settings --frames &&
    words "$out/Diagnose.host" >"$out/Diagnose.words.host" && words "$out/Diagnose.csv" >"$out/Diagnose.words" &&
    [ "$(wc -l <"$out/Diagnose.words")" -eq 7 ] && same "$out/Diagnose.words" "$out/Diagnose.words.host"
  verdict $? "Diagnose says of the simulated receiver what it says on the host, seven times"
  awk '/^frames since/ { came[++lines] = $4; next }
       /^begin\(/ { printed++ }
       /^begin\(100000/ { trials++; wrong += $3 != came[FNR] }
       END { exit printed != 15 || trials != 8 || wrong > 0 }' "$out/Diagnose.err" "$out/Diagnose.csv"
  verdict $? "Diagnose counts the frames that came in each of its trials"
  if timeout 60 "$out/runner" "$out/Diagnose.elf" --seconds 1 >/dev/null 2>"$out/Diagnose.err"; then
    verdict 1 "the runner does not notice a port that is set wrongly"
  else
    grep -q '^Serial1 was set wrongly: baud rate$' "$out/Diagnose.err"
    verdict $? "a port that is set wrongly does not go unnoticed"
  fi
}

# Two seconds: 222 frames, of which the 20th, characters 500 to 524, is whole in the first.
parity() {
  for character in 500 501 523 524; do
    on_mega Counters-bad Counters --seconds 2.1 --bad $character &&
      [ "$(tail -n 1 "$out/Counters-bad.csv" | tr -d '\r')" = "221,1,24" ] &&
      grep -q ' 1 of them bad$' "$out/Counters-bad.err"
    verdict $? "a wrong parity of character $((character - 500)) loses that byte and one frame: 24 bytes are left over"
  done
}

# SBusFrameOk() counts from the look that found the frame, a pass of loop() behind its end, and is asked in every pass.
silence() {
  on_mega Counters-cut Counters --seconds 4 --cut 3 &&
    end=$(sed -n 's/^sent: .* the last through at \([0-9]*\) us.*/\1/p' "$out/Counters-cut.err") &&
    tr -d '\r' <"$out/Counters-cut.csv" |
    awk -F, -v end="$end" '/^ok,1/ { rises++ }
      /^ok,0/ { falls++; after = $3 - end }
      END { exit rises != 1 || falls != 1 || after < 100000 || after > 100200 }'
  verdict $? "SBusFrameOk() falls 100 ms after the line went silent, and 200 us later at the most"

  on_mega DecodeSBus-cut DecodeSBus --seconds 7 --cut 5 &&
    head -n 25 "$golden/DecodeSBus.csv" >"$out/DecodeSBus-cut.head" &&
    same "$out/DecodeSBus-cut.csv" "$out/DecodeSBus-cut.head"
  verdict $? "DecodeSBus prints no line more when the line went silent"
}

# 15 lines, one each second.
frame_rate() {
  on_mega Counters Counters --seconds 15.5 --frames && tr -d '\r' <"$out/Counters.csv" | awk -F, '
    FILENAME == ARGV[1] { if (sub(/^frames since begin\(\): /, "")) came[++lines] = $0; next }
    /^ok,/ { next }
    { seconds++; wrong += $1 != came[FNR] || $2 != 0 || $3 != 0; rate = $1 - before; before = $1 }
    rate < 111 || rate > 112 { wrong++ }
    END { exit seconds != 15 || wrong > 0 }' "$out/Counters.err" -
  verdict $? "the frames seen each second are the frames sent, 111 or 112, and not a byte is left over"
}

refused() {
  build -s refused >/dev/null 2>&1
  for name in $(build list-refused); do
    grep -m 1 'error:' "$out/$name.refused" | grep -q '#error "[^"]*only the STM32L0 core'
    verdict $? "$name does not compile, and says that only the STM32L0 core has what it needs"
  done
  (cd ../../../examples && grep -l '^#error' ./*/*.ino) | sed 's,^\./,,;s,/.*,,' >"$out/errors"
  build list-refused | cmp -s - "$out/errors"
  verdict $? "no other example refuses a core"
}

sizes() {
  for name in "$@"; do
    avr-size "$out/$name.elf" |
      awk -v name="$name" 'NR == 2 { print name ": " $1 + $2 " bytes of flash, " $2 + $3 " of RAM" }'
  done
}

printf '\nmega: the examples on a simulated ATmega2560, with the AVR core of Arduino\n'
mkdir -p "$out"
examples=$(build list-examples)
build -s -k runner elves host 2>&1
for name in $examples Counters; do
  build -q "$out/$name.elf" >/dev/null 2>&1
  verdict $? "$name compiles without a warning"
done
refused
# shellcheck disable=SC2086  # the names are words
sizes $examples
for name in $examples; do
  if [ "$name" = Diagnose ]; then diagnose; else example "$name"; fi
done
parity
silence
frame_rate
