#!/bin/sh
# Builds the examples, as they stand, for an Arduino Mega, and says "ok mega: ..." or "FAILED mega: ..." of each; then runs
# them on a simulated one, MegaTest.cpp. BUILD is the folder for what is built, absolute; CXX a compiler for this PC.
set -u
cd "$(dirname "$0")" || exit 1
out="${BUILD:-$(cd ../../.. && pwd)/build/test}/mega"

build() {
  "${MAKE:-make}" --no-print-directory -f build.mk OUT="$out" CXX="${CXX:-g++}" "$@"
}

printf '\nmega: the examples on a simulated ATmega2560, with the AVR core of Arduino\n'
mkdir -p "$out"
build -s -k all 2>&1 && built=yes || built=
targets=$(build list) || echo "FAILED mega: build.mk"
for target in $targets; do
  name=${target##*/}
  case $name in
    *.elf) what="${name%.elf} compiles without a warning" ;;
    *.leonardo) what="${name%.leonardo} compiles for the Leonardo, with the core's HID library" ;;
    *) what="$name is built" ;;
  esac
  if [ -n "$built" ] || build -q "$target" >/dev/null 2>&1; then echo "ok mega: $what"; else echo "FAILED mega: $what"; fi
done
timeout 1800 "$out/MegaTest" --no-version --no-intro >"$out/log" 2>&1
status=$?
cat "$out/log"
[ "$status" -eq 0 ] || grep -q '^\[doctest\] test cases:.*[1-9][0-9]* failed' "$out/log" ||
  echo "FAILED mega: MegaTest ended with status $status before its end"
