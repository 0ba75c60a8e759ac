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

# checked NAME WHAT LEAST: the runner of NAME has checked so many rows, sent frames or pulses of each pin, or more
checked() {
  [ "$(sed -n "s/^$2: //p" "$out/$1.err")" -ge "$3" ]
}

# only FILE COUNT TEXT: the file has so many lines, and all are TEXT
only() {
  [ "$(wc -l <"$1")" -eq "$2" ] && [ "$(tr -d '\r' <"$1" | grep -cxF "$3")" -eq "$2" ]
}

# proves WHAT LEAST SKETCH OPTIONS...: runs it; so many rows, sent frames or pulses were checked, or more
proves() {
  what=$1
  least=$2
  shift 2
  on_mega "$1" "$@" && checked "$1" "$what" "$least"
}

# flight EXAMPLE SECONDS: five rows a second
flight() {
  proves rows $(($2 * 5 - 1)) "$1" --seconds "$2.1"
  verdict $? "$1 prints of $2 s of flight what stands on the line"
  case $1 in
    Mixer) checked Mixer sent 1450 ;;
    Servos) checked Servos pulses 654 ;;
  esac
  verdict $? "$1 also sends, and puts to its pins, what stands on the line, and in time"
  for recording in "$recordings"/*.txt; do
    name=$(basename "$recording" .txt)
    proves rows "$(wc -l <"$golden/$1-$name.csv")" "$1" --recording "$recording"
    verdict $? "$1 prints of $name.txt what stands on it, and as many rows as on the host"
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

# A second: 111 frames, of which the 20th, characters 500 to 524, is not the last.
parity() {
  for character in 500 501 523 524; do
    on_mega Counters-bad Counters --seconds 1.1 --bad $character && grep -q '^110,[1-9],24' "$out/Counters-bad.csv" &&
      grep -q ' 1 of them bad$' "$out/Counters-bad.err"
    verdict $? "a wrong parity of character $((character - 500)) loses that byte and one frame: 24 bytes are left over"
  done
}

# SBusFrameOk() counts from the poll that found the frame, a loop period after its end, and is asked in every loop().
silence() {
  on_mega Counters-cut Counters --seconds 3 --cut 2 &&
    end=$(sed -n 's/^line: .* the last through at \([0-9]*\) us.*/\1/p' "$out/Counters-cut.err") &&
    [ "$(grep -c '^ok,1' "$out/Counters-cut.csv")" -eq 1 ] &&
    after=$(($(tr -d '\r' <"$out/Counters-cut.csv" | sed -n 's/^ok,0,//p') - end)) &&
    [ "$after" -ge 100000 ] && [ "$after" -le 100200 ]
  verdict $? "SBusFrameOk() falls 100 ms after the line went silent, and 200 us later at the most"
  on_mega DecodeSBus-cut DecodeSBus --cut 2 --seconds 3 && [ "$(wc -l <"$out/DecodeSBus-cut.csv")" -eq 10 ]
  verdict $? "DecodeSBus prints no line more when the line went silent"
  on_mega Mixer-cut Mixer --cut 2 --seconds 3 && checked Mixer-cut sent 330
  verdict $? "Mixer goes on sending when the line went silent, from 100 ms on with both flags set and throttle closed"
  on_mega Servos-cut Servos --cut 2 --seconds 3 && checked Servos-cut pulses 149
  verdict $? "Servos: 100 ms after the line went silent the throttle closes, and the others hold"
  on_mega Servos-silent Servos --silent --seconds 1 && checked Servos-silent pulses 49
  verdict $? "Servos: as long as no frame has come the throttle is closed, and the others are centred"
}

# Five lines, one each second.
frame_rate() {
  on_mega Counters Counters --seconds 5.5 && grep -v '^ok' "$out/Counters.csv" | tr -d '\r' |
    awk -F, '{ rate = $1 - before; before = $1; wrong += rate < 111 || rate > 112 || $2 != 0 || $3 != 0 }
      END { exit NR != 5 || wrong > 0 }'
  verdict $? "111 or 112 frames are seen each second, all that came, and not a byte is left over"
}

