#!/bin/sh
# Prints the newest section of CHANGELOG.md as a release's notes: GitHub keeps every line break there, so each paragraph and each
# item becomes one line.
set -eu
cd "$(dirname "$0")/../.."
awk '
  function end() { if (text != "") print text; text = "" }
  /^## / { if (section++) exit; next }
  !section { next }
  /^(#|- |$)/ { end() }
  /^$/ || /^#/ { print; next }
  { sub(/^ +/, ""); text = text == "" ? $0 : text " " $0 }
  END { end() }' CHANGELOG.md | sed '/./,$!d'
