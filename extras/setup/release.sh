#!/bin/sh
# Makes a release's commit ready: version, address, the changelog's heading and the manual's date.
#   release.sh x.y.z https://...
set -eu
cd "$(dirname "$0")/../.."
version=$1
url=$2

reject() {
  echo "$1" >&2
  exit 1
}

whole() { printf '%s\n' "$1" | grep -qxE "$2"; }

number='(0|[1-9][0-9]{0,8})'
whole "$version" "$number\.$number\.$number" || reject "VERSION=$version: three numbers such as 1.2.0 are expected"
whole "$url" 'https://[a-z0-9.-]+\.[a-z]+(:[0-9]+)?(/[A-Za-z0-9._~/-]*)?' ||
  reject "URL=$url: the project's address is expected, such as https://github.com/NAME/DecodeSBus"
last=$(sed -n 's/^version=//p' library.properties)
[ "$(printf '%s\n' "$version" "$last" | sort -t. -k1,1n -k2,2n -k3,3n | tail -n 1)" = "$version" ] ||
  reject "VERSION=$version: $last or higher is expected"
! grep -q "^## $version, " CHANGELOG.md || reject "VERSION=$version: a higher version is expected, CHANGELOG.md has this one as released"
[ -z "$(git status --porcelain)" ] || reject "There are changes that are not committed: see git status"
grep -qx '## Unreleased' CHANGELOG.md || reject 'CHANGELOG.md: the heading "## Unreleased" is expected'

change() {  # FILE SED...: all files are changed, or none
  file=$1
  shift
  sed "$@" "$file" >"$file.new" && cat "$file.new" >"$file" && rm "$file.new"
}
change library.properties -e "s|^version=.*|version=$version|" -e "s|^url=.*|url=$url|"
change library.json -e "s|^  \"version\": .*|  \"version\": \"$version\",|" -e "s|^  \"homepage\": .*|  \"homepage\": \"$url\",|" \
  -e "s|^\(  \"repository\": .*\"url\": \).*|\1\"$url\"},|"
change idf_component.yml -e "s|^version: .*|version: \"$version\"|" -e "s|^url: .*|url: $url|" -e "s|^repository: .*|repository: $url|"
change CHANGELOG.md -e "s|^## Unreleased\$|## $version, $(date +%F)|"
change extras/cli/sbus.1 -e "s|^\(\.TH SBUS 1\) \"[^\"]*\"|\1 \"$(date +%F)\"|"
git --no-pager diff --stat

echo "
Set. What is left to do by hand:"
grep '^maintainer=.*\.example>' library.properties | sed 's/^/  - an address that people can write to: /'
owner=$(printf '%s\n' "$url" | sed -n 's,^https://[^/]*/\([^/]*\)/.*,\1,p')
echo "  - read git diff; make test-all
  - git commit -am 'Release $version' && git tag -a $version -m $version && git push --follow-tags
  - the first time: the Library Manager request, a pull request that adds $url to repositories.txt of
    https://github.com/arduino/library-registry; later it finds the tags by itself
  - PlatformIO: pio pkg publish; ESP-IDF: compote component upload --namespace ${owner:-NAMESPACE} --name decodesbus,
    with your namespace at components.espressif.com
  - make zip, and attach build/DecodeSBus-$version.zip to the release's page
  - begin the next section of CHANGELOG.md with ## Unreleased"
