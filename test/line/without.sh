#!/bin/sh
# Takes a rule out of the receiver and prints what that costs: the lines of the torture bench as they are, and without it.
#   without.sh NAME    a name of RULES; another one prints them all
#   without.sh check   says "ok ..." or "FAILED ..." of each rule: is its text still in the source?
# BUILD: an absolute folder for what is built. FRAMES, SEED and ONLY as for `make torture`.
set -u
cd "$(dirname "$0")" || exit 1
tab=$(printf '\t')

# cut_out NAME FILE FROM TO: FROM becomes TO in a copy of the library
cut_out() {
  copy="$BUILD/without/$1/src"
  rm -rf "$copy"
  mkdir -p "${copy%/src}"
  cp -R ../../src "$copy"
  FROM=$3 TO=$4 perl -0pi -e 's/\Q$ENV{FROM}\E/$ENV{TO}/ or exit 1' "$copy/sbus/$2"
}

torture() {  # OUT SRC
  make --no-print-directory -s -C .. -f build.mk CXX=g++ OUT="$1" SRC="$2" "$1/line/Torture" 1>&2 || exit 1
  SUMMARY=1 ONLY=$lines "$1/line/Torture" | grep '^|' | tail -n +3
}

found=false
while IFS="$tab" read -r name file from to lines; do
  case $name in '#'*) continue ;; esac
  if [ "$1" = check ]; then
    if grep -qF "$from" "../../src/sbus/$file"; then echo "ok line/RULES: $name"; else
      echo "FAILED line/RULES: $name is not in $file: $from"
    fi
  elif [ "$1" = "$name" ]; then
    found=true
    lines=${ONLY:-$lines}
    cut_out "$name" "$file" "$from" "$to" || { echo "$name: this is not in $file: $from" >&2; exit 1; }
    echo "as it is | damaged | missed | wrong | late |"
    torture "$BUILD/g++" ../src || exit 1
    echo "without the rule \"$name\""
    torture "$BUILD/without/$name" "$BUILD/without/$name/src" || exit 1
  fi
done <RULES
if [ "$1" != check ] && ! $found; then
  echo "There is no rule \"$1\". The rules are: $(grep -v '^#' RULES | cut -f1 | tr '\n' ' ')" >&2
  exit 2
fi
