#!/bin/sh
# qemu.sh PROGRAM ARGUMENTS...: runs a program of this folder's start-up code on QEMU's microbit, a Cortex-M0; its
# standard output and status are the program's. No argument may hold a space or a comma. QEMU_OPTIONS are added.
# The memory is more than the real board has; Start.cpp has its end.
set -u
program=$1
shift
arguments=arg=$(basename "$program")
for argument in "$@"; do
  arguments=$arguments,arg=$argument
done
# shellcheck disable=SC2086  # the options are words
exec qemu-system-arm -machine microbit -global nrf51-soc.flash-size=0x400000 -global nrf51-soc.sram-size=0x4000000 \
  -display none -monitor none -serial none -semihosting-config "enable=on,target=native,$arguments" \
  ${QEMU_OPTIONS:-} -kernel "$program" </dev/null
