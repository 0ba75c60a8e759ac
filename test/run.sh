#!/bin/sh
# Runs tests, several steps at once, one line a step; the last line says "N passed, N failed".
#   run.sh test       what a change needs, in a minute
#   run.sh test-all   everything
#   run.sh step NAME  one of the steps below
# ONLY=LinkTest runs one file of unit/ or host/; STEPS='tool|bench' runs these steps of test-all.
# V=1 prints all output of the steps; otherwise it is in BUILD/log. CAPTURES=folder: recordings of real receivers.
# SEED=n repeats a run's random tests: each day has another seed, and the first line says which.
#
# A check that is no doctest case says "ok ..." or "FAILED ..." on a line of its own. What does not build is a failure,
# so is a program that crashes.
set -u
cd "$(dirname "$0")" || exit 1
export BUILD="${BUILD:-$(cd .. && pwd)/build/test}"
export SEED="${SEED:-$(($(date +%s) / 86400))}"

# Which of `test` and `test-all` run it, its name, its title. What is after the dash is the argument of the function
# step_... below. The longest first, and what waits for others last.
steps='
all  scope            the page in a browser
all  lines-5000       impaired lines against their bounds
all  bench            what the library costs
test unit-plain       unit tests
all  unit-sanitized   unit tests, clang++ -O2 with sanitizers
all  boards-cortex-m0 Cortex-M0: unit tests
all  boards-avr       Arduino Mega, Leonardo, Uno: examples
all  tool             sbus: what it prints, records and rejects
all  fuzz             libFuzzer
all  boards-cores     other cores: library and examples on stand-ins
test examples-plain   examples
all  examples-sanitized examples, clang++ with sanitizers
all  sketches-sanitized sketches in the style of forums
test lines-300        impaired lines against their bounds
all  compile          headers alone, the cross compiler
both rules            the rules of rules.md
all  package          the ZIP, and a release
all  format           .clang-format
all  platforms        without Arduino: CMake, ESP-IDF, Zephyr; PlatformIO
all  setup            what is said where packages are missing
both uses             every public function is used by a sketch; keywords
all  captures         recordings of real receivers
all  figures          the figures of measured.md
all  dist             what a release offers
all  commands         the commands of the pages'

# build VARIANT TARGETS...
build() {
  variant=$1
  shift
  "${MAKE:-make}" --no-print-directory -f build.mk VARIANT="$variant" OUT="$BUILD/$variant" host &&
    "${MAKE:-make}" --no-print-directory -f build.mk VARIANT="$variant" OUT="$BUILD/$variant" "$@"
}

# doctest PROGRAM SECONDS [ARGUMENTS...]   (against a program that hangs: a slow machine has far more time than it needs)
doctest() {
  program=$1 seconds=$2
  shift 2
  printf '\n%s\n' "${program##*/}"
  timeout "$seconds" "$program" --no-version --no-intro "$@" >"$program.log" 2>&1
  status=$?
  cat "$program.log"
  if ! grep -q '^\[doctest\] test cases: *[1-9]' "$program.log"; then
    echo "FAILED ${program##*/} ended with status $status before its end, or ran nothing"
  elif [ "$status" -ne 0 ] && grep -q '^\[doctest\] test cases:.* 0 failed' "$program.log"; then
    echo "FAILED ${program##*/} ended with status $status"
  fi
}

step_unit() {
  build "$1" -k unit
  for program in UnitTest HostTest PreemptTest; do
    if build "$1" -q "$BUILD/$1/$program" >/dev/null 2>&1; then doctest "$BUILD/$1/$program" 900; else
      echo "FAILED $program does not build"
    fi
  done
}

step_lines() {
  if build plain lines; then FRAMES=$1 doctest "$BUILD/plain/impairment/ImpairmentTest" 1800; else
    echo "FAILED ImpairmentTest does not build"
  fi
}

