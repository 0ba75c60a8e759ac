#!/bin/sh
# Writes build/DecodeSBus-VERSION.zip for Sketch > Include Library > Add .ZIP Library: the committed files that .gitattributes
# leaves in.
set -eu
cd "$(dirname "$0")/../.."
version=$(sed -n 's/^version=//p' library.properties)
zip=build/DecodeSBus-$version.zip
said=$(git rev-parse --verify HEAD 2>&1) || {
  case $said in
    *safe.directory*) echo "$said" >&2 ;;
    *) echo "make zip and make dist pack what is committed: they need git, and a folder made by git clone" >&2 ;;
  esac
  exit 1
}
mkdir -p build
git archive --format=zip --prefix=DecodeSBus/ -o "$zip" HEAD
[ -z "$(git status --porcelain)" ] || echo "Changes that are not committed are not in the ZIP." >&2
echo "$zip"
