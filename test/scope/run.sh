#!/bin/sh
# The browser page: built, then tested, in Chromium where there is one. "ok ..." or "FAILED ..." of each.
set -u
cd "$(dirname "$0")" || exit 1
build="${BUILD:-$PWD/../../build/test}/scope"
mkdir -p "$build"
if ! "${MAKE:-make}" --no-print-directory -s -C ../../extras/scope BUILD="$build"; then
  echo "FAILED extras/scope does not build"
  exit
fi
if grep -q 'uPlot, Copyright (c) .*Leon Sorokin' "$build/index.html" && grep -q 'The above copyright notice and this permission' "$build/index.html"; then
  echo "ok scope: the page has its licence, and the names of those whose code is in it"
else
  echo "FAILED scope: the page lacks its licence, or that of uPlot"
fi
if (tests=$PWD && cd "$build/npm" && npm run --silent check -- "$tests" "$tests/../../extras/scope/picture.mjs"); then
  echo "ok scope: the linter accepts the page, its picture and its tests"
else
  echo "FAILED scope: the linter accepts the page, its picture and its tests"
fi
"${MAKE:-make}" --no-print-directory -s -C ../../extras/cli BUILD="$build/cli" || echo "FAILED sbus does not build"
SCOPE_BUILD="$build" timeout 60 node units.mjs || echo "FAILED scope/units.mjs ended with status $?"
SCOPE_BUILD="$build" timeout 300 node sources.mjs || echo "FAILED scope/sources.mjs ended with status $?"
command -v chromium >/dev/null || { echo "skipped scope: the page in a browser: there is no chromium here"; exit; }
SCOPE_BUILD="$build" SCOPE_SBUS="$build/cli/sbus" timeout 1500 node run.mjs || echo "FAILED scope/run.mjs ended with status $?"
