#!/bin/sh
# Runs the examples, as they stand, on a simulated Arduino Mega, and says "ok mega: ..." or "FAILED mega: ..." of each
# check. BUILD is the folder for what is built, absolute; CXX a compiler for this PC.
#
# What the examples print is compared with golden/*.csv, which is what they print on the host (golden.sh sees to that).
# Diagnose names the settings that it tries, and a plain core has fewer; Calibrate stores, and a plain core takes longer
# for that: both are compared with the host's plain core.
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

# near FILE FILE LINES MOST: no more than so many lines differ, and no number by more than MOST
near() {
  paste -d, "$1" "$2" | tr -d '\r' | awk -F, -v lines="$3" -v most="$4" '
    NF % 2 { next }  # one of them has a line more
    {
      compared++
      differs = 0
      for (i = 1; i <= NF / 2; i++) {
        apart = $i - $(i + NF / 2)
        differs = differs || apart != 0
        wrong += apart < -most || apart > most
      }
      differing += differs
    }
    END { exit compared < 60 || differing > lines || wrong > 0 }'
}

# What an example is run with. To be split into words.
options_of() {
  sed -n "s/^$1 //p" ../../../extras/host/OPTIONS
}

# on_host EXAMPLE OPTIONS...: the same on the host's plain core
on_host() {
  program=$1
  shift
  timeout 60 "$out/host/$program" --simulated-time "$@" </dev/null 2>/dev/null
}

# only FILE COUNT TEXT: the file has so many lines, and all are TEXT
only() {
  [ "$(wc -l <"$1")" -eq "$2" ] && [ "$(tr -d '\r' <"$1" | grep -cxF "$3")" -eq "$2" ]
}

# An example that prints five lines a second. One that computes more has a longer pass of loop(), so that a print that
# falls on a frame's end may meet the frame beside: with lost frames in between that is 27 ms away, in which a stick
# moves by 27 us, and an elevon by 55 of 1000.
example() {
  case $1 in
    Servos) most=27 ;;
    Mixer) most=55 ;;
    *) most=0 ;;
  esac
  if [ "$most" -gt 0 ]; then
    on_mega "$1" "$1" && near "$out/$1.csv" "$golden/$1.csv" 3 "$most"
    verdict $? "$1 prints what it prints on the host, number for number but for 3 of 74 lines at the most"
  else
    on_mega "$1" "$1" && same "$out/$1.csv" "$golden/$1.csv"
    verdict $? "$1 prints what it prints on the host, number for number"
  fi
  for recording in "$recordings"/*.txt; do
    name="$1-$(basename "$recording" .txt)"
    on_mega "$name" "$1" --recording "$recording" && same "$out/$name.csv" "$golden/$name.csv"
    verdict $? "$1 prints of ${recording##*/} what it prints on the host, number for number"
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

