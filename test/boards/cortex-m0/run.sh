#!/bin/sh
# Runs the unit programs on a Cortex-M0, QEMU's machine microbit, and says of each "ok cortex-m0: ..." or "FAILED
# cortex-m0: ...": every test case passes, and with as many assertions as on the host. CASES says what is left out, why.
# BUILD is the folder for what is built, absolute; FULL=1 leaves out nothing that is only slow.
set -u
cd "$(dirname "$0")" || exit 1
BUILD="${BUILD:-$PWD/../../../build/test}"
out="$BUILD/cortex-m0"
host="$BUILD/g++"
limit=$([ -n "${FULL:-}" ] && echo 300 || echo 60)  # seconds; the slowest program takes 5, and 40 if FULL=1

build() {
  "${MAKE:-make}" --no-print-directory -f build.mk OUT="$out" "$@"
}

build_host() {
  "${MAKE:-make}" --no-print-directory -C ../.. -f build.mk CXX=g++ OUT="$host" "$@"
}

verdict() {  # STATUS WHAT
  if [ "$1" -eq 0 ]; then echo "ok cortex-m0: $2"; else echo "FAILED cortex-m0: $2"; fi
}

patterns() {  # WHAT PROGRAM: of the file CASES, joined by commas, as doctest wants them
  awk -v what="$1" -v program="$2" '$1 == what && $2 == program { printf "%s%s", comma, $3; comma = "," }' CASES
}

counts() {  # LOG
  awk -f counts.awk "$1" >"$1.counts"
}

# What CASES says has to be about something, or a test that was renamed is taken in, or left out, unnoticed.
known_cases() {
  grep -v '^#' CASES >"$out/cases"
  while read -r what program pattern _; do
    if [ ! -f "../../unit/$program.cpp" ]; then
      false
    elif [ "$what" != out ]; then
      build_host -s "$host/unit/$program" >/dev/null 2>&1 &&
        "$host/unit/$program" -ltc -tc="$pattern" | grep -q 'passing the current filters: 1$'
    fi || verdict 1 "CASES: $what $program $pattern is no program, or not one test case"
  done <"$out/cases"
}

alignment() {
  if ! build -s alignment >"$out/log" 2>&1; then
    cat "$out/log"
    verdict 1 "AlignedRead and UnalignedRead do not build"
    return
  fi
  [ "$(timeout 20 ./qemu.sh "$out/AlignedRead")" = "read 03020100" ]
  verdict $? "a word at an even address is read"
  timeout 20 ./qemu.sh "$out/UnalignedRead" >"$out/log" 2>&1
  [ $? -eq 99 ] && grep -q '^HardFault' "$out/log" && ! grep -q read "$out/log"
  verdict $? "a word at an odd address is a fault, and ends the program"
}

unit() {  # PROGRAM
  log="$out/$1.xml"
  host_log="$out/$1.host.xml"
  if ! build -s "$out/unit/$1" >"$out/log" 2>&1; then
    head -n 20 "$out/log"
    verdict 1 "$1 does not build"
    return
  fi
  if ! build_host -s "$host/unit/$1" >/dev/null 2>&1; then
    verdict 1 "$1 does not build for the host, to be compared with"
    return
  fi
  slow=$([ -n "${FULL:-}" ] || patterns slow "$1")
  set -- "$1" -r=xml ${slow:+"-tce=$slow"}
  name=$1
  shift
  timeout "$limit" "$host/unit/$name" "$@" >"$host_log" 2>/dev/null
  if ! counts "$host_log"; then
    verdict 1 "$name fails on the host already"
    return
  fi
  # A comma between two patterns is QEMU's, too: there it is written twice.
  timeout "$limit" ./qemu.sh "$out/unit/$name" "$1" ${2:+"$(printf '%s' "$2" | sed 's/,/,,/g')"} >"$log" 2>"$out/log"
  status=$?
  counts "$log"
  passed=$?
  if [ "$status" -ne 0 ] || [ "$passed" -ne 0 ]; then
    cat "$out/log"
    grep -v '<\(OverallResults\|Options\|TestCase\|/TestCase\)' "$log" | head -n 40
    verdict 1 "$name ended with status $status, and passed not all of its test cases"
  elif ! cmp -s "$log.counts" "$host_log.counts"; then
    diff "$log.counts" "$host_log.counts" | sed 's/^</M0: /; s/^>/host:/' | head -n 10
    verdict 1 "$name passes, but makes other assertions than on the host"
  else
    verdict 0 "$name: $(awk -F, '{ cases++; assertions += $1 } END {
      print cases " test cases, " assertions " assertions, as on the host" }' "$log.counts")"
  fi
}

printf '\ncortex-m0: the unit programs on a Cortex-M0 (QEMU, microbit)\n'
mkdir -p "$out"
sed -n 's/^\(out\|slow\) */not run, \1: /p' CASES
build -s -k alignment unit >"$out/log" 2>&1
known_cases
alignment
programs=$(build list-unit)
for program in $programs; do
  unit "$program"
done
[ -n "$programs" ] || verdict 1 "there are no unit programs"
