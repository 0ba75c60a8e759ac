#!/bin/sh
# Runs the unit programs on a Cortex-M0, QEMU's machine microbit, and says of each "ok cortex-m0: ..." or "FAILED
# cortex-m0: ...": every test case passes, and there are as many, with as many assertions, as on the host. build.mk says
# which program is left out. BUILD is the folder for what is built, absolute.
set -u
cd "$(dirname "$0")" || exit 1
BUILD="${BUILD:-$(cd ../../.. && pwd)/build/test}"
out="$BUILD/cortex-m0"

build() {
  "${MAKE:-make}" --no-print-directory -s -f build.mk OUT="$out" "$@"
}

# Writes what the same test cases say on the host, whose programs have been built.
on_host() {  # PROGRAM
  timeout 300 "$BUILD/sanitized/UnitTest" --no-version --source-file="*unit/$1.cpp"
}

verdict() {  # STATUS WHAT
  if [ "$1" -eq 0 ]; then echo "ok cortex-m0: $2"; else echo "FAILED cortex-m0: $2"; fi
}

alignment() {
  build alignment
  timeout 120 ./qemu.sh "$out/UnalignedRead" >"$out/log" 2>&1
  [ $? -eq 99 ] && grep -q '^HardFault' "$out/log" && ! grep -q read "$out/log"
  verdict $? "a word at an odd address is a fault, and ends the program"
}

# sums LOG: "test cases: N" and "assertions: N", of doctest's lines and of the M0's
sums() {
  sed -nE 's/^(\[doctest\] )?(test cases|assertions): *([0-9]+).*/\2: \3/p' "$1"
}

unit() {  # PROGRAM
  log="$out/$1.log"
  if [ -z "$built" ] && ! build "$out/unit/$1" >"$log" 2>&1; then
    tail -n 20 "$log"
    verdict 1 "$1 does not build"
    return
  fi
  on_host "$1" >"$log.host" 2>&1
  timeout 300 ./qemu.sh "$out/unit/$1" >"$log" 2>&1
  status=$?
  sums "$log" >"$log.sums"
  [ "$status" -eq 0 ] && grep -q 'test cases: *[1-9]' "$log.sums" && sums "$log.host" | diff - "$log.sums"
  passed=$?
  [ "$passed" -eq 0 ] || tail -n 40 "$log"
  verdict "$passed" "$1: all test cases pass, as many as on the host"
}

printf '\ncortex-m0: the unit programs on a Cortex-M0 (QEMU, microbit)\n'
mkdir -p "$out"
programs=$(build list-unit)
build -k alignment unit >"$out/log" 2>&1 && built=yes || built=
alignment
for program in $programs; do
  unit "$program"
done
[ -n "$programs" ] || verdict 1 "there are no unit programs"
