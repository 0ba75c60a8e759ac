#!/bin/sh
# Builds each sketch of SKETCHES as a user's, in a variant of build.mk, runs it on the simulated board, and says "ok ..." or
# "FAILED ..." of each line that it must print or have in its report. "run.sh VARIANT NAME" does so with one sketch.
set -u
cd "$(dirname "$0")/.." || exit 1
out=${BUILD:-$(cd .. && pwd)/build/test}/$1
folder=$out/forums
result() {  # PRINTS-OR-REPORTS LINE
  case $1 in
    prints) grep -qxF -e "$2" "$sketch.out" ;;
    reports) grep -qF -e "$2" "$sketch.report" ;;
  esac
}
export WERROR=1  # as the objects that the examples share; the sketches have a user's warnings

printf '\n%s, sketches in the style of forums\n' "$1"
rm -rf "$folder" && mkdir -p "$folder" || exit
# Each sketch's files, and beside its folder NAME.options, NAME.input and NAME.lines.
awk -v folder="$folder" '
  /^=== [A-Za-z]+: / {
    name = $2
    sub(/:$/, "", name)
    system("mkdir -p " folder "/" name)
    beside = folder "/" name
    file = beside "/" name ".ino"
    printf "" >(beside ".input")
    print name
    next
  }
  /^=== file / { file = beside "/" $3; next }
  /^=== values$/ { print "void loop() {}\nvoid setup() {\n  Serial.begin(115200);" >file; values = 1; next }
  values && / => / {  # each with its number, so that no line stands for another
    at = index($0, " => ")
    printf "  Serial.print(\"%d: \");\n  Serial.println(%s);\n", values, substr($0, 1, at - 1) >file
    printf "prints %d: %s\n", values++, substr($0, at + 4) >(beside ".lines")
    next
  }
  values && /^$/ { print "}" >file; values = 0; next }
  /^=== run / { sub(/^=== run /, ""); print >(beside ".options"); next }
  /^=== input / { sub(/^=== input /, ""); print >(beside ".input"); next }
  /^=== (prints|reports) / { sub(/^=== /, ""); print >(beside ".lines"); next }
  name != "" { print >file }' sketches/SKETCHES >"$folder/names"

grep -x "${2:-.*}" "$folder/names" | while read -r name; do
  sketch=$folder/$name
  if ! timeout 900 "${MAKE:-make}" --no-print-directory -f build.mk VARIANT="$1" OUT="$out" sketch SKETCH="$sketch" \
    sketch_warnings=-Wall </dev/null; then
    echo "FAILED the sketch $name does not build"
    continue
  fi
  # shellcheck disable=SC2046  # the options are words
  timeout 60 "$out/sketches/$name" --simulated-time $(cat "$sketch.options") <"$sketch.input" >"$sketch.raw" 2>"$sketch.report" ||
    echo "FAILED $name ended with status $?" "$(tail -n 5 "$sketch.report")"
  tr '\r' '\n' <"$sketch.raw" >"$sketch.out"
  while read -r stream line; do
    if result "$stream" "$line"; then echo "ok $name $stream $line"; else
      tail -n 5 "$sketch.out" "$sketch.report"
      echo "FAILED $name $stream $line"
    fi
  done <"$sketch.lines"
done
rm -rf "${folder:?}"/*/ # or arduino-lint, run on the whole tree, takes them for misplaced examples
