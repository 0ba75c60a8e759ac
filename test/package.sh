#!/bin/sh
# What users get, made in a scratch repository: the ZIP of `make zip`, and what `make release` changes or rejects. Says "ok ..." or
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
tar cf - --exclude=./build --exclude=./.git . | tar xof - -C "$scratch"
# As before any release: ours may have been released.
printf '# Changelog\n\n## Unreleased\n\n- New, on\n  one line.\n' >"$scratch/CHANGELOG.md"
address=https://decodesbus.example
(cd "$scratch" &&
  sed -i "s|$(sed -n 's/^url=//p' library.properties)|$address|" library.properties library.json idf_component.yml README.md &&
  sed -i 's/^maintainer=.*/maintainer=Nemo <maintainers@decodesbus.example>/' library.properties)
cat >>"$scratch/README.md" <<END
<!-- until the first release -->
old
<!-- from the first release
new
[release]($address/releases), [page](https://page.decodesbus.example/)
https://img/release/decodesbus.example
-->
end
<!-- from the first release
alone
-->
last
END
sed -i 's/^\(\.TH SBUS 1\) "[^"]*"/\1 "2001-01-01"/' "$scratch/extras/cli/sbus.1.in"
export GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_SYSTEM=/dev/null
unset GIT_DIR GIT_WORK_TREE GIT_INDEX_FILE MAKEFLAGS MAKELEVEL
git() { command git -C "$scratch" -c user.name=Test -c user.email=test@localhost "$@"; }
git init -q && git add -A && git commit -q -m Test || { verdict 1 "a scratch repository can be made"; exit; }
version=$(sed -n 's/^version=//p' library.properties)

made=$(make -s -C "$scratch" zip)
[ "$made" = "build/DecodeSBus-$version.zip" ] && unzip -q "$scratch/$made" -d "$out/libraries"
verdict $? "make zip writes build/DecodeSBus-$version.zip, and it unzips"
mkdir "$out/source"
cp -r Makefile library.properties "$out/source"
mkdir "$out/source/extras"
cp -r extras/setup "$out/source/extras"
for goal in zip dist; do
  ! GIT_CEILING_DIRECTORIES="$out" make -s -C "$out/source" $goal >"$out/said" 2>&1 &&
    [ "$(grep -v '^make: ' "$out/said")" = "make zip and make dist pack what is committed: they need git, and a folder made by git clone" ] || { cat "$out/said"; false; }
  verdict $? "without git's folder, make $goal says what it needs"
done
git clone -q -c core.autocrlf=true "$scratch" "$out/windows"
converted=$(command git -C "$out/windows" ls-files --eol | sed 's,^i/\([^ ]*\) *w/\([^ ]*\).*\t,\1 \2 ,' | awk '$1 != $2')
[ -s "$out/windows/Makefile" ] && [ -z "$converted" ] || { echo "$converted" | head; false; }
verdict $? "a clone with core.autocrlf, as on Windows, has the bytes of the repository"
library=$out/libraries/DecodeSBus
[ "$(ls "$out/libraries")" = DecodeSBus ] &&
  [ "$(ls "$library" | LC_ALL=C sort | tr '\n' ' ')" = "CHANGELOG.md CMakeLists.txt CONTRIBUTING.md LICENSE README.md examples extras \
idf_component.yml keywords.txt library.json library.properties src zephyr " ] &&
  [ "$(ls "$library/extras" | tr '\n' ' ')" = "cli docs host scope " ] && [ "$(ls "$library/extras/cli")" = README.md ]
verdict $? "the ZIP is one folder, with what a library has"
[ "$(wc -l <README.md)" -le 90 ] && [ "$(wc -l <CONTRIBUTING.md)" -le 60 ]
verdict $? "README.md has 90 lines at most, CONTRIBUTING.md 60"
counters=$(sed -nE 's/^ *uint32_t ([a-zA-Z]+);.*/\1/p' src/sbus/Counters.h)
missing=$(for counter in ${counters:-none}; do grep -qx " *$counter" .github/ISSUE_TEMPLATE/wrong-bytes.yml || echo "$counter"; done)
[ -z "$missing" ] || { echo "$missing"; false; }
verdict $? "a report of wrong values asks for every counter"
dead=$(./test/pages.py dead "$library") && [ -z "$dead" ] || { echo "$dead"; false; }
verdict $? "every relative link of the ZIP's pages leads to a file and a heading of the ZIP"
# `pio pkg pack` adds the manifests, README and LICENSE to what library.json names.
include=$(tr '\n' ' ' <library.json | sed -n 's/.*"include": \[\([^]]*\)\].*/\1/p' | tr -d '",')
# shellcheck disable=SC2086  # names, to be split
[ "$(git ls-files $include library.json library.properties README.md LICENSE)" = "$(cd "$library" && find . -type f | sed 's,^\./,,' | LC_ALL=C sort)" ]
verdict $? "library.json names the same files for PlatformIO"
failed=0
for source in "$library"/src/*.cpp "$library"/src/sbus*/*.cpp "$library"/examples/DecodeSBus/DecodeSBus.ino; do
  g++ -std=gnu++11 -fsyntax-only -DARDUINO=10819 -I"$library/src" -I"$host/arduino" -I"$host/standin" \
    -x c++ -include Arduino.h "$source" || failed=1
done
verdict $failed "the library and the first example compile from the ZIP"

url=https://github.com/somebody/DecodeSBus
who="Ada O'Byron <ada@byron.org>"

# asked VERSION URL MAINTAINER: make release
asked() { make -s -C "$scratch" release VERSION="$1" URL="$2" MAINTAINER="$3" >"$out/release" 2>&1; }
# rejected WHAT VERSION URL MAINTAINER: make release rejects this with one line, and changes nothing
rejected() {
  git status --porcelain >"$out/before"
  ! asked "$2" "${3:-}" "${4:-}" && [ "$(grep -vc '^make' "$out/release")" -eq 1 ] &&
    [ "$(git status --porcelain)" = "$(cat "$out/before")" ]
  verdict $? "a release is rejected: $1"
}

for wrong in '' 1.2 v1.2.3 01.2.3 0.0.9; do
  rejected "VERSION=$wrong" "$wrong" $url "$who"
done
for wrong in github.com/somebody/DecodeSBus https://decodesbus.example $url/; do
  rejected "URL=$wrong" 9.9.9 "$wrong" "$who"
done
for wrong in Ada 'Ada <ada>' 'Ada|B <ada@byron.org>'; do
  rejected "MAINTAINER=$wrong" 9.9.9 $url "$wrong"
done
touch "$scratch/src/new.h"
rejected "a file that git does not know" 9.9.9 $url "$who"
rm "$scratch/src/new.h"
echo >>"$scratch/README.md"
rejected "a file that has changed" 9.9.9 $url "$who"
git checkout -q README.md

# names REGEX...: the last release was rejected, and each of these is a line of what it said
names() {
  git status --porcelain >"$out/status"
  [ ! -s "$out/status" ] || return
  for line in "$@"; do grep -qE "^$line" "$out/release" || { echo "no line is like $line:"; cat "$out/release"; return 1; }; done
}
! asked 9.9.9 '' '' && names 'library.properties:4: MAINTAINER=' 'library.properties:8: URL=' 'library.json:4: URL=' \
  'library.json:9: URL=' 'idf_component.yml:5: URL=' 'README.md:[0-9]+: URL='
verdict $? "a release without real addresses is rejected, and each place of them is named"
! asked 9.9.9 $url '' && names 'library.properties:4: MAINTAINER=' && ! grep -q URL= "$out/release"
verdict $? "... and the maintainer's alone, if only this one is missing"
printf 'It comes after the first release.\n\n<!-- from the first release\n-->\n' >"$scratch/extras/docs/new.md"
git add -A && git commit -q -m Page
! asked 9.9.9 $url "$who" && names 'extras/docs/new.md:1: the text that holds' 'extras/docs/new.md:3: the text that holds'
verdict $? "a sentence about the first release is named"
git reset -q --hard HEAD^

# released VERSION FILES [URL MAINTAINER]: make release makes these changes, and no others
released() {
  files=$2
  asked "$1" "${3:-}" "${4:-}" &&
    grep -qx "version=$1" "$scratch/library.properties" && grep -qx "url=$url" "$scratch/library.properties" &&
    grep -qx "maintainer=$who" "$scratch/library.properties" && grep -qx "author=$who" "$scratch/library.properties" &&
    grep -qxF '  "authors": [{"name": "Ada O'"'"'Byron", "email": "ada@byron.org", "maintainer": true}],' "$scratch/library.json" &&
    [ "$(grep -c "\"version\": \"$1\",\$" "$scratch/library.json")" -eq 1 ] &&
    [ "$(grep -c "\"homepage\": \"$url\",\$" "$scratch/library.json")" -eq 1 ] &&
    grep -qxF "  \"repository\": {\"type\": \"git\", \"url\": \"$url\"}," "$scratch/library.json" &&
    [ "$(grep -cxF -e "version: \"$1\"" -e "url: $url" -e "repository: $url" "$scratch/idf_component.yml")" -eq 3 ] &&
    grep -q "^## $1, 20[0-9-]*\$" "$scratch/CHANGELOG.md" && ! grep -q '^## Unreleased' "$scratch/CHANGELOG.md" &&
    grep -qE '^\.TH SBUS 1 "20([1-9][0-9]|0[2-9])-[0-9]{2}-[0-9]{2}" ' "$scratch/extras/cli/sbus.1.in" &&
    [ "$(git status --porcelain | grep -v ' extras/cli/sbus.1.in$' | sed 's/^ M //' | tr '\n' ' ')" = "$files" ] &&
    [ "$(grep -c 'gh label create [a-z]' "$out/release")" -eq "$(grep -l '^labels:' "$scratch"/.github/ISSUE_TEMPLATE/*.yml | wc -l)" ] &&
    grep -q 'extras/setup/tags.sh' "$out/release" && grep -q "adds $url to" "$out/release" && grep -q 'pio pkg publish' "$out/release" &&
    grep -q 'compote component upload --namespace somebody --name decodesbus$' "$out/release" || { cat "$out/release"; git diff; false; }
}
first="CHANGELOG.md README.md idf_component.yml library.json library.properties "
later="CHANGELOG.md idf_component.yml library.json library.properties "
released "$version" "$first" $url "$who"
verdict $? "the version of library.properties can be released, if it is not released yet"
git checkout -q .
released 9.9.9 "$first" $url "$who"
verdict $? "make release sets version, addresses and dates, and says what is left"
[ "$(tail -n 6 "$scratch/README.md" | tr '\n' '|')" = "new|[release]($url/releases), [page](https://somebody.github.io/DecodeSBus/)|https://img/release/somebody/DecodeSBus|end|alone|last|" ] &&
  grep -q '\[MIT licence\]' "$scratch/README.md" && ! grep -qE '^ *(<!--|-->)|first release|\.example' "$scratch/README.md"
verdict $? "README.md then has what holds from the first release on, and no marks"

sh "$scratch/extras/setup/links.sh" >"$out/linked"
left=$(grep -oE '\]\([^)]*\)|\bsrc(set)?="[^"]*"' "$out/linked" | grep -vE '(\(|")https://') && [ -z "$left" ] && echo "$left"
grep -qF "]($url/blob/v9.9.9/extras/docs/boards.md#" "$out/linked" && grep -qF "src=\"$url/raw/v9.9.9/extras/docs/" "$out/linked" && [ -z "$left" ]
verdict $? "for a package without the pages, each of README.md's links leads to the repository"

[ "$(sh "$scratch/extras/setup/notes.sh")" = "- New, on one line." ]
verdict $? "its notes are the newest section of CHANGELOG.md"

git commit -q -a -m Release
(cd "$scratch" && git config user.name Test && git config user.email test@localhost && sh extras/setup/tags.sh) >"$out/tags" 2>&1
[ "$(cat "$out/tags")" = "git push --atomic origin HEAD v9.9.9 9.9.9" ] && git diff --quiet v9.9.9 HEAD && git diff --quiet HEAD &&
  [ "$(git ls-tree -r --name-only 9.9.9)" = "$(git archive HEAD | tar t | grep -v '/$' | LC_ALL=C sort)" ] &&
  git diff --quiet v9.9.9 9.9.9 --diff-filter=d && [ "$(git rev-parse 9.9.9^)" = "$(git rev-parse HEAD)" ] || { cat "$out/tags"; false; }
verdict $? "it is tagged twice: the whole repository, and for the Library Manager the library alone"
rejected "nothing is unreleased" 9.10.0
printf '\n## Unreleased\n\n- New.\n' >>"$scratch/CHANGELOG.md"
git commit -q -a -m Next
rejected "it has been released" 9.9.9
released 9.10.0 "$later"
verdict $? "9.10.0 is newer than 9.9.9, and keeps the addresses"
rm -rf "$out"  # otherwise a linter takes its sketches for those of this library
