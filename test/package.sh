#!/bin/sh
# What users get, made in a scratch repository: the ZIP of `make zip`, and the changes of `make release`. Says "ok ..." or
# "FAILED ...".
# BUILD: an absolute folder for what is built.
set -u
cd "$(dirname "$0")/.." || exit 1
out=${BUILD:-$PWD/build/test}/package
host=$PWD/extras/host
scratch="$out/a clone"  # a folder with a space

verdict() {  # STATUS WHAT
  if [ "$1" -eq 0 ]; then echo "ok package: $2"; else echo "FAILED package: $2"; fi
}

printf '\npackage: the ZIP, and a release\n'
command -v git >/dev/null && command -v unzip >/dev/null || { echo "skipped package: needs git and unzip"; exit; }
rm -rf "$out"
mkdir -p "$scratch"
tar cf - --exclude=./build --exclude=./.git . | tar xf - -C "$scratch"
printf '# Changelog\n\n## Unreleased\n\n- New.\n' >"$scratch/CHANGELOG.md" # as before any release: ours may have been released
sed -i 's/^\(\.TH SBUS 1\) "[^"]*"/\1 "2001-01-01"/' "$scratch/extras/cli/sbus.1"
export GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_SYSTEM=/dev/null
unset GIT_DIR GIT_WORK_TREE GIT_INDEX_FILE MAKEFLAGS MAKELEVEL
git() { command git -C "$scratch" -c user.name=Test -c user.email=test@localhost "$@"; }
git init -q && git add -A && git commit -q -m Test || { verdict 1 "a scratch repository can be made"; exit; }
version=$(sed -n 's/^version=//p' library.properties)

made=$(make -s -C "$scratch" zip)
[ "$made" = "build/DecodeSBus-$version.zip" ] && unzip -q "$scratch/$made" -d "$out/libraries"
verdict $? "make zip writes build/DecodeSBus-$version.zip, and it unzips"
library=$out/libraries/DecodeSBus
[ "$(ls "$out/libraries")" = DecodeSBus ] &&
  [ "$(ls "$library" | LC_ALL=C sort | tr '\n' ' ')" = "CHANGELOG.md CMakeLists.txt CONTRIBUTING.md LICENSE README.md examples extras \
idf_component.yml keywords.txt library.json library.properties src zephyr " ] &&
  [ "$(ls "$library/extras" | tr '\n' ' ')" = "cli docs host scope " ] && [ "$(ls "$library/extras/cli")" = README.md ]
