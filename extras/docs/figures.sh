#!/bin/sh
# Keeps the tables of measured.md, which stand between <!-- NAME: begin --> and <!-- NAME: end -->.
#   figures.sh         writes them, some minutes; FRAMES=n and TRIES=n of `make impairment` and `make bench` shorten that
#   figures.sh check   says "ok ...", "FAILED ..." or "skipped ..." of each that takes seconds: is it up to date?
# A table is checked only with the compilers that its first line names: others make other code. BUILD is an absolute
# folder for what is built.
set -u
cd "$(dirname "$0")" || exit 1
page=measured.md
export BUILD="${BUILD:-$(cd ../.. && pwd)/build/test}"
out=$BUILD/figures
mkdir -p "$out"

# Of the impairment table the page has the ordinary ones, and each with a hundred wrong frames or more.
ordinary="clean|clean, short gaps|clean, S.BUS2 with telemetry|dropped 1/300|dropped 1/300, short gaps|dropped 1/50|bursts 1/500|\
two bits flipped 1/300|noise in 1/10 of the gaps|joined midway|S.BUS2, dropped 1/300|R7003SB, dropped 1/300|\
24 channels, dropped 1/300|2F frames, dropped 1/300|Fast S.Bus, bursts 1/500|loop of 20 ms|blocked 10 to 60 ms every 500 ms|\
interrupts off for 5 to 30 ms, AVR|S.BUS2, breaks, 8 slots after each frame, dropped 1/300|inexact frames, dropped 1/300"

print() {  # NAME [ONLY=...]
  case $1 in
    impairment)
      "${MAKE:-make}" --no-print-directory -s -C ../.. BUILD="$BUILD" "$@" |
        awk -F' [|] ' -v ordinary="$ordinary" '!/^[|]/ || /^[|] (line|---) / || index("|" ordinary "|", "|" substr($1, 3) "|") || $4 >= 100' ;;
    size) "${MAKE:-make}" --no-print-directory -s -C ../.. BUILD="$BUILD" "$@" ;;
    bench) ../../test/bench/bench.sh known ;;
    worst) ../../test/bench/bench.sh worst ;;
  esac
}

on_page() {  # NAME
  awk -v begin="<!-- $1: begin -->" -v end="<!-- $1: end -->" '$0 == end { exit } inside; $0 == begin { inside = 1 }' $page |
    sed '1d;$d' # the empty lines that keep the marks off the table
}

verdict() {  # STATUS WHAT
  if [ "$1" -eq 0 ]; then echo "ok figures: $2"; else echo "FAILED figures: $2: make figures"; fi
}

check() {  # NAME
  if [ "$1" = bench ] && [ -n "$(../setup/arm-specs.sh)" ]; then
    echo "skipped figures: bench, there is no newlib for ARM here"
    return
  fi
  on_page "$1" >"$out/$1.page"
  print "$1" >"$out/$1" 2>"$out/$1.err" || cat "$out/$1.err"
  if [ -s "$out/$1.page" ] && [ -s "$out/$1" ] && [ "$(sed 1q "$out/$1.page")" != "$(sed 1q "$out/$1")" ]; then
    echo "skipped figures: $1, these compilers are others: $(sed 1q "$out/$1")"
    return
  fi
  [ -s "$out/$1" ] && diff "$out/$1.page" "$out/$1"
  verdict $? "make $1"
}

# Of the impairment table, which takes minutes: seed, frames and one line.
check_impairment() {
  on_page impairment >"$out/impairment.page"
  print impairment ONLY="$1" >"$out/impairment" 2>"$out/impairment.err" || cat "$out/impairment.err"
  [ "$(grep -c "^| $1" "$out/impairment")" -gt 0 ] && ! grep -vxF -f "$out/impairment.page" "$out/impairment"
  verdict $? "make impairment ONLY='$1'"
}

# ms are cycles at 32 MHz.
check_times() {
  wrong=$(grep -oE '[0-9]+( cycles)?(,| \() ?[0-9]+\.[0-9]+ ms' $page | while read -r figure; do
    echo "$figure" | tr -c '0-9.\n' ' ' | awk '{ exit sprintf("%.2f", $1 / 32000) != $2 }' || echo "$figure: 32000 cycles are 1 ms"
  done)
  [ -z "$wrong" ] || { echo "$wrong"; false; }
  verdict $? "$page's times are its cycles"
}

if [ "${1:-}" = check ]; then
  unset FRAMES SEED ONLY FULL SUMMARY BOUNDS RATES WITHOUT
  printf '\nfigures: are the tables of extras/docs/measured.md up to date?\n'
  check size
  check bench
  check_impairment 'Fast S.Bus, bursts'
  check_times
  exit
fi

for name in size bench worst impairment; do
  echo "$name" >&2
  print "$name" >"$out/$name" || exit 1
  awk -v begin="<!-- $name: begin -->" -v end="<!-- $name: end -->" -v table="$out/$name" '
    $0 == end { inside = 0; found = 1 }
    !inside
    $0 == begin {
      inside = 1
      print ""
      while ((getline line <table) > 0) print line
      print ""
    }
    END { exit !found }' $page >"$out/page" || exit 1
  cp "$out/page" $page
done
