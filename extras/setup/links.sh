#!/bin/sh
# Prints README.md with its relative links leading to the repository, at this version's tag: for packages without the pages.
set -eu
cd "$(dirname "$0")/../.."
url=$(sed -n 's/^url=//p' library.properties)
tag=v$(sed -n 's/^version=//p' library.properties)
sed -E -e "s#\]\((extras|src|examples|[A-Z]+)([^):]*)\)#](/\1\2)#g; s#\]\(/#]($url/blob/$tag/#g" \
  -e "s#\b(src|srcset)=\"(extras/)#\1=\"$url/raw/$tag/\2#g" README.md
