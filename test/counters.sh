#!/bin/sh
# What each fault leaves in the counters, troubleshooting.md's table: prints the page with the rows as they are now.
#   counters.sh FOLDER   has the programs troubleshooting, troubleshooting24 and troubleshooting32, the page's own sketch
#                        with each class
# A row's first cell names the source, and the class where it is not DecodeSBus.
set -u
cd "$(dirname "$0")" || exit 1

# shellcheck disable=SC2086  # a source and its options are words
while IFS= read -r line; do
  source=$(expr "$line" : '| `\(sim[^`]*\)`')
  class=$(expr "$line" : '| `sim[^`]*`, a `DecodeSBus\([0-9]*\)`')
  [ -z "$source" ] || line="${line%%" |"*} | $(timeout 300 "$1/troubleshooting$class" --simulated-time --seconds 10.1 --source $source </dev/null |
    tr -d '\r') |"
  printf '%s\n' "$line"
done <../extras/docs/troubleshooting.md
