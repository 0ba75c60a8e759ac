#!/bin/sh
# Builds the examples, as they stand, for an Arduino Mega, a Leonardo and an Uno R3, and says "ok avr: ..." or "FAILED avr:
# ..." of each; compares them with .github/workflows/examples.yml; then runs them on simulated ones, *Test.cpp. BUILD is the
# folder for what is built, absolute; CXX a compiler for this PC.
set -u
cd "$(dirname "$0")" || exit 1
out="${BUILD:-$(cd ../../.. && pwd)/build/test}/avr"

build() {
  "${MAKE:-make}" --no-print-directory -f build.mk OUT="$out" CXX="${CXX:-g++}" "$@"
}

printf '\navr: the examples on simulated ATmega2560, 32U4 and 328P, with the AVR core of Arduino\n'
mkdir -p "$out"
build -s -k all 2>&1 && built=yes || built=
targets=$(build list) || echo "FAILED avr: build.mk"
for target in $targets; do
  name=${target#"$out/"}
  case $name in
    *.elf) what="${name%.elf} compiles without a warning" ;;
    *.rejected) what="${name%.rejected} says why it cannot run, and what to do" ;;
    *) what="$name is built" ;;
  esac
  if [ -n "$built" ] || build -q "$target" >/dev/null 2>&1; then echo "ok avr: $what"; else echo "FAILED avr: $what"; fi
done
for board in leonardo uno; do
  here=$(for example in ../../../examples/*; do echo "$targets" | grep -xF "$out/$board/${example##*/}.elf"; done)
  there=$(sed -n "/fqbn: arduino:avr:$board\$/,/platforms:/s,.*- examples/\(.*\),$out/$board/\1.elf,p" ../../../.github/workflows/examples.yml)
  [ -n "$here" ] && [ "$(echo "$there" | sort)" = "$(echo "$here" | sort)" ] && echo "ok avr: examples.yml has the examples that compile for $board" ||
    echo "FAILED avr: examples.yml has other examples for $board than compile here"
done
timeout 1800 "$out/BoardTest" --no-version --no-intro >"$out/log" 2>&1
status=$?
cat "$out/log"
[ "$status" -eq 0 ] || grep -q '^\[doctest\] test cases:.*[1-9][0-9]* failed' "$out/log" ||
  echo "FAILED avr: BoardTest ended with status $status before its end"