step_compile() {
  build plain -k compile && built=yes || built=
  for target in $(build plain list-compile); do
    name=${target#"$BUILD/plain/"}
    if [ -n "$built" ] || build plain -q "$target" >/dev/null 2>&1; then echo "ok $name"; else echo "FAILED $name does not compile"; fi
  done
}

step_captures() {
  if ! build sanitized captures; then
    echo "FAILED captures/Replay does not build"
  elif ! timeout 900 "$BUILD/sanitized/captures/Replay" "$CAPTURES" >"$BUILD/captures.log"; then
    grep -q '^FAILED ' "$BUILD/captures.log" || echo "FAILED captures/Replay ended before its end"
  fi
  cat "$BUILD/captures.log"
}

# What clang-format wants to break differs from version to version: where 14 is missing nothing is checked.
step_format() {
  ../extras/setup/format.sh check
  case $? in
    0) echo "ok every file is formatted as .clang-format says" ;;
    3) echo "skipped $this: there is no clang-format 14 here" ;;
    *) echo "FAILED format: \`make format\` mends it" ;;
  esac
}

step_rules() { impairment/without.sh check; }
step_scope() { scope/run.sh; }
step_package() { ./package.sh; }
step_platforms() { platforms/run.sh; }
step_setup() { ./setup.sh; }
step_uses() { ./uses.sh; }
step_tool() { tool/run.sh; }
step_fuzz() { SECONDS_EACH=3 ./fuzz.sh; }
step_examples() { ./golden.sh "$1"; }
step_sketches() { after "examples-$1" && sketches/run.sh "$1"; }
step_boards() {
  [ "$1" != cortex-m0 ] || { newlib && after unit-sanitized && build sanitized unit; } || return
  boards/"$1"/run.sh
}
step_bench() { newlib && bench/bench.sh check; }

# Start-up and output of the programs on the simulated Cortex-M0 are newlib's; Debian 14 has another C library.
newlib() {
  [ -z "$(../extras/setup/arm-specs.sh)" ] || { echo "skipped $this: there is no newlib for ARM here"; false; }
}
step_figures() { after lines-5000 bench boards-avr && ../extras/docs/figures.sh check; }
step_dist() {
  after scope
  export DIST="$BUILD/offered"  # dist.sh works in BUILD/dist
  if sh ../extras/setup/dist.sh; then ./dist.sh; else echo "FAILED dist: it does not build"; fi
}
step_commands() { after scope tool package dist figures && ./commands.sh; }

# Waits until these steps are done, which stand before this one in `steps`: it takes what they have built, or their logs.
after() {
  for earlier in "$@"; do
    while echo "$CHOSEN" | grep -qxF "$earlier" && ! grep -qxF "$earlier" "$STEP_LOGS/done" 2>/dev/null; do sleep 0.5; done
  done
}

# Runs this step, an hour at most, and says how it went.
step() {
  this=$1
  began=$(date +%s)
  timeout --foreground 3600 "$0" work "$this" >>"$STEP_LOGS/$this.log" 2>&1
  [ $? -ne 124 ] || echo "FAILED $this did not end" >>"$STEP_LOGS/$this.log"
  sum=$(awk -f count.awk "$STEP_LOGS/$this.log")
  if [ "$(echo "$sum" | tail -n 1)" = '0 passed, 0 failed' ]; then
    echo "FAILED $this ran nothing" >>"$STEP_LOGS/$this.log"
    sum=$(awk -f count.awk "$STEP_LOGS/$this.log")
  fi
  (
    flock 8
    echo "$this" >>"$STEP_LOGS/done"
    [ -z "${V:-}" ] || cat "$STEP_LOGS/$this.log"
    echo "[$(wc -l <"$STEP_LOGS/done")/$COUNT] $(echo "$steps" | sed -nE "s/^[a-z]+ +$this +//p"): $(echo "$sum" | tail -n 1) ($(($(date +%s) - began)) s)"
    case $sum in *" 0 failed"*) ;; *)
      grep -E -m 1 -A 20 'ERROR:|FAILED|error:' "$STEP_LOGS/$this.log"
      echo "... all of it: $STEP_LOGS/$this.log"
    esac
  ) 8>"$STEP_LOGS/lock"
}

