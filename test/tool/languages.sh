#!/bin/sh
# Runs the programs in other languages of extras/cli/README.md on a recording and on a live port, and says "ok ..." or
# "FAILED ...".
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

mkdir "$work/bin"
printf '#!/bin/sh\nexec "%s" "$@"\n' "$SBUS" >"$work/bin/sbus"  # a library has no links, not even in build/
chmod +x "$work/bin/sbus"
recordings=$PWD/recordings
PATH=$work/bin:$PATH

fence() { awk -v fence="\`\`\`$1" '$0 == "```" { inside = 0 } inside; $0 == fence { inside = 1 }' ../extras/cli/README.md; }
fence python >"$work/sticks.py"
fence js >"$work/sticks.mjs"

"$SBUS" csv recordings/paper.txt --every-frame --columns time,ch1-ch4,failsafe,lostframe | tr -d '\r' |
  awk -F, '{ print $2, $3, $4, $5, $6 || $7 ? "lost" : "live" }' >"$work/wanted"
player send sim
for language in 'python3 sticks.py' 'node sticks.mjs'; do
  program=${language%% *}
  if ! command -v "$program" >/dev/null; then
    echo "skipped sbus: README's program for $program: it is not here"
    continue
  fi
  # shellcheck disable=SC2086  # they are words
  (cd "$work" && $language "$recordings/paper.txt" 2>"$work/err") >"$work/all"
  tr -d '[],' <"$work/all" | cut -d ' ' -f 2- | sed 's/^ *//' | tr -s ' ' | diff - "$work/wanted"
  verdict $? "README's program for $program prints the frames of a recording"
  (cd "$work" && timeout 60 $language "$terminal" --seconds 1 2>"$work/err") >"$work/live"
  grep -q live "$work/live"
  verdict $? "README's program for $program prints the frames of a port"
done
kill $player
wait $player 2>/dev/null
