#!/bin/sh
# Keeps the rows of measured.md's tables, which stand between <!-- NAME: begin --> and <!-- NAME: end -->. The page has
# some of the rows that a command prints; a row is found by its first cell.
#   figures.sh         prints all tables and writes the page's rows, and those of rules.md, some minutes; FRAMES=n
#                      shortens that
#   figures.sh check   says "ok ...", "FAILED ..." or "skipped ..." of each that takes seconds: is it up to date?
# A table is checked only with the compilers that its first line names: others make other code. BUILD is an absolute
# folder for what is built.
set -u
cd "$(dirname "$0")" || exit 1
page=measured.md
export BUILD="${BUILD:-$(cd ../.. && pwd)/build/test}"
out=$BUILD/figures
mkdir -p "$out"

print() {  # NAME [ONLY=...]
  "${MAKE:-make}" --no-print-directory -s -C ../.. BUILD="$BUILD" "$@"
}

on_page() {  # NAME
  sed -n "/^<!-- $1: begin -->/,/^<!-- $1: end -->/p" $page | grep -vE '^(<!--.*)?$'
}

verdict() {  # STATUS WHAT
  if [ "$1" -eq 0 ]; then echo "ok figures: $2"; else echo "FAILED figures: $2: make figures"; fi
}

# check NAME [LINE]: each row of the page's table is printed now; of the impairment table, which takes minutes, one line
check() {
  if [ "$1" = bench ] && [ -n "$(../setup/arm-specs.sh)" ]; then
    echo "skipped figures: bench, there is no newlib for ARM here"
    return
  fi
  on_page "$1" | grep "^[^|]\|^| ${2:-}" >"$out/$1.page"
  print "$1" ${2:+ONLY="$2"} >"$out/$1" 2>"$out/$1.err" || cat "$out/$1.err"
  if [ -z "${2:-}" ] && [ -s "$out/$1" ] && [ "$(sed 1q "$out/$1.page")" != "$(sed 1q "$out/$1")" ]; then
    echo "skipped figures: $1, these compilers are others: $(sed 1q "$out/$1")"
    return
  fi
  [ "$(grep -c '^| ' "$out/$1.page")" -gt 0 ] && ! grep -vxF -f "$out/$1" "$out/$1.page"
  verdict $? "make $1${2:+ ONLY='$2'}"
}

# ms are cycles at 32 MHz.
check_times() {
  wrong=$(grep -oE '[0-9]+( cycles)?(,| \() ?[0-9]+\.[0-9]+ ms' $page | while read -r figure; do
    echo "$figure" | tr -c '0-9.\n' ' ' | awk '{ exit sprintf("%.2f", $1 / 32000) != $2 }' || echo "$figure: 32000 cycles are 1 ms"
  done)
  [ -z "$wrong" ] || { echo "$wrong"; false; }
  verdict $? "$page's times are its cycles"
}

# What test/boards/avr/PinTest.cpp says of the time that a line takes.
check_pin() {
  if [ ! -x "$BUILD/avr/BoardTest" ]; then
    echo "skipped figures: a line on a pin, boards-avr has not been built"
    return
  fi
  shares=$("$BUILD/avr/BoardTest" -tc='a line on a pin takes*' |
    sed -n 's/.*: on the pin \([0-9.]*\) %, on the port \([0-9.]*\) %.*/\1 \2/p' | awk '{ printf "%.1f %.1f", $1, $2 }')
  [ -n "$shares" ] && [ "$(on_page pin | sed -n 's/^|.* | \([0-9.]*\) |$/\1/p' | paste -sd ' ')" = "$shares" ]
  verdict $? "a line on a pin: $shares %"
}

# The lines of receiver.md: a row is found by its first cell.
print_stretched() {
  for only in ', loop of ' 'called back: clean, '; do
    SUMMARY=1 print impairment ONLY="$only" || exit 1
  done >"$out/stretched" 2>"$out/stretched.err"
}
check_stretched() {
  print_stretched
  grep -E '^[|] .*(, loop of |called back: )' receiver.md >"$out/stretched.page" &&
    ! grep -vxF -f "$out/stretched" "$out/stretched.page"
  verdict $? "receiver.md, stretched frames"
}

if [ "${1:-}" = check ]; then
  unset FRAMES SEED ONLY FULL SUMMARY BOUNDS RATES WITHOUT
  printf '\nfigures: are the tables of extras/docs/measured.md up to date?\n'
  check size
  check bench
  check impairment 'Fast S.Bus, bursts'
  check_stretched
  check_times
  check_pin
  ../../test/impairment/without.sh current
  exit
fi

for name in size bench impairment; do
  print "$name" >"$out/$name" || exit 1
  cat "$out/$name"
  # The first line of a section, and each row whose first cell and number of cells are printed.
  awk -F ' [|] ' -v mark="<!-- $name: " '
    NR == FNR { first = FNR == 1 ? $0 : first; printed[NF, $1] = $0; next }
    index($0, mark) { inside = index($0, "begin"); found = 1 }
    inside && first != "" && !/^(<!--.*)?$/ { $0 = first; first = "" }
    inside && /^[|] / && (NF, $1) in printed { $0 = printed[NF, $1] }
    { print }
    END { exit !found }' "$out/$name" $page >"$out/page" || exit 1
  cp "$out/page" $page
done
print_stretched
awk -F ' [|] ' 'NR == FNR { printed[$1] = $0; next } /^[|] / && $1 in printed && !/^[|] (line|---)/ { $0 = printed[$1] } { print }' \
  "$out/stretched" receiver.md >"$out/page" && cp "$out/page" receiver.md
awk -F ' [|] ' '$4 >= 100' "$out/impairment" | grep '^| ' | grep -vxF -f $page &&
  echo "$page lacks these lines, with 100 wrong frames or more: add them." >&2
../../test/impairment/without.sh table
