#!/bin/sh
# Keeps the rows of measured.md's tables, which stand between <!-- NAME: begin --> and <!-- NAME: end -->, and of the
# tables of lines on the other pages, whose heading is $heading. A page has some of the rows that a command prints; a row
# is found by its first cell.
#   figures.sh         prints all tables and writes the pages' rows, and those of rules.md, some minutes; FRAMES=n
#                      shortens that
#   figures.sh check   says "ok ...", "FAILED ..." or "skipped ..." of each: is it up to date?
# A table is checked only with the compilers that its first line names: others make other code. BUILD is an absolute
# folder for what is built.
set -u
cd "$(dirname "$0")" || exit 1
page=measured.md
heading='| line | damaged | missed | wrong | late | too young |'
export BUILD="${BUILD:-$(cd ../.. && pwd)/build/test}"
out=$BUILD/figures
mkdir -p "$out"

print() {  # NAME
  if [ "$1" != boards ]; then
    "${MAKE:-make}" --no-print-directory -s -C ../.. BUILD="$BUILD" "$1"
    return
  fi
  printf 'avr-g++ %s\n\n| on a simulated board | |\n| --- | --- |\n' "$(avr-g++ -dumpfullversion -dumpversion)"
  sed -n 's/.*MESSAGE: \(| .* |\)$/\1/p' "$BUILD/avr/log"
}

# Succeeds if BoardTest has said what these sketches do.
have_boards_run() {
  [ -e "$BUILD/avr/log" ] &&
    [ -z "$(find "$BUILD/avr" \( -name '*.elf' -o -name BoardTest \) -newer "$BUILD/avr/log")" ]
}

on_page() {  # NAME
  sed -n "/^<!-- $1: begin -->/,/^<!-- $1: end -->/p" $page | grep -vE '^(<!--.*)?$'
}

verdict() {  # STATUS WHAT
  if [ "$1" -eq 0 ]; then echo "ok figures: $2"; else echo "FAILED figures: $2: make figures"; fi
}

# Each row of the page's table is printed now.
check() {  # NAME
  if [ "$1" = bench ] && [ -n "$(../setup/arm-specs.sh)" ]; then
    echo "skipped figures: bench, there is no newlib for ARM here"
    return
  fi
  if [ "$1" = boards ] && ! have_boards_run; then
    echo "skipped figures: boards, STEPS=boards-avr has not run since they were built"
    return
  fi
  on_page "$1" >"$out/$1.page"
  print "$1" >"$out/$1" 2>"$out/$1.err" || cat "$out/$1.err"
  if [ -s "$out/$1" ] && [ "$(sed 1q "$out/$1.page")" != "$(sed 1q "$out/$1")" ]; then
    echo "skipped figures: $1, these compilers are others: $(sed 1q "$out/$1")"
    return
  fi
  [ "$(grep -c '^| ' "$out/$1.page")" -gt 0 ] && ! grep -vxF -f "$out/$1" "$out/$1.page"
  verdict $? "$1"
}

# ms are cycles at 32 MHz.
check_times() {
  wrong=$(grep -oE '[0-9]+( cycles)?(,| \() ?[0-9]+\.[0-9]+ ms' $page | while read -r figure; do
    echo "$figure" | tr -c '0-9.\n' ' ' | awk '{ exit sprintf("%.2f", $1 / 32000) != $2 }' || echo "$figure: 32000 cycles are 1 ms"
  done)
  [ -z "$wrong" ] || { echo "$wrong"; false; }
  verdict $? "$page's times are its cycles"
}

# What SUMMARY=1 prints, from what `make impairment` has printed.
sums() { awk -F ' [|] ' '/^[|] / { print $1 " | " $2 " | " $3 " | " $5 " | " $6 " | " $7 " |" }' "$out/impairment" >"$out/sums"; }
with_lines() { grep -lxF "$heading" ./*.md; }
check_lines() {
  sums
  for page_of_lines in $(with_lines); do
    awk -v heading="$heading" '!/^[|]/ { inside = 0 } inside && !/^[|] ---/; $0 == heading { inside = 1 }' \
      "$page_of_lines" >"$out/lines.page"
    [ -s "$out/lines.page" ] && ! grep -vxF -f "$out/sums" "$out/lines.page"
    verdict $? "$page_of_lines, its lines"
  done
}

if [ "${1:-}" = check ]; then
  unset FRAMES SEED ONLY FULL SUMMARY BOUNDS RATES WITHOUT
  printf '\nfigures: are the tables of extras/docs/measured.md up to date?\n'
  check size
  check bench
  check boards
  check impairment
  check_lines
  check_times
  ../../test/impairment/without.sh current "$out/impairment"
  exit
fi

"${MAKE:-make}" --no-print-directory -s -f ../../test/boards/avr/build.mk OUT="$BUILD/avr" all 1>&2
have_boards_run || ../../test/boards/avr/run.sh >"$out/boards.log"
for name in size bench boards impairment; do
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
sums
for page_of_lines in $(with_lines); do
  awk -F ' [|] ' -v heading="$heading" 'NR == FNR { printed[$1] = $0; next } !/^[|]/ { inside = 0 }
    inside && $1 in printed { $0 = printed[$1] } $0 == heading { inside = 1 } { print }' \
    "$out/sums" "$page_of_lines" >"$out/page" && cp "$out/page" "$page_of_lines"
done
awk -F ' [|] ' '$5 >= 100' "$out/impairment" | grep '^| ' | grep -vxF -f $page &&
  echo "$page lacks these lines, with 100 wrong frames or more: add them." >&2
../../test/impairment/without.sh table
