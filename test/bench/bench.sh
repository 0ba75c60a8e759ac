#!/bin/sh
# What the library costs on a Cortex-M0+, ours beside the baseline, counted by QEMU's machine microbit.
#   bench.sh          prints the table
#   bench.sh check    says "ok bench: ..." or "FAILED bench: ..." of each bound
# BUILD is the folder for what is built, absolute.
set -u
cd "$(dirname "$0")" || exit 1
out="${BUILD:-$(cd ../.. && pwd)/build/test}/bench"
# One instruction takes 2^10 ns, which are 16.384 ticks of the processor's clock: so the clock counts instructions.
export QEMU_OPTIONS="-icount shift=10,sleep=off"

build() {
  "${MAKE:-make}" --no-print-directory -s -f build.mk OUT="$out" "$@"
}

run() {
  timeout 600 ../boards/cortex-m0/qemu.sh "$out/Bench" "$@"
}

mkdir -p "$out"
if ! build bench >"$out/log" 2>&1; then
  head -n 20 "$out/log" >&2
  echo "FAILED bench: does not build"
  exit 1
fi
[ "${1:-}" = check ] || { run; exit; }
printf '\nbench: what the library costs on a Cortex-M0+, in instructions\n'
run check 2>&1
status=$?
[ "$status" -le 1 ] || echo "FAILED bench: ended with status $status before its end"
exit "$status"