loopback() {
  # shellcheck disable=SC2046  # the options are words
  on_mega Loopback Loopback $(options_of Loopback) && same "$out/Loopback.csv" "$golden/Loopback.csv" &&
    only "$out/Loopback.csv" 5 "PASS: 100 frames sent, 100 came back right."
  verdict $? "Loopback passes on a wire from TX1 to RX1, five times in five seconds, and says nothing else"
  on_mega Loopback-receiver Loopback --seconds 3 &&
    only "$out/Loopback-receiver.csv" 3 \
      "FAIL: frames come that were not sent. Is a receiver still connected to RX1?"
  verdict $? "Loopback says of a receiver at RX1 that frames come that were not sent"
  on_mega Loopback-silent Loopback --seconds 3 --silent &&
    only "$out/Loopback-silent.csv" 3 "FAIL: not a byte comes back. Is TX1 connected to RX1? Are these the pins?"
  verdict $? "Loopback says of a silent line that not a byte comes back"
}

calibrate() {
  rm -f "$out"/Calibrate*.eeprom
  on_mega Calibrate Calibrate --sticks calibration --seconds 30 --eeprom "$out/Calibrate.eeprom" &&
    words "$out/Calibrate.csv" >"$out/Calibrate.words" && words "$golden/Calibrate.csv" >"$out/Calibrate.words.host" &&
    [ "$(wc -l <"$out/Calibrate.words")" -eq 4 ] && same "$out/Calibrate.words" "$out/Calibrate.words.host" &&
    checked Calibrate rows 10
  verdict $? "Calibrate says what it says on the host, once, and then prints the line's numbers as it has calibrated them"
  # The version, then low, centre, high and dead zone of CH1..CH4: those of extras/line/CalibrationMoves.cpp.
  [ "$(od -An -v -w34 -tu2 -N 34 "$out/Calibrate.eeprom" | tr -s ' ')" = \
    " 1 172 1000 1811 8 1811 985 172 8 172 992 1811 0 172 992 1811 8" ] &&
    [ "$(tr -d '\377' <"$out/Calibrate.eeprom" | wc -c)" -eq 132 ]  # the others are erased
  verdict $? "Calibrate stores 132 bytes, the sticks' ends and centres in them"

  cp "$out/Calibrate.eeprom" "$out/Calibrate-again.eeprom"
  on_mega Calibrate-again Calibrate --recording "$recordings/paper.txt" --eeprom "$out/Calibrate-again.eeprom" &&
    checked Calibrate-again rows 2 && ! words "$out/Calibrate-again.csv" &&
    cmp "$out/Calibrate.eeprom" "$out/Calibrate-again.eeprom"
  verdict $? "Calibrate, started again with that EEPROM, prints numbers at once"
  printf '\001' | dd of="$out/Calibrate-again.eeprom" bs=1 seek=50 conv=notrunc 2>/dev/null  # CH7, was 0
  on_mega Calibrate-changed Calibrate --sticks calibration --seconds 2 --eeprom "$out/Calibrate-again.eeprom" &&
    only "$out/Calibrate-changed.csv" 1 "Move all sticks, sliders and switches to all their ends."
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
for name in DecodeSBus Mixer Servos; do
  flight $name 13  # from 9.5 s to 12.5 s the radio is off
done
for name in AllChannels Normalized; do
  flight $name 4
done
checked Mixer sent 1450
verdict $? "Mixer sends on what stands on the line, every 9 ms, or 1.5 ms later at the most"
checked Servos pulses 654
verdict $? "Servos: pulses every 20 ms at the pins 2 to 5, within 1 us of what stands on the line"
calibrate
diagnose
loopback
parity
silence
frame_rate
for name in $examples; do
  ls "$out/$name.err" >/dev/null 2>&1
  verdict $? "$name was run"
done