# Two seconds: 222 frames, of which the 20th, characters 500 to 524, is whole in the first.
parity() {
  for character in 500 501 523 524; do
    on_mega Counters-bad Counters --seconds 2.1 --bad $character &&
      tail -n 1 "$out/Counters-bad.csv" | grep -q '^221,[1-9],24' &&
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

# Behind the calibration the Mega's pass of loop() takes 2.1 ms, half of it for the check value and half for printing.
# The host is told so, and both stay together for the 62 lines of numbers; but where a print falls on a frame's end they
# may meet two frames, and with lost frames in between these may be 27 ms apart, in which a stick moves by 25 of 1000.
calibrate() {
  rm -f "$out"/Calibrate*.eeprom
  on_host Calibrate --sticks calibration --loop-us 2100 --eeprom "$out/Calibrate-host.eeprom" >"$out/Calibrate.host"
  # shellcheck disable=SC2046  # the options are words
  on_mega Calibrate Calibrate $(options_of Calibrate) --eeprom "$out/Calibrate.eeprom" &&
    words "$out/Calibrate.csv" >"$out/Calibrate.words" && words "$golden/Calibrate.csv" >"$out/Calibrate.words.host" &&
    [ "$(wc -l <"$out/Calibrate.words")" -eq 4 ] && same "$out/Calibrate.words" "$out/Calibrate.words.host"
  verdict $? "Calibrate says what it says on the host, once"
  near "$out/Calibrate.csv" "$out/Calibrate.host" 15 25
  verdict $? "Calibrate prints the numbers that it prints on the host, or sometimes those of the frame beside"
  cmp "$out/Calibrate.eeprom" "$out/Calibrate-host.eeprom" &&
    [ "$(tr -d '\377' <"$out/Calibrate.eeprom" | wc -c)" -eq 132 ]  # the others are erased
  verdict $? "Calibrate stores what it stores on the host, 132 bytes"

  cp "$out/Calibrate.eeprom" "$out/Calibrate-again.eeprom"
  recording=$recordings/paper.txt
  on_host Calibrate --recording "$recording" --eeprom "$out/Calibrate-host.eeprom" >"$out/Calibrate-again.host"
  on_mega Calibrate-again Calibrate --recording "$recording" --eeprom "$out/Calibrate-again.eeprom" &&
    [ -s "$out/Calibrate-again.host" ] && same "$out/Calibrate-again.csv" "$out/Calibrate-again.host" &&
    ! words "$out/Calibrate-again.csv" && cmp "$out/Calibrate.eeprom" "$out/Calibrate-again.eeprom"
  verdict $? "Calibrate, started again with that EEPROM, prints numbers at once, the host's"
  printf '\001' | dd of="$out/Calibrate-again.eeprom" bs=1 seek=50 conv=notrunc 2>/dev/null  # CH7, was 0
  on_mega Calibrate-changed Calibrate --sticks calibration --seconds 2 --eeprom "$out/Calibrate-again.eeprom" &&
    only "$out/Calibrate-changed.csv" 1 "Move all sticks, sliders and switches to all their ends."
  verdict $? "Calibrate begins anew if a byte of the EEPROM has changed"
}

# A pass of loop() that prints takes about a millisecond: a frame that is due then is late, and may carry what came in
# meanwhile, which on the host is in the frame behind it; and where a pass ends just before a frame is found, what is sent
# is the one before. An interrupt may hold the first one up by some microseconds, and the last one may come too late.
mixer() {
  on_host Mixer --sent "2:$out/Mixer-host.sent" >/dev/null
  on_mega Mixer-sent Mixer --sent "2:$out/Mixer.sent" && awk '
    /^#/ { wrong += $0 != "# 100000 baud, 8E2, inverted"; next }
    NF != 26 { cut++; next }  # the last one
    { $1 = "" }
    FILENAME == ARGV[1] { host[++expected] = $0; next }
    { sent++ }
    $0 == host[sent] { same++; next }
    $0 != host[sent + 1] && $0 != host[sent - 1] { wrong++ }
    END { exit expected < 1660 || sent > expected || sent < expected - 1 || same < sent - 10 || cut > 1 || wrong > 0 }' \
    "$out/Mixer-host.sent" "$out/Mixer.sent"
  verdict $? "Mixer sends the frames that it sends on the host, byte for byte, at 100000 baud, 8E2"
  awk '/^#/ { next }
    { late = $1 - 9000 * sent++ }
    sent == 1 { first = late }
    late - first < -50 || late - first > 1500 { wrong++ }
    END { exit sent == 0 || wrong > 0 }' "$out/Mixer.sent"
  verdict $? "Mixer sends each of them when it is due, every 9 ms, or 1.5 ms later at the most"

  on_mega Mixer-cut Mixer --cut 2 --seconds 3 --sent "2:$out/Mixer-cut.sent" && awk '
    /^#/ || NF != 26 { next }  # the last one is cut by the end
    $1 < 2090000 { wrong += $25 ~ /[C-F]$/; before++ }
    $1 > 2115000 { wrong += $25 !~ /[C-F]$/; after++ }
    END { exit before < 220 || after < 95 || wrong > 0 }' "$out/Mixer-cut.sent"
  verdict $? "Mixer goes on sending when the line went silent, from 100 ms on with both flags set"
}

# pulses NAME OPTIONS...: the pulses of Servos
pulses() {
  name="Servos-$1"
  shift
  on_mega "$name" Servos --pulses "$out/$name.pulses" "$@"
}

# The stand-in's pulses are right to half a microsecond, and its interrupt to some cycles more: 1 us in all.
servos() {
  pulses flight && awk -F, '
    $1 == "line" { next }
    $3 < 987 || $3 > 2013 { wrong++ }
    { pulses[$1]++ }
    $1 == 2 && pulses[2] > 1 { between = $2 - before; wrong += between < 19999 || between > 20001 }
    $1 == 2 { before = $2 }
    $1 == 4 && $2 < 8000 { closed++; wrong += $3 < 987 || $3 > 989 }
    END { for (pin = 2; pin <= 5; pin++) wrong += pulses[pin] < 749; exit closed == 0 || wrong > 0 }' \
    "$out/Servos-flight.pulses"
  verdict $? "Servos: pulses of 988 to 2012 us at the pins 2 to 5, every 20 ms, the throttle's first ones 988"

  # What is printed and what is at the pins is compared from one frame to the next, but for the 0.8 ms in which the
  # sketch takes the new frame in.
  tr -d '\r' <"$out/Servos-flight.csv" | awk -F, '
    function frame(us) { return int((us - 8000) / 9000) }
    function settled(us) { return us > 8800 && us - 8000 - 9000 * frame(us) > 800 }
    FILENAME == "-" { for (i = 1; i <= 4; i++) printed[FNR, i + 1] = $i; next }
    $1 == "line" { lines++; if (settled($2)) lineOf[frame($2)] = lines; next }
    { pin[++pulses] = $1; begin[pulses] = $2; width[pulses] = $3 }
    END {
      for (i = 1; i <= pulses; i++) {
        line = lineOf[frame(begin[i])]
        if (line == "" || !settled(begin[i])) continue
        apart = width[i] - printed[line, pin[i]]
        compared++
        wrong += apart < -1 || apart > 1
      }
      exit lines < 74 || compared < 80 || wrong > 0
    }' - "$out/Servos-flight.pulses"
  verdict $? "Servos: the pulses are what it prints at the same time, within 1 us"

  # 9.52 s: the last frame before the radio went off is in. 10.02 s: the first with failsafe is.
  awk -F, '
    function differs(a, b) { return a - b > 1 || b - a > 1 }
    $1 == "line" || $2 < 9520000 || $2 > 12500000 { next }
    !($1 in held) { held[$1] = $3; if ($1 == 4) wrong += $3 < 1100 }
    $1 == 4 && $2 > 10020000 { wrong += differs($3, 988); closed++ }
    $1 != 4 || $2 < 10000000 { wrong += differs($3, held[$1]); holding++ }
    END { exit closed < 120 || holding < 440 || wrong > 0 }' "$out/Servos-flight.pulses"
  verdict $? "Servos: on failsafe the throttle closes, and the others hold"

  # The last frame is through at 4.994 s.
  pulses cut --cut 5 --seconds 6 && awk -F, '
    function differs(a, b) { return a - b > 1 || b - a > 1 }
    $1 == "line" || $2 < 4995000 { next }
    !($1 in held) { held[$1] = $3; if ($1 == 4) wrong += $3 < 1100 }
    $1 == 4 && $2 > 5114000 { wrong += differs($3, 988); closed++ }
    $1 != 4 || $2 < 5094000 { wrong += differs($3, held[$1]); holding++ }
    END { exit closed < 40 || holding < 150 || wrong > 0 }' "$out/Servos-cut.pulses"
  verdict $? "Servos: 100 ms and a pulse after the line went silent the throttle is closed, and the others hold"

  pulses silent --silent --seconds 2 && awk -F, '
    $1 != "line" { pulses++; wanted = $1 == 4 ? 988 : 1500; wrong += $3 < wanted - 1 || $3 > wanted + 1 }
    END { exit pulses < 390 || wrong > 0 }' "$out/Servos-silent.pulses"
  verdict $? "Servos: as long as no frame has come the throttle is closed, and the others are centred"
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
  case $name in
    Diagnose) diagnose ;;
    Loopback) loopback ;;
    Calibrate) calibrate ;;
    *) example "$name" ;;
  esac
done
mixer
servos
parity
silence
frame_rate
