#!/bin/sh
# Runs the examples, as they stand, on a simulated Arduino Mega, and says "ok mega: ..." or "FAILED mega: ..." of each
# check. BUILD is the folder for what is built, absolute; CXX a compiler for this PC.
#
# The runner holds what a sketch prints, sends and does at its pins against the frames on the line (Expected.h). Diagnose
# counts and names settings; it is compared with the host's plain core, which has the same ones.
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

# checked NAME WHAT LEAST OPTIONS...: runs a sketch, which NAME begins with; so many rows, sent frames or pulses of each
# pin, or more, were held against the line
checked() {
  of=$1
  what=$2
  least=$3
  shift 3
  on_mega "$of" "${of%%-*}" "$@" && [ "$(sed -n "s/^$what: //p" "$out/$of.err")" -ge "$least" ]
}

# only NAME COUNT TEXT OPTIONS...: runs a sketch; it prints so many lines, and all are TEXT
only() {
  of=$1
  count=$2
  text=$3
  shift 3
  on_mega "$of" "${of%%-*}" "$@" && [ "$(tr -d '\r' <"$out/$of.csv" | grep -cxF "$text")" -eq "$count" ] &&
    [ "$(wc -l <"$out/$of.csv")" -eq "$count" ]
}

# flight EXAMPLE SECONDS WHAT LEAST
flight() {
  checked "$1" "$3" "$4" --seconds "$2"
  verdict $? "$1: $4 $3 of $2 s of flight are what stands on the line, and come in time"
  for recording in "$recordings"/*.txt; do
    name=$1-$(basename "$recording" .txt)
    checked "$name" rows "$(wc -l <"$golden/$name.csv")" --recording "$recording"
    verdict $? "$1 prints of ${recording##*/} what stands on it, and as many rows as on the host"
  done
}

# The period is measured from look to look, and these come at other times than on the host.
without_period() {
  sed 's/[0-9]* us from one to the next/some us from one to the next/'
}

