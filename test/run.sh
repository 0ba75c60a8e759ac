#!/bin/sh
# Runs the tests, several steps at once, one line a step; the last line says "N passed, N failed".
#   run.sh          all
#   run.sh check    those that find most: unit tests, examples
#   run.sh step N   one of all, by its number in `all`
# V=1 prints all output of the steps; otherwise it is in BUILD/log. CAPTURES=folder: recordings of real receivers.
# STEPS='tool|bench' runs these of them.
#
# A check that is no doctest case says "ok ..." or "FAILED ..." on a line of its own. What does not build is a failure,
# so is a program that crashes.
set -u
cd "$(dirname "$0")" || exit 1
export BUILD="${BUILD:-$(cd .. && pwd)/build/test}"
export RC_PARAMS="${RC_PARAMS:-seed=20181}"  # any number: the same one, so that a failure comes again

# The longest first, and what waits for others last. What is before the dash is a function below, what is after it its argument.
all='scope            the page in a browser
lines            lines against their bounds
bench            what the library costs
unit-g++         unit tests, g++ with sanitizers
unit-clang++     unit tests, clang++ -O2
boards-cortex-m0 Cortex-M0: unit tests
boards-mega      Arduino Mega: examples
tool             sbus: what it prints, records and rejects
fuzz             libFuzzer
boards-cores     other cores: library and examples on stand-ins
examples-g++     examples and recordings, g++ with sanitizers
examples-clang++ examples and recordings, clang++ -O2
table            the table of bad lines, under the sanitizers
compile          headers alone, Arduino'"'"'s macros, the cross compiler
rules            the rules of receiver.md
package          the ZIP, and a release
platforms        without Arduino: CMake, ESP-IDF, Zephyr; PlatformIO
uses             every public function is used by a sketch; keywords
captures         recordings of real receivers
figures          the figures of measured.md
commands         the commands of the pages'
quick=$(echo "$all" | grep -E '^(unit|examples)-g\+\+ ')
[ -n "${CAPTURES:-}" ] || all=$(echo "$all" | grep -v '^captures')

# build COMPILER ARGUMENTS...
build() {
  compiler=$1
  shift
  "${MAKE:-make}" --no-print-directory -f build.mk CXX="$compiler" OUT="$BUILD/$compiler" "$@"
}

# doctest PROGRAM SECONDS   (against a program that hangs: a slow machine has far more time than it needs)
doctest() {
  timeout "$2" "$1" --no-version --no-intro >"$1.log" 2>&1
  status=$?
  cat "$1.log"
  if ! grep -q '^\[doctest\] test cases: *[1-9]' "$1.log"; then
    echo "FAILED ${1##*/} ended with status $status before its end, or ran nothing"
  elif [ "$status" -ne 0 ] && grep -q '^\[doctest\] test cases:.* 0 failed' "$1.log"; then
    echo "FAILED ${1##*/} ended with status $status"
  fi
}

