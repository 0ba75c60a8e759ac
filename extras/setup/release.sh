#!/bin/sh
# Makes a release's commit ready: version, dates, and the real values of every placeholder. If a placeholder would be left, it
# says which, and changes nothing. README.md has text between <!-- until the first release -->, <!-- from the first release
# and -->: the first part goes, the second becomes visible. Environment variables; those of the last release need not be given again:
#   VERSION=x.y.z
#   URL=https://github.com/NAME/DecodeSBus
#   MAINTAINER='NAME <ADDRESS>'   an address that people can write to
set -eu
cd "$(dirname "$0")/../.."

: "${VERSION:=}" "${URL:=}" "${MAINTAINER:=}"

reject() {
  echo "$1" >&2
  exit 1
}

whole() { printf '%s\n' "$1" | grep -qxE "$2"; }
property() { sed -n "s/^$1=//p" library.properties; }

number='(0|[1-9][0-9]{0,8})'
whole "$VERSION" "$number\.$number\.$number" || reject "VERSION=$VERSION: three numbers such as 1.2.0 are expected"
[ -z "$URL" ] || whole "$URL" 'https://github\.com/[A-Za-z0-9-]+/[A-Za-z0-9._-]+' ||
  reject "URL=$URL: the project's address is expected, such as https://github.com/NAME/DecodeSBus"
[ -z "$MAINTAINER" ] || whole "$MAINTAINER" '[^<>|&\\"]*[^<>|&\\" ] <[^<>|&\\" @]+@[A-Za-z0-9.-]+\.[A-Za-z]+>' ||
  reject "MAINTAINER=$MAINTAINER: a name and an address are expected, such as 'Ada Byron <ada@byron.org>'"
last=$(property version)
[ "$(printf '%s\n' "$VERSION" "$last" | sort -t. -k1,1n -k2,2n -k3,3n | tail -n 1)" = "$VERSION" ] ||
  reject "VERSION=$VERSION: $last or higher is expected"
! grep -q "^## $VERSION, " CHANGELOG.md || reject "VERSION=$VERSION: a higher version is expected, CHANGELOG.md has this one as released"
[ -z "$(git status --porcelain)" ] || reject "There are changes that are not committed: see git status"
grep -qx '## Unreleased' CHANGELOG.md || reject 'CHANGELOG.md: the heading "## Unreleased" is expected'

# Prints FILE:LINE of each line like REGEX, and what belongs there. Scripts and tests name placeholders without having them.
left() {  # REGEX WHAT [PATHSPEC]
  git grep -nE -e "$1" -- ':!extras/setup' ':!test' ${3:+"$3"} | sed -E "s|^([^:]*:[0-9]+):.*|\1: $2|"
}
left=$(
  [ -n "$MAINTAINER" ] || left '@[a-z.-]+\.example' "MAINTAINER='NAME <ADDRESS>', an address that people can write to"
  [ -n "$URL" ] || left '(^|[^@])decodesbus\.example' 'URL=https://github.com/NAME/DecodeSBus'
  left '(after|before) the first release' 'the text that holds from the release on'
  left '(until|from) the first release' 'the text that holds from the release on: only README.md may have these marks' ':!README.md'
)
[ -z "$left" ] || reject "A release has no placeholders. Give or write what is named here:
$left"

change() {  # FILE SED...: all files are changed, or none
  file=$1
  shift
  sed "$@" "$file" >"$file.new" && cat "$file.new" >"$file" && rm "$file.new"
}
change library.properties -e "s|^version=.*|version=$VERSION|" \
  ${MAINTAINER:+-e "s|^maintainer=.*|maintainer=$MAINTAINER|" -e "s|^author=.*|author=$MAINTAINER|"}
change library.json -e "s|^  \"version\": .*|  \"version\": \"$VERSION\",|" ${MAINTAINER:+-e \
  "s|^  \"authors\": .*|  \"authors\": [{\"name\": \"${MAINTAINER% <*}\", \"email\": \"$(echo "$MAINTAINER" | sed 's/.* <\(.*\)>/\1/')\", \"maintainer\": true}],|"}
change idf_component.yml -e "s|^version: .*|version: \"$VERSION\"|"
change CHANGELOG.md -e "s|^## Unreleased\$|## $VERSION, $(date +%F)|"
change extras/cli/sbus.1.in -e "s|^\(\.TH SBUS 1\) \"[^\"]*\"|\1 \"$(date +%F)\"|"
change README.md -e '/<!-- until the first release -->/,/<!-- from the first release$/d' \
  -e '/<!-- from the first release$/d' -e '/^ *-->$/d'
# page URL: the scope's address on GitHub Pages
page() { echo "$1" | sed -E 's|^https://github.com/([^/]+)/|https://\L\1\E.github.io/|; t; s|^https://|https://page.|'; }
old=$(property url)
for file in ${URL:+$(git grep -lF -e "${old#https://}" -e "$(page "$old")" -- ':!extras/setup' ':!test')}; do
  change "$file" -e "s|/release/${old#https://}|/release/${URL#https://github.com/}|" \
    -e "s|/release/${old#https://github.com/}|/release/${URL#https://github.com/}|" -e "s|$(page "$old")|$(page "$URL")|g" \
    -e "s|$old|$URL|g"
done
git --no-pager diff --stat

echo "
Set. What is left to do by hand:
  - read git diff; make test-all
  - git commit -am 'Release $VERSION' && sh extras/setup/tags.sh
    The tag v$VERSION makes the release on GitHub: .github/workflows/release.yml. If its job windows fails, sbus for Windows is
    missing there
  - the first time, before the tag, the labels of the issue forms:
$(sed -n 's/^labels: \[\(.*\)\]$/      gh label create \1/p' .github/ISSUE_TEMPLATE/*.yml)
  - the first time, before the tag, in GitHub's settings: Pages > Source: GitHub Actions; Environments > github-pages: allow
    tags v*; General > Discussions; Secrets > Actions: PLATFORMIO_AUTH_TOKEN and IDF_COMPONENT_API_TOKEN. Without such a token:
    pio pkg publish; compote component upload --namespace $(property url | cut -d/ -f4) --name decodesbus
  - the first time, after it: a pull request that adds $(property url) to repositories.txt of
    https://github.com/arduino/library-registry; later the Library Manager finds the tags by itself
  - begin the next section of CHANGELOG.md with ## Unreleased"
