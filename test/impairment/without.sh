#!/bin/sh
# Compiles the receiver without a rule and prints what that costs: the lines of the impairment bench as they are, and without it.
#   without.sh NAME    a rule of src/sbus/Rule.h; another name prints them all
#   without.sh check   says "ok ..." or "FAILED ..." of each rule: has it a row in RULES and one in extras/docs/receiver.md?
# BUILD: an absolute folder for what is built. FRAMES, SEED and ONLY as for `make impairment`.
set -u
cd "$(dirname "$0")" || exit 1
tab=$(printf '\t')

rules=$(sed -n '/^enum class Rule/,/^};/s/^  \([A-Za-z]*\),.*/\1/p' ../../src/sbus/Rule.h | grep -vx none)
lines_of() { sed -n "s/^$1$tab//p" RULES; }

impairment() {  # OUT [RULE]
  for target in host "$1/impairment/Impairment"; do
    make --no-print-directory -s -C .. -f build.mk OUT="$1" FLAGS="-O1${2:+ -DSBUS_WITHOUT=$2}" "$target" 1>&2 || exit 1
  done
  SUMMARY=1 ONLY=$lines "$1/impairment/Impairment" | grep '^|' | tail -n +3
}

if [ "$1" = check ]; then
  for rule in $rules; do
    if [ -z "$(lines_of "$rule")" ]; then echo "FAILED impairment/RULES: no line shows what the rule $rule is worth"
    elif ! grep -q "| \`$rule\` |" ../../extras/docs/receiver.md; then echo "FAILED receiver.md: no row for the rule $rule"
    else echo "ok impairment/RULES: $rule"; fi
  done
  grep -v '^#' RULES | cut -f1 | while read -r name; do
    echo "$rules" | grep -qx "$name" || echo "FAILED impairment/RULES: there is no rule $name"
  done
elif echo "$rules" | grep -qx "$1"; then
  lines=${ONLY:-$(lines_of "$1")}
  echo "as it is | damaged | missed | wrong | late |"
  impairment "$BUILD/plain" || exit 1
  echo "without the rule \"$1\""
  impairment "$BUILD/without/$1" "$1" || exit 1
else
  echo "There is no rule \"$1\". The rules are: $(echo "$rules" | tr '\n' ' ')" >&2
  exit 2
fi