step_unit() {
  # make is asked about each program only if it has not made all: an answer takes 0.2 s.
  build "$1" -k unit && built=yes || built=
  for program in $(build "$1" list-unit); do
    printf '\n%s: %s\n' "${program##*/}" "$(sed -n '1s,^// ,,p' "${program#"$BUILD/$1/"}.cpp")"
    if [ -n "$built" ] || build "$1" -q "$program" >"$program.log" 2>&1; then
      doctest "$program" 900
    else
      echo "FAILED ${program##*/} does not build with $1"
    fi
  done
}

step_lines() {
  if build g++ "$BUILD/g++/impairment/ImpairmentTest"; then doctest "$BUILD/g++/impairment/ImpairmentTest" 1800; else
    echo "FAILED ImpairmentTest does not build"
  fi
}

step_table() {
  if build g++ "$BUILD/g++/impairment-sanitized/Impairment" && FRAMES=50 timeout 900 "$BUILD/g++/impairment-sanitized/Impairment"; then
    echo "ok impairment/Impairment under the sanitizers"
  else
    echo "FAILED impairment/Impairment under the sanitizers"
  fi
}

step_compile() {
  build g++ -k compile && built=yes || built=
  for target in $(build g++ list-compile); do
    name=${target#"$BUILD/g++/"}
    if [ -n "$built" ] || build g++ -q "$target" >/dev/null 2>&1; then echo "ok $name"; else echo "FAILED $name does not compile"; fi
  done
}

step_captures() {
  if ! build g++ captures; then
    echo "FAILED captures/Replay does not build"
  elif ! timeout 900 "$BUILD/g++/captures/Replay" "$CAPTURES" >"$BUILD/captures.log"; then
    grep -q '^FAILED ' "$BUILD/captures.log" || echo "FAILED captures/Replay ended before its end"
  fi
  cat "$BUILD/captures.log"
}

step_rules() { impairment/without.sh check; }
step_scope() { scope/run.sh; }
step_package() { ./package.sh; }
step_platforms() { platforms/run.sh; }
step_uses() { ./uses.sh; }
step_tool() { tool/run.sh; }
step_fuzz() { SECONDS_EACH=3 ./fuzz.sh; }
step_examples() { ./golden.sh "$1"; }
step_boards() {
  [ "$1" != cortex-m0 ] || { newlib && after unit-g++; } || return
  boards/"$1"/run.sh
}
step_bench() { newlib && bench/bench.sh check; }

# Start-up and output of the programs on the simulated Cortex-M0 are newlib's; Debian 14 has another C library.
newlib() {
  [ -z "$(../extras/setup/arm-specs.sh)" ] || { echo "skipped $this: there is no newlib for ARM here"; false; }
}
step_figures() { after lines bench && ../extras/docs/figures.sh check; }
step_commands() { after scope tool package figures && ./commands.sh; }

# Waits until these steps are done, which stand before this one in `all`: it takes what they have built, or their logs.
after() {
  for earlier in "$@"; do
    while echo "$CHOSEN" | grep -q "^$earlier " && ! grep -qxF "$earlier" "$STEP_LOGS/done" 2>/dev/null; do sleep 0.5; done
  done
}

# Runs step N, and says how it went. (The functions above set `name`.)
step() {
  line=$(echo "$all" | sed -n "$1p")
  this=${line%% *}
  title=$(echo "${line#"$this"}" | sed 's/^ *//')
  case $this in
    *-*) "step_${this%%-*}" "${this#*-}" ;;
    *) "step_$this" ;;
  esac >"$STEP_LOGS/$this.log" 2>&1
  sum=$(awk -f count.awk "$STEP_LOGS/$this.log")
  (
    flock 8
    echo "$this" >>"$STEP_LOGS/done"
    [ -z "${V:-}" ] || cat "$STEP_LOGS/$this.log"
    echo "[$(wc -l <"$STEP_LOGS/done")/$COUNT] $title: $(echo "$sum" | tail -n 1)"
    case $sum in *" 0 failed"*) ;; *)
      grep -E -m 1 -A 20 'ERROR:|FAILED|error:' "$STEP_LOGS/$this.log"
      echo "... all of it: $STEP_LOGS/$this.log"
    esac
  ) 8>"$STEP_LOGS/lock"
}

if [ "${1:-}" = step ]; then
  step "$2"
  exit
fi

mkdir -p "$BUILD"
if [ -n "${STEP_LOGS:-}" ]; then
  STEP_LOGS=$STEP_LOGS/commands  # called by commands.sh: the lock is ours
else
  STEP_LOGS=$BUILD/steps
  exec 9>"$BUILD/lock"
  flock -n 9 || { echo "Other tests are running here: waiting for their end."; flock 9; }
fi
export STEP_LOGS
rm -rf "$STEP_LOGS"
mkdir -p "$STEP_LOGS"
[ "${1:-}" = check ] && chosen=$quick || chosen=$all
if [ -n "${STEPS:-}" ]; then
  chosen=$(echo "$chosen" | grep -E "^($STEPS) ") || { echo "STEPS: no step has the name '$STEPS'" >&2; exit 2; }
fi
COUNT=$(echo "$chosen" | wc -l)
export COUNT CHOSEN="$chosen"
# Several steps need what these make: make it once.
build g++ -k unit >"$STEP_LOGS/build.log" 2>&1
numbers() { while read -r line; do echo "$all" | grep -nF "$line" | cut -d: -f1; done; }
# One more than there are processors: the page's tests also wait.
echo "$chosen" | numbers | xargs -r -P "$(($(nproc) + 1))" -n 1 "$0" step
echo "$chosen" | while read -r name _; do cat "$STEP_LOGS/$name.log"; done >"$BUILD/log"
awk -f count.awk "$BUILD/log"
