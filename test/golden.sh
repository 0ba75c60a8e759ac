#!/bin/sh
# Runs every example, built for this PC by extras/host in a variant of build.mk, and says "ok ..." or "FAILED ..." of:
#   golden/EXAMPLE.csv             what it prints, on a line that golden/LINES describes
#   golden/EXAMPLE-LINE.csv
#   golden/README.csv              what README.md's ten lines print
#   verdicts/LINES                 what the sketch Diagnose finds on each of these lines
#   golden/receivers.csv           what the sketch of docs/receivers.md prints of a line of FASSTest 26
#   docs/examples.md               that it shows lines of golden files
#   docs/troubleshooting.md        what each fault leaves in the counters
# A golden file holds the last 20 lines at most.
# "golden.sh VARIANT update" writes the golden files instead.
set -u
cd "$(dirname "$0")" || exit 1
variant=$1
out=${BUILD:-$(cd .. && pwd)/build/test}/$variant
build=$out/sketches
update="${2:-}"

verdict() {  # STATUS WHAT
  if [ "$1" -eq 0 ]; then echo "ok $2"; else echo "FAILED $2"; fi
}

# golden NAME PROGRAM OPTIONS...   Where `input` names a file, the sketch's Serial reads that.
golden() {
  name=$1
  shift
  timeout 300 "$@" --simulated-time <"${input:-/dev/null}" >"$build/$name.all" 2>"$build/$name.err"
  status=$?
  tail -n 20 "$build/$name.all" >"$build/$name.csv"
  if [ "$status" -ne 0 ]; then
    cat "$build/$name.err"
  elif [ "$update" = update ]; then
    cp "$build/$name.csv" "golden/$name.csv"
  else
    cmp "$build/$name.csv" "golden/$name.csv"
    status=$?
  fi
  verdict "$status" "golden/$name.csv"
}

# program SKETCH: builds it
program() {
  "${MAKE:-make}" --no-print-directory -f build.mk VARIANT="$variant" OUT="$out" sketch SKETCH="$1" ||
    { rm -f "$build/$(basename "$1")"; false; }
}

printf '\n%s, examples: golden files\n' "$variant"
mkdir -p "$build" golden
grep -v '^#' golden/LINES >"$build/lines"
for folder in ../examples/*; do
  example=${folder##*/}
  program "examples/$example"
  grep -q "^$example - " "$build/lines" || verdict 1 "$example is not in golden/LINES"
done
while read -r example line options; do
  # shellcheck disable=SC2086  # the options are words
  golden "$(echo "$example-$line" | sed 's/--$//')" "$build/$example" $options
done <"$build/lines"

# The sketches that stand in README.md and the docs are built; README.md's first one is run.
mkdir -p "$build/sketch"
awk -v folder="$build/sketch" '
  FNR == 1 { page = FILENAME; sub(/.*\//, "", page); sub(/\.md$/, "", page); sketches = 0 }
  /^```$/ && inside {
    inside = 0
    if (text ~ /void loop/) {
      name = page (++sketches > 1 ? sketches : "")
      system("mkdir -p " folder "/" name)
      printf "%s", text >(folder "/" name "/" name ".ino")
    }
  }
  inside { text = text $0 "\n" }
  /^```cpp$/ { inside = 1; text = "" }' ../README.md ../extras/docs/[!R]*.md
for class in 24 32; do
  mkdir -p "$build/sketch/troubleshooting$class"
  sed "s/^DecodeSBus /DecodeSBus$class /" "$build/sketch/troubleshooting/troubleshooting.ino" >"$build/sketch/troubleshooting$class/troubleshooting$class.ino"
done
for sketch in "$build"/sketch/*; do
  name=${sketch##*/}
  program "$sketch" && [ -x "$build/$name" ]
  verdict $? "the sketch $name of the docs is built"
done
./counters.sh "$build" 2>"$build/err" >"$build/page"
if [ "$update" = update ]; then cp "$build/page" ../extras/docs/troubleshooting.md; else
  diff ../extras/docs/troubleshooting.md "$build/page" && ! grep -q '| |$' "$build/page"
  verdict $? "docs/troubleshooting.md has what each fault leaves in the counters"
fi
golden README "$build/README" --seconds 10.05
golden receivers "$build/receivers" --source sim:32 --seconds 0.3
rm -r "$build/sketch" # or arduino-lint, run on the whole tree, takes it for a misplaced example
[ "$update" = update ] && exit

# Each block of docs/examples.md has lines of one golden file, in their order, of the example that the text before it names.
rm -rf "$build/shown"
mkdir "$build/shown"
awk -v folder="$build/shown" '
  /^`[A-Z]/ { split($0, name, "`") }
  /^```/ { inside = /^```text$/; next }
  inside { print >(folder "/" name[2]) }' ../extras/docs/examples.md
for shown in "$build"/shown/*; do
  name=${shown##*/}
  for file in "golden/$name.csv" "golden/$name"-*.csv; do
    awk 'NR == FNR { wanted[++count] = $0; next } { sub(/\r$/, "") } $0 == wanted[at + 1] { at++ }
      END { exit !count || at < count }' "$shown" "$file" && break
  done
  verdict $? "the pages show what $name prints"
done
[ "$(find "$build/shown" -type f | wc -l)" -ge 6 ]
verdict $? "docs/examples.md shows six examples or more"

# silence RECORDING WORDS: a recording that brings no line, and the reason given
silence() {
  echo "$1" >"$build/silence.txt"
  timeout 300 "$build/DecodeSBus" --simulated-time --source "$build/silence.txt" >"$build/out" 2>"$build/err" &&
    grep -q "$2" "$build/err" && [ ! -s "$build/out" ]
  verdict $? "a recording of which nothing is printed: $2"
}
silence '120 0F E5 03 1F F8 C0 07 3E F0 81 0F 7C E0 03 06 F8 80 91 3D F0 81 0F 7C 00 00' 'ends before this sketch prints'
silence '120 E5 03 1F' 'has no frame'

! timeout 60 "$build/DecodeSBus" --source . >"$build/out" 2>"$build/err" && grep -q '\.: is a folder; the name of a recording is expected' "$build/err"
verdict $? "a folder is no recording"

python3 -c 'import os, pty, subprocess, sys
sketch = subprocess.Popen([sys.argv[1], "--source", os.ttyname(pty.openpty()[1]), "--seconds", "60"], stderr=subprocess.PIPE, text=True)
isSaid = any(line.startswith("no bytes from /dev/") and "Is it the right port" in line for line in sketch.stderr)
sketch.terminate()
sys.exit(not isSaid)' "$build/DecodeSBus" </dev/null >"$build/out"
verdict $? "a port that brings nothing: where to look"

mkdir -p "$build/verdicts"
verdicts/lines.sh "$build/verdicts"
grep -v '^#' verdicts/LINES >"$build/lines"
while IFS='|' read -r finding _ _ by arguments; do
  case $by in *d*) ;; *) continue ;; esac
  options=$(echo " $arguments" | sed "s,^ sim,--seconds 3.5 --source sim,; s,^ ,--source ,; s,WORK,$build/verdicts,")
  # shellcheck disable=SC2086  # the options are words
  timeout 300 "$build/Diagnose" --simulated-time $options </dev/null 2>"$build/err" | grep -m 1 -v '^begin' >"$build/out"
  grep "^$finding" "$build/out" || { cat "$build/out" "$build/err"; false; }
  verdict $? "Diagnose of $arguments: $finding"
done <"$build/lines"

for file in golden/*.csv; do
  [ -f "$build/${file##*/}" ] || verdict 1 "$file belongs to no line of golden/LINES"
done