# diagnose_alike NAME OPTIONS...: the same line on host and Mega. The host ends the pass of loop() in which the line
# ends, so the Mega runs for longer, and may print more.
diagnose_alike() {
  name="Diagnose-$1"
  shift
  timeout 60 "$out/host/Diagnose" --simulated-time --seconds 2 "$@" >"$out/$name.host" 2>/dev/null &&
    on_mega "$name" Diagnose --any-settings --seconds 3 "$@" && [ -s "$out/$name.host" ] &&
    head -n "$(wc -l <"$out/$name.host")" "$out/$name.csv" | without_period >"$out/$name.head" &&
    without_period <"$out/$name.host" >"$out/$name.words" && same "$out/$name.head" "$out/$name.words"
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
    [ "$(wc -l <"$out/Diagnose.words")" -eq 14 ] && same "$out/Diagnose.words" "$out/Diagnose.words.host"
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

# SBusFrameOk() counts from the poll that found the frame, a loop period after its end, and is asked in every loop().
silence() {
  on_mega Counters-cut Counters --seconds 3 --cut 2 &&
    end=$(sed -n 's/^line: .* the last through at \([0-9]*\) us.*/\1/p' "$out/Counters-cut.err") &&
    [ "$(grep -c '^ok,1' "$out/Counters-cut.csv")" -eq 1 ] &&
    after=$(($(tr -d '\r' <"$out/Counters-cut.csv" | sed -n 's/^ok,0,//p') - end)) &&
    [ "$after" -ge 100000 ] && [ "$after" -le 100200 ]
  verdict $? "SBusFrameOk() falls 100 ms after the line went silent, and 200 us later at the most"
  checked DecodeSBus-cut rows 10 --cut 2 --seconds 3
  verdict $? "DecodeSBus prints no row when the line went silent"
  checked Mixer-cut sent 330 --cut 2 --seconds 3
  verdict $? "Mixer goes on sending when the line went silent, from 100 ms on with both flags set and throttle closed"
  checked Servos-cut pulses 149 --cut 2 --seconds 3
  verdict $? "Servos: 100 ms after the line went silent the throttle closes, and the others hold"
  checked Servos-silent pulses 49 --silent --seconds 1
  verdict $? "Servos: as long as no frame has come the throttle is closed, and the others are centred"
}

loopback() {
  only Loopback 2 "PASS: 100 frames sent, 100 came back right." --wire 1-1 --seconds 2
  verdict $? "Loopback passes on a wire from TX1 to RX1, each second"
  only Loopback-receiver 1 "FAIL: frames come that were not sent. Is a receiver still connected to RX1?" --seconds 1
  verdict $? "Loopback says of a receiver at RX1 that frames come that were not sent"
  only Loopback-silent 1 "FAIL: not a byte comes back. Is TX1 connected to RX1? Are these the pins?" --silent --seconds 1
  verdict $? "Loopback says of a silent line that not a byte comes back"
}

calibrate() {
  rm -f "$out"/Calibrate*.eeprom
  checked Calibrate rows 7 --sticks calibration --seconds 29 --eeprom "$out/Calibrate.eeprom" &&
    words "$out/Calibrate.csv" >"$out/Calibrate.words" && words "$golden/Calibrate.csv" | same - "$out/Calibrate.words"
  verdict $? "Calibrate says what it says on the host, then prints the line's numbers as it has calibrated them"
  # The version, then low, centre, high and dead zone of CH1..CH4: those of extras/line/CalibrationMoves.cpp.
  [ "$(od -An -v -w34 -tu2 -N 34 "$out/Calibrate.eeprom" | tr -s ' ')" = \
    " 1 172 1000 1811 8 1811 985 172 8 172 992 1811 0 172 992 1811 8" ] &&
    [ "$(tr -d '\377' <"$out/Calibrate.eeprom" | wc -c)" -eq 132 ]  # the others are erased
  verdict $? "Calibrate stores 132 bytes, the sticks' ends and centres in them"

  cp "$out/Calibrate.eeprom" "$out/Calibrate-again.eeprom"
  checked Calibrate-again rows 2 --recording "$recordings/paper.txt" --eeprom "$out/Calibrate-again.eeprom" &&
    ! words "$out/Calibrate-again.csv" && cmp "$out/Calibrate.eeprom" "$out/Calibrate-again.eeprom"
  verdict $? "Calibrate, started again with that EEPROM, prints numbers at once"
  printf '\001' | dd of="$out/Calibrate-again.eeprom" bs=1 seek=50 conv=notrunc 2>/dev/null  # CH7, was 0
  only Calibrate-changed 1 "Move all sticks, sliders and switches to all their ends." \
    --sticks calibration --seconds 1 --eeprom "$out/Calibrate-again.eeprom"
  verdict $? "Calibrate begins anew if a byte of the EEPROM has changed"
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

printf '\nmega: the examples on a simulated ATmega2560, with the AVR core of Arduino\n'
mkdir -p "$out"
examples=$(build list-examples)
build -s -k runner elves host 2>&1
for name in $examples Counters; do
  build -q "$out/$name.elf" >/dev/null 2>&1
  verdict $? "$name compiles without a warning"
done
refused
for name in $examples; do
  case $name in
    Calibrate) calibrate ;;
    Diagnose) diagnose ;;
    Loopback) loopback ;;
    Mixer) flight Mixer 13 sent 1430 ;;  # from 9.5 s to 12.5 s the radio is off
    Servos) flight Servos 13 pulses 649 ;;
    DecodeSBus) flight DecodeSBus 13 rows 64 ;;
    *) flight "$name" 4 rows 19 ;;
  esac
done
silence
for character in 500 501 523 524; do  # of the 20th frame
  checked Counters-bad rows 1 --bad $character --seconds 1.1 && grep -q ' 1 of them bad$' "$out/Counters-bad.err"
  verdict $? "a wrong parity of character $((character - 500)) loses that byte and one frame: 24 bytes are left over"
done
checked Counters rows 5 --seconds 5.5
verdict $? "each frame of five seconds is seen, and not a byte is left over"
