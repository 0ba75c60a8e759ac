#!/bin/sh
# Is every function that a sketch may call (keywords.txt, KEYWORD2) called by a sketch that the tests build: an example, or
# one of README.md and the pages? Says "ok ..." or "FAILED ..." of each.
set -u
cd "$(dirname "$0")/.." || exit 1
# As golden.sh does it: what stands between ```cpp and ``` and has a loop().
sketches=$(cat examples/*/*.ino examples/*/*.h; awk '
  /^```$/ && inside { inside = 0; if (text ~ /void loop/) printf "%s", text }
  inside { text = text $0 "\n" }
  /^```cpp$/ { inside = 1; text = "" }' README.md extras/docs/[!R]*.md)
code=$(echo "$sketches" | sed 's,//.*,,')

printf '\nuses: every public function is used by a sketch\n'
# Methods of the two classes that no keyword names are counted, too.
methods=$(sed -nE '/^ protected:|^ private:/,/^};/d; s,^  [a-z][A-Za-z0-9_: ]* ([a-zA-Z]+)\(.*,\1,p' src/DecodeSBus.h src/EncodeSBus.h)
for name in $(printf '%s\n' "$(sed -n 's/\tKEYWORD2$//p' keywords.txt)" "$methods" | grep -vE "^(De|En)code" | sort -u); do
  if ! grep -qE "\b$name\(" src/*.h src/sbus/*.h; then
    echo "FAILED uses: $name() of keywords.txt is not in the library"
  elif echo "$code" | grep -qE "\b$name\("; then
    echo "ok uses: $name()"
  else
    echo "FAILED uses: no sketch uses $name()"
  fi
done
