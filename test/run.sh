#!/bin/sh
# Builds and runs every test. A check that is no doctest case says "ok ..." or "FAILED ..." on a line of its own, and
# count.awk adds these to doctest's own summaries. What does not build counts as failed, so does a program that crashes.
set -u
cd "$(dirname "$0")" || exit 1
export BUILD="${BUILD:-$PWD/../build/test}"
export RC_PARAMS="${RC_PARAMS:-seed=20181}"  # any number: the same one, so that a failure comes again

# build COMPILER ARGUMENTS...
build() {
  compiler=$1
  shift
  "${MAKE:-make}" --no-print-directory -f build.mk CXX="$compiler" OUT="$BUILD/$compiler" "$@"
}

run_unit() {
  build "$1" -k unit
  for program in $(build "$1" list-unit); do
    name=$(basename "$program")
    printf '\n%s, %s: %s\n' "$1" "$name" "$(sed -n '1s,^// ,,p' "${program#"$BUILD/$1/"}.cpp")"
    if ! build "$1" -q "$program" >"$program.log" 2>&1; then
      echo "FAILED $name does not build with $1"
      continue
    fi
    timeout 120 "$program" --no-version --no-intro >"$program.log" 2>&1
    status=$?
    cat "$program.log"
    if ! grep -q '^\[doctest\] test cases: *[1-9]' "$program.log"; then
      echo "FAILED $name ended with status $status before its end, or ran nothing"
    elif [ "$status" -ne 0 ] && grep -q '^\[doctest\] test cases:.* 0 failed' "$program.log"; then
      echo "FAILED $name ended with status $status"
    fi
  done
}

run_compile() {
  build "$1" -k compile
  printf '\n%s: what only has to compile\n' "$1"
  for target in $(build "$1" list-compile); do
    name=${target#"$BUILD/$1/"}
    if build "$1" -q "$target" >/dev/null 2>&1; then
      echo "ok $name"
    else
      echo "FAILED $name does not compile"
    fi
  done
}

# The torture bench: its bounds, built for speed; then the whole table once, short, under the sanitizers.
run_line() {
  line="$BUILD/$1/line"
  build "$1" -k "$line/TortureTest" "$line-sanitized/Torture"
  printf '\n%s, line: %s\n' "$1" "$(sed -n '1s,^// ,,p' line/TortureTest.cpp)"
  if ! build "$1" -q "$line/TortureTest" >/dev/null 2>&1; then
    echo "FAILED TortureTest does not build with $1"
  else
    timeout 300 "$line/TortureTest" --no-version --no-intro >"$line.log" 2>&1
    cat "$line.log"
    grep -q '^\[doctest\] test cases: *[1-9]' "$line.log" || echo "FAILED TortureTest ended before its end"
  fi
  if build "$1" -q "$line-sanitized/Torture" >/dev/null 2>&1 &&
    FRAMES=200 timeout 120 "$line-sanitized/Torture" >"$line.table"; then
    echo "ok line/Torture under the sanitizers"
  else
    echo "FAILED line/Torture under the sanitizers"
  fi
}

# Recordings of real receivers, if the caller has any: CAPTURES=folder.
run_captures() {
  printf '\n%s, captures/Replay: %s\n' "$1" "$(sed -n '1s,^// ,,p' captures/Replay.cpp)"
  if ! build "$1" captures; then
    echo "FAILED captures/Replay does not build with $1"
  elif ! timeout 120 "$BUILD/$1/captures/Replay" "$CAPTURES" >"$BUILD/$1/captures/log"; then
    grep -q '^FAILED ' "$BUILD/$1/captures/log" || echo "FAILED captures/Replay ended before its end"
  fi
  cat "$BUILD/$1/captures/log"
}

mkdir -p "$BUILD"
{
  run_unit g++
  run_unit clang++
  run_line g++
  line/without.sh check
  run_compile g++
  if [ -n "${CAPTURES:-}" ]; then run_captures g++; fi
  ./fuzz.sh
  ./golden.sh g++
  ./golden.sh clang++
  boards/mega/run.sh
  boards/cortex-m0/run.sh
  bench/bench.sh check
  ../extras/docs/figures.sh check
} 2>&1 | tee "$BUILD/log"
awk -f count.awk "$BUILD/log"
