#!/bin/sh
# Runs `sbus` on captures as instruments write them, triggered at 0, 10, 50 and 100 %, and on bytes in all the
# ways in which people write them. Says "ok ..." or "FAILED ...".
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

python3 tool/captures.py "$SBUS" "$work"
python3 tool/dumps.py "$SBUS" "$work"
