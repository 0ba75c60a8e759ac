#!/bin/sh
# Writes build/DecodeSBus-VERSION.zip for Sketch > Include Library > Add .ZIP Library: what is committed of the library.
set -eu
cd "$(dirname "$0")/../.."
version=$(sed -n 's/^version=//p' library.properties)
zip=build/DecodeSBus-$version.zip
mkdir -p build
git archive --format=zip --prefix=DecodeSBus/ -o "$zip" HEAD \
  src examples extras/docs library.properties library.json keywords.txt README.md CHANGELOG.md LICENSE
[ -z "$(git status --porcelain)" ] || echo "Changes that are not committed are not in the ZIP." >&2
echo "$zip"