# Builds what several steps of `test` need, and says how far it is.
build_plain() {
  compiled=' -c '
  files=$(export MAKEFLAGS=n; build plain -k unit lines 2>/dev/null | grep -ce "$compiled")
  build plain -k unit lines 2>"$STEP_LOGS/build.log" |
    awk -v files="$files" "/$compiled/"' && ++done % 20 == 0 { print "building: " done " of some " files " files"; fflush() }'
}

case ${1:-} in
  step)
    [ -n "${STEP_LOGS:-}" ] || STEPS=$2 exec "$0" test-all
    step "$2"
    exit ;;
  work)
    this=$2
    case $this in
      *-*) "step_${this%%-*}" "${this#*-}" ;;
      *) "step_$this" ;;
    esac
    exit ;;
esac

if [ -n "${ONLY:-}" ]; then
  case $(ls unit/"$ONLY".cpp host/"$ONLY".cpp 2>/dev/null) in
    '') echo "ONLY=$ONLY: there is no unit/$ONLY.cpp or host/$ONLY.cpp in test" >&2; exit 2 ;;
    unit/Preempt*) program=PreemptTest ;;
    unit/*) program=UnitTest ;;
    host/*) program=HostTest ;;
  esac
  build plain "$BUILD/plain/$program" >/dev/null || exit 1
  doctest "$BUILD/plain/$program" 900 --source-file="*/$ONLY.cpp" | tee "$BUILD/log"
  awk -f count.awk "$BUILD/log"
  exit
fi

mkdir -p "$BUILD"
if [ -n "${STEP_LOGS:-}" ]; then
  STEP_LOGS=$STEP_LOGS/commands  # called by commands.sh: the lock is ours
else
  STEP_LOGS=$BUILD/steps
  exec 9>"$BUILD/lock"
  flock -n 9 || { echo "Other tests are running here: waiting for their end, two hours at most."; flock -w 7200 9 || exit; }
fi
export STEP_LOGS
rm -rf "$STEP_LOGS"
mkdir -p "$STEP_LOGS"

tier=${1:-test}
chosen=$(echo "$steps" | grep -E "^(${tier#test-}|both) " | sed -E 's/^[a-z]+ +([^ ]+) .*/\1/')
[ -n "${CAPTURES:-}" ] || chosen=$(echo "$chosen" | grep -vx captures)
if [ -n "${STEPS:-}" ]; then
  chosen=$(echo "$steps" | awk '{ print $2 }' | grep -xE "$STEPS") || { echo "STEPS: no step has the name '$STEPS'" >&2; exit 2; }
fi
COUNT=$(echo "$chosen" | wc -l)
export COUNT CHOSEN="$chosen"
case $tier in
  test) time="about 30 s; the first time $((180 / $(nproc) + 1)) s more, to build them" ;;
  *) time='5 to 10 minutes; the first time 20 more, to build them' ;;
esac
last=$(cat "$BUILD/took-$tier" 2>/dev/null)
[ -n "${STEPS:-}" ] && time= || time=", $time${last:+ (last time here: $last s)}"
echo "$COUNT steps with seed $SEED$time."
began=$(date +%s)
case $chosen in *unit-plain*) build_plain ;; esac
# One more than there are processors: the page's tests also wait.
echo "$chosen" | xargs -r -P "$(($(nproc) + 1))" -n 1 "$0" step 9>&-  # what is left over must not keep the lock
[ -n "${STEPS:-}" ] || echo $(($(date +%s) - began)) >"$BUILD/took-$tier"
for name in $chosen; do cat "$STEP_LOGS/$name.log"; done >"$BUILD/log"
awk -f count.awk "$BUILD/log"
