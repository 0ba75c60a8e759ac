#!/bin/sh
# Runs the programs and commands of extras/docs/recipes.md, and says "ok ..." or "FAILED ...".
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

mkdir "$work/bin"
printf '#!/bin/sh\nexec "%s" "$@"\n' "$SBUS" >"$work/bin/sbus"
chmod +x "$work/bin/sbus"
PATH=$work/bin:$PATH python3 tool/recipes.py ../extras/docs/recipes.md "$work"
[ $? -eq 0 ] || verdict 1 "tool/recipes.py runs to its end"
