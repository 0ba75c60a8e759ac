#!/bin/sh
# Compiles the library and the examples, as they stand, against stand-ins of the cores that people own, and says "ok cores:
# ..." or "FAILED cores: ..." of each; then runs frames through each core's ports, CoresTest.cpp, an S.BUS2 sensor on those
# that time it, SensorTest.cpp, and on a Teensy 4, where loop() does, PolledSensorTest.cpp; DecodeSBusBackground on those that
# poll each millisecond, BackgroundTest.cpp; what an STM32L0 sends by DMA, DmaSenderTest.cpp, and a sketch without that,
# ReceiveOnlyTest.cpp; and the examples that live on a core's timers, tasks or USB: PpmOutTest.cpp, TasksTest.cpp,
# JoystickTest.cpp. BUILD is the folder for what is built, absolute; CXX a compiler for this PC.
set -u
cd "$(dirname "$0")" || exit 1
out="${BUILD:-$(cd ../../.. && pwd)/build/test}/cores"

build() {
  "${MAKE:-make}" --no-print-directory -s -f build.mk OUT="$out" CXX="${CXX:-g++}" "$@"
}

printf '\ncores: library and examples on stand-ins of the ports of other cores\n'
mkdir -p "$out"
build -k all 2>&1 && built=yes || built=
targets=$(build list) || echo "FAILED cores: build.mk"
for target in $targets; do
  name=${target#"$out/"}
  core=${name%%/*}
  name=${name#*/}
  case $name in
    Stm32L0.ok) what="the timer of the slots compiles" ;;
    SBusBoard.ok) what="SBUS_UART and SBUS_FREE_PINS are as boards.md says" ;;
    *.ok) what="${name%.ok} compiles without a warning" ;;
    NoServo.rejected) what="without the library Servo the compiler says where it is" ;;
    SingleWire.rejected) what="a single wire does not compile on a port that may not let go of it" ;;
    NoBackground.rejected) what="DecodeSBusBackground does not compile where nothing can poll" ;;
    *.rejected) what="${name%.rejected} says why it cannot run, and what to do" ;;
    *) what="$name is built" ;;
  esac
  # What is no program is removed before it is made.
  if [ -n "$built" ] || { [ -e "$target" ] && { [ "$name" = "${name%Test}" ] || build -q "$target" >/dev/null 2>&1; }; }; then echo "ok cores: $core: $what"; else echo "FAILED cores: $core: $what"; fi
  if [ "$name" != "${name%Test}" ]; then
    printf '%s:\n' "$core"
    timeout 300 "$target" --no-version --no-intro >"$target.log" 2>&1
    status=$?
    cat "$target.log"
    [ "$status" -eq 0 ] || grep -q '^\[doctest\] test cases:.*[1-9][0-9]* failed' "$target.log" ||
      echo "FAILED cores: $core: $name ended with status $status before its end"
  fi
done