verdict $? "the ZIP is one folder, with what a library has"
# Prints PAGE TARGET of each relative link, or PAGE#HEADING of each heading, as GitHub names it.
links() {  # WHAT
  (cd "$library" && find . -name '*.md' -exec awk -v what="$1" '
    /^```/ { fenced = !fenced }
    what == "headings" && !fenced && sub(/^#+ /, "") {
      gsub(/[^A-Za-z0-9_ -]/, "")
      gsub(/ /, "-")
      print FILENAME "#" tolower($0)
    }
    what == "links" && !fenced {
      while (match($0, /\]\([^) ]+\)/)) {
        target = substr($0, RSTART + 2, RLENGTH - 3)
        $0 = substr($0, RSTART + RLENGTH)
        if (target !~ /^[a-z]+:/) print FILENAME, target
      }
    }' {} +)
}
links headings >"$out/headings"
links links >"$out/links"
dead=$(while read -r page target; do
  file=$page
  case $target in '#'*) ;; *) file=./$(cd "$library" && realpath -m --relative-to=. "${page%/*}/${target%%#*}") ;; esac
  [ -e "$library/$file" ] || echo "$page: $target"
  case $target in *'#'*) grep -qxF "$file#${target#*#}" "$out/headings" || echo "$page: $target" ;; esac
done <"$out/links")
[ "$(wc -l <"$out/links")" -gt 100 ] && [ -z "$dead" ] || { echo "$dead"; false; }
verdict $? "every relative link of the ZIP's pages leads to a file and a heading of the ZIP"
# `pio pkg pack` adds the manifests, README and LICENSE to what library.json names.
include=$(tr '\n' ' ' <library.json | sed -n 's/.*"include": \[\([^]]*\)\].*/\1/p' | tr -d '",')
# shellcheck disable=SC2086  # names, to be split
[ "$(git ls-files $include library.json library.properties README.md LICENSE)" = "$(cd "$library" && find . -type f | sed 's,^\./,,' | LC_ALL=C sort)" ]
verdict $? "library.json names the same files for PlatformIO"
failed=0
for source in "$library"/src/*.cpp "$library"/src/sbus/*.cpp "$library"/examples/DecodeSBus/DecodeSBus.ino; do
  g++ -std=gnu++11 -fsyntax-only -DARDUINO=10819 -I"$library/src" -I"$host/arduino" -I"$host/standin" \
    -x c++ -include Arduino.h "$source" || failed=1
done
verdict $failed "the library and the first example compile from the ZIP"

# rejected WHAT VERSION URL: make release rejects this with one line, and changes nothing
rejected() {
  what=$1
  git status --porcelain >"$out/before"
  make -s -C "$scratch" release VERSION="$2" URL="$3" >"$out/rejected" 2>&1
  status=$?
  git status --porcelain >"$out/after"
  [ $status -ne 0 ] && [ "$(grep -vc '^make' "$out/rejected")" -eq 1 ] && cmp "$out/before" "$out/after"
  verdict $? "a release is rejected: $what"
}

url=https://github.com/somebody/DecodeSBus
for wrong in '' 1 1.2 1.2.3.4 v1.2.3 1.2.x 01.2.3 1.2.3-rc1 0.0.9; do
  rejected "VERSION=$wrong" "$wrong" $url
done
for wrong in '' github.com/somebody/DecodeSBus http://github.com/somebody 'https://a.b/&' https://decodesbus.example/'|'; do
  rejected "URL=$wrong" 9.9.9 "$wrong"
done
touch "$scratch/src/new.h"
rejected "a file that git does not know" 9.9.9 $url
rm "$scratch/src/new.h"
echo >>"$scratch/README.md"
rejected "a file that has changed" 9.9.9 $url
git checkout -q README.md

release() {  # VERSION
  make -s -C "$scratch" release VERSION="$1" URL=$url >"$out/release" 2>&1 &&
    grep -qx "version=$1" "$scratch/library.properties" && grep -qx "url=$url" "$scratch/library.properties" &&
    [ "$(grep -c "\"version\": \"$1\",\$" "$scratch/library.json")" -eq 1 ] &&
    [ "$(grep -c "\"homepage\": \"$url\",\$" "$scratch/library.json")" -eq 1 ] &&
    grep -qxF "  \"repository\": {\"type\": \"git\", \"url\": \"$url\"}," "$scratch/library.json" &&
    [ "$(grep -cxF -e "version: \"$1\"" -e "url: $url" -e "repository: $url" "$scratch/idf_component.yml")" -eq 3 ] &&
    grep -q "^## $1, 20[0-9-]*\$" "$scratch/CHANGELOG.md" && ! grep -q '^## Unreleased' "$scratch/CHANGELOG.md" &&
    grep -qE '^\.TH SBUS 1 "20([1-9][0-9]|0[2-9])-[0-9]{2}-[0-9]{2}" ' "$scratch/extras/cli/sbus.1" &&
    [ "$(git status --porcelain | grep -v ' extras/cli/sbus.1$' | tr -d '\n')" = " M CHANGELOG.md M idf_component.yml M library.json M library.properties" ] &&
    grep -q "git tag -a $1 " "$out/release" && grep -q 'library-registry' "$out/release" && grep -q 'pio pkg publish' "$out/release" &&
    grep -q 'compote component upload --namespace somebody --name decodesbus,' "$out/release"
}
release "$version"
verdict $? "the version of library.properties can be released, if it is not released yet"
git checkout -q .
release 9.9.9
verdict $? "make release sets version, address and the changelog's heading, and says what is left"
git commit -q -a -m Release
rejected "nothing is unreleased" 9.10.0 $url
printf '\n## Unreleased\n\n- New.\n' >>"$scratch/CHANGELOG.md"
git commit -q -a -m Next
rejected "it has been released" 9.9.9 $url
release 9.10.0
verdict $? "9.10.0 is newer than 9.9.9"
rm -rf "$out"  # otherwise a linter takes its sketches for those of this library
