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
    printf '\n%s, %s: %s\n' "$1" "$name" "$(sed -n '1s,^// ,,p' "unit/$name.cpp")"
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

mkdir -p "$BUILD"
{
  run_unit g++
  run_unit clang++
  run_compile g++
  ./golden.sh g++
  ./golden.sh clang++
} 2>&1 | tee "$BUILD/log"
awk -f count.awk "$BUILD/log"
