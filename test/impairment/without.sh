#!/bin/sh
# Compiles a copy of the library without a rule, and prints what that costs: the lines of the impairment bench as they are, and
# without it. Each rule is a function: in the copy it returns at once what RULES says.
#   without.sh NAME    a rule of RULES; another name prints them all
#   without.sh check   says "ok ..." or "FAILED ..." of each rule: is it one function, does the core compile without it, and has
#                      extras/docs/receiver.md a row for it?
# BUILD: an absolute folder for what is built. FRAMES, SEED and ONLY as for `make impairment`.
set -u
cd "$(dirname "$0")" || exit 1
tab=$(printf '\t')

rules=$(grep -v '^#' RULES | cut -f1)
column() { grep "^$1$tab" RULES | cut -f"$2"; }  # NAME NUMBER

# Makes BUILD/without/NAME/src, the library without this rule. What has not changed keeps its time.
copy() {  # NAME
  copy=$BUILD/without/$1
  rm -rf "$copy/new"
  mkdir -p "$copy"
  cp -Rp ../../src "$copy/new"
  definition="^.*\(bool\|int\) $(column "$1" 2)(.*) \(const \)\{0,1\}{"
  [ "$(cat "$copy/new/sbus"/*.h | grep -c "$definition")" = 1 ] || return 1
  sed -i "s/$definition/& return $(column "$1" 3);/" "$(grep -l "$definition" "$copy/new/sbus"/*.h)"
  if diff -r "$copy/new" "$copy/src" >/dev/null 2>&1; then rm -r "$copy/new"; else
    rm -rf "$copy/src"
    mv "$copy/new" "$copy/src"
  fi
}

impairment() {  # SRC OUT
  for target in host "$2/impairment/Impairment"; do
    make --no-print-directory -s -C .. -f build.mk SRC="$1" OUT="$2" "$target" 1>&2 || exit 1
  done
  SUMMARY=1 ONLY=$lines "$2/impairment/Impairment" | grep '^|' | tail -n +3
}

if [ "$1" = check ]; then
  for rule in $rules; do
    if ! copy "$rule"; then echo "FAILED impairment/RULES: $rule: $(column "$rule" 2)() is not one function of src/sbus/*.h"
    elif ! echo "template class sbus::FrameFinderOf<sbus::Frame16>;" |
      g++ -std=gnu++11 -I"$BUILD/without/$rule/src" -include sbus/FrameFinder.h -fsyntax-only -x c++ -; then
      echo "FAILED impairment/RULES: the core does not compile without $rule"
    elif [ -z "$(column "$rule" 4)" ]; then echo "FAILED impairment/RULES: no line shows what the rule $rule is worth"
    elif ! grep -q "| \`$rule\` |" ../../extras/docs/receiver.md; then echo "FAILED receiver.md: no row for the rule $rule"
    else echo "ok impairment/RULES: $rule"; fi
  done
elif echo "$rules" | grep -qx "$1"; then
  lines=${ONLY:-$(column "$1" 4)}
  echo "as it is | damaged | missed | wrong | late |"
  impairment ../src "$BUILD/plain" || exit 1
  echo "without the rule \"$1\""
  copy "$1" && impairment "$BUILD/without/$1/src" "$BUILD/without/$1" || exit 1
else
  echo "There is no rule \"$1\". The rules are: $(echo "$rules" | tr '\n' ' ')" >&2
  exit 2
fi
