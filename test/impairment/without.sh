#!/bin/sh
# Compiles a copy of the library without a rule, and prints what that costs: the lines of the impairment bench as they are, and
# without it. Each rule is a function: in the copy it returns at once what RULES says.
#   without.sh NAME     a rule of RULES; another name prints them all
#   without.sh table    measures all of them, some minutes, and writes the last two columns of rules.md's table
#   without.sh current TABLE   says "ok ..." or "FAILED ..." of each rule: is the column "missed, wrong" as in TABLE, what
#                       `make impairment` has printed?
#   without.sh check    says "ok ..." or "FAILED ..." of each rule: is it one function, does the core compile without it, and
#                       has extras/docs/rules.md a row for it?
# BUILD: an absolute folder for what is built. FRAMES, SEED and ONLY as for `make impairment`.
set -u
cd "$(dirname "$0")" || exit 1
tab=$(printf '\t')

page=../../extras/docs/rules.md
plain=$BUILD/plain

rules=$(grep -v '^#' RULES | cut -f1)
column() { grep "^$1$tab" RULES | cut -f"$2"; }  # NAME NUMBER

# Makes BUILD/without/NAME/src, the library without this rule. What has not changed keeps its time.
copy() {  # NAME
  copy=$BUILD/without/$1
  rm -rf "$copy/new"
  mkdir -p "$copy"
  cp -Rp ../../src "$copy/new"
  definition="^.*\(bool\|int\|int_fast8_t\) $(column "$1" 2)(.*) \(const \)\{0,1\}{"
  [ "$(cat "$copy/new/sbus"/*.h | grep -c "$definition")" = 1 ] || return 1
  sed -i "s/$definition/& return $(column "$1" 3);/" "$(grep -l "$definition" "$copy/new/sbus"/*.h)"
  if diff -r "$copy/new" "$copy/src" >/dev/null 2>&1; then rm -r "$copy/new"; else
    rm -rf "$copy/src"
    mv "$copy/new" "$copy/src"
  fi
}

build() { make --no-print-directory -s -C .. -f build.mk "$@" 1>&2; }
bench() { build OUT="$plain" host && build OUT="$plain" "$plain/impairment/Impairment"; }

# Links the bench without this rule: of its sources Simulation.cpp alone takes the rules, which are inline.
bench_without() {  # NAME
  made=$BUILD/without/$1
  # shellcheck disable=SC2046  # the objects are words
  copy "$1" && build SRC="$made/src" OUT="$made" "$made/impairment/Simulation.o" &&
    "${CXX:-g++}" -o "$made/Impairment" "$made/impairment/Simulation.o" "$plain/support/FakeClock.o" \
      $(find "$plain/impairment" -name '*.o' ! -name Simulation.o ! -name ImpairmentTest.o) "$plain/board.a"
}

lines() { SUMMARY=1 ONLY=${ONLY:-$(column "$2" 4)} "$1" | grep '^|' | tail -n +3; }  # PROGRAM NAME
sums() { lines "$@" | awk -F ' [|] ' '{ missed += $3; wrong += $4 } END { print missed ", " wrong }'; }

if [ "$1" = check ]; then
  for rule in $rules; do
    if ! copy "$rule"; then echo "FAILED impairment/RULES: $rule: $(column "$rule" 2)() is not one function of src/sbus/*.h"
    elif ! echo "template class sbus::FrameFinderOf<sbus::Frame16>;" |
      g++ -std=gnu++11 -I"$BUILD/without/$rule/src" -include sbus/FrameFinder.h -fsyntax-only -x c++ -; then
      echo "FAILED impairment/RULES: the core does not compile without $rule"
    elif [ -z "$(column "$rule" 4)" ]; then echo "FAILED impairment/RULES: no line shows what the rule $rule is worth"
    elif ! grep -q "| \`$rule\` |" "$page"; then echo "FAILED rules.md: no row for the rule $rule"
    else echo "ok impairment/RULES: $rule"; fi
  done
elif [ "$1" = table ]; then
  bench || exit 1
  for rule in $rules; do
    bench_without "$rule" || exit 1
    with=$(sums "$plain/impairment/Impairment" "$rule")
    without=$(sums "$BUILD/without/$rule/Impairment" "$rule")
    echo "$rule: $with; without it $without"
    sed -i "s/^\(| .* | \`$rule\` | [^|]* |\) .* |\$/\1 $with | $without |/" "$page"
  done
elif [ "$1" = current ]; then
  for rule in $rules; do
    with=$(awk -F ' [|] ' -v only="$(column "$rule" 4)" \
      '/^[|] / && index($1, only) { missed += $3; wrong += $5 } END { print missed ", " wrong }' "$2")
    if grep -q "| \`$rule\` | [^|]* | $with | [^|]* |\$" "$page"; then echo "ok rules.md: $rule"
    else echo "FAILED rules.md: the rule $rule: now $with: test/impairment/without.sh table"; fi
  done
elif echo "$rules" | grep -qx "$1"; then
  bench && bench_without "$1" || exit 1
  echo "as it is | damaged | missed | wrong | late |"
  lines "$plain/impairment/Impairment" "$1"
  echo "without the rule \"$1\""
  lines "$BUILD/without/$1/Impairment" "$1"
else
  echo "There is no rule \"$1\". The rules are: $(echo "$rules" | tr '\n' ' ')" >&2
  exit 2
fi
